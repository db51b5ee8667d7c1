//! What fits into a page: with everything around it, it stays below 5 MB.

use super::palette::ColourScale;
use super::scene::Scene;
use crate::controller::Trajectory;
use crate::partition::{CellId, CellKind};

/// Beyond this many cells, counted for each memory, a page is static.
const MOST_CELLS: u64 = 300_000;

/// The most bytes of values and actions of cells.
const MOST_BYTES: u64 = 3_000_000;

/// The most bytes of everything that is embedded.
const MOST_EMBEDDED: usize = 3_400_000;

/// The most points of all runs that are drawn.
const MOST_POINTS: usize = 15_000;

impl Scene<'_> {
    /// The same with colours that fit the values, and without the values of so many steps as would be too large for a page.
    pub(super) fn finished(mut self) -> Self {
        let cells = (0..self.grid.num_cells()).map(CellId);
        let ordinary = cells.filter(|&cell| self.actions.kind(None, cell) == CellKind::Ordinary);
        self.scale = ColourScale::fitted(ordinary.map(|cell| self.values.at(0)[cell.index()]));
        while self.values.last_step() > 0 && self.is_embedded() && bytes(&self) > MOST_BYTES {
            let step = self.values.last_step() * 3 / 4;
            std::iter::once(&mut self.values)
                .chain(&mut self.memories)
                .for_each(|values| values.forget_after(step));
        }
        self
    }

    /// Whether there are so few cells that a page has their values.
    pub(super) fn is_embedded(&self) -> bool {
        u64::from(self.grid.num_cells()) * self.before().count() as u64 <= MOST_CELLS
    }
}

/// Whether what would be embedded fits, all in all.
pub(super) fn fits(json: &str) -> bool {
    json.len() <= MOST_EMBEDDED
}

/// About how long values, kinds and actions of cells are in a page, which has three bytes in four characters.
fn bytes(scene: &Scene<'_>) -> u64 {
    let cells = u64::from(scene.grid.num_cells()) * scene.before().count() as u64;
    let actions: usize = scene.arrivals().map(|(before, cell)| scene.shown_entries(before, cell).len()).sum();
    let image = if scene.actions.leads_by_cell() { 4 * scene.dimension() as u64 } else { 0 };
    (cells * (4 * (scene.values.last_step() as u64 + 1) + 2) + actions as u64 * (3 + image)) * 4 / 3
}

/// The first runs, as many as are wanted and can be drawn.
pub(super) fn drawn(wanted: u64, simulate: impl Fn(u64) -> Trajectory) -> Vec<Trajectory> {
    let (mut runs, mut points) = (vec![], 0);
    for run in 0..wanted {
        let trajectory = simulate(run);
        points += trajectory.steps.len();
        if points > MOST_POINTS && run > 0 {
            break;
        }
        runs.push(trajectory);
    }
    runs
}
