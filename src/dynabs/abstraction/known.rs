//! Interval rows of noise whose distribution is known, with independent components.
//!
//! **Claim.** In every cell in which its action is enabled, a row contains the distribution of the cell of the next state after
//! *moving to `failed`* the mass of unsafe cells, of cells in which nothing is enabled, of what is outside the partition, and of
//! every cell that the row does not list.
//!
//! **Proof.** The next state is `d_a + e + η` with an error of steering `|e_j| ≤ t_j`, whatever it depends on but the noise. It is in
//! the cell `Π [a_j, b_j)` if `η_j ∈ [a_j − d_j − e_j, b_j − d_j − e_j)` for all `j`: with the product of the masses of these
//! intervals, as components are independent. Each of them contains `[a_j − d_j + t_j, b_j − d_j − t_j)` and lies in
//! `[a_j − d_j − t_j, b_j − d_j + t_j)`, whose masses are enclosed rigorously ([`Distribution::mass`]); products are rounded outwards.
//! `reached` gets the sums over goal cells, and `failed`, which is what remains, at most 1 less the lower bounds of all others. ∎

use super::enabling::Enabling;
use super::footprint::need_of_rows;
use super::grounds::grounds;
use super::pac::DIGITS;
use super::row_tasks::build_rows;
use super::states::{FAILED, REACHED, StateSpace};
use super::stencil::{BoxCount, Chosen, Ground, Special, Stencil, StencilRows};
use super::{AbstractionError, CellBox};
use crate::noise::known::Distribution;
use crate::partition::GridAxis;
use crate::problem::Problem;
use imdp::model::{RowBuffer, RowId, RowSet};
use imdp::numeric::{Rational, from_dyadic, round_decimal_down, round_decimal_up};
use imdp::progress::Progress;
use num_traits::{One, Zero};
use std::sync::Arc;

/// Cells with no more mass than this are not listed: what they have fails.
const NEGLIGIBLE: f64 = 1e-10;

/// One row per memory and target, and a bound on the mass of the cells that a row leaves out: each has at most [`NEGLIGIBLE`].
pub(super) fn build(
    problem: &Problem,
    components: &[Option<Distribution>],
    (enabling, tolerance): (&Enabling, &[f64]),
    states: &StateSpace,
    progress: &dyn Progress,
) -> Result<(RowSet, f64), AbstractionError> {
    let (grid, targets) = (problem.grid(), &enabling.targets);
    let (shared, count) = (targets.alignment().is_some(), states.memories().len() * targets.len());
    if !shared {
        need_of_rows(problem, count as u64 * u64::from(grid.num_cells())).check()?;
    }
    let grounds = grounds(problem, enabling, states, shared.then_some(targets));
    let noise = Noise { components, axes: grid.axes(), tolerance };
    progress.start("rows", count as u64);
    let rows: RowSet = match targets.alignment().zip(targets.axes()) {
        Some((alignment, axes)) => {
            let along = |j: usize| {
                let last = alignment[j].first_cell + alignment[j].stride * (axes[j].len() as u32 - 1);
                let range = (-(last as i32), grounds[0].cells[j] - 1 - alignment[j].first_cell as i32);
                noise.along(j, &alignment[j].phase, range)
            };
            let stencil = stencil(&grounds[0], &(0..axes.len()).map(along).collect::<Vec<_>>());
            let counts = |ground| [FAILED, REACHED].map(|state| BoxCount::new(ground, |own| own == state));
            let special: Vec<[BoxCount; 2]> = grounds.iter().map(counts).collect();
            let stencils: Arc<[Stencil]> = Arc::new([stencil]);
            let choose = |origin: &mut Vec<i32>, row: RowId| {
                let (memory, target) = targets.of_row(row);
                grounds[memory].origin(target, origin);
                progress.advance(1);
                chosen(&grounds[memory], &stencils[0], origin, &special[memory])
            };
            StencilRows::new(grounds.clone(), stencils.clone(), targets.len(), Vec::new, choose).into()
        }
        None => build_rows(count, progress, |row, rows| {
            let (memory, target) = targets.of_row(RowId::from_index(row));
            let ground = &grounds[memory];
            let mut point = vec![0.0; grid.dimension()];
            targets.point(target, &mut point);
            let along = |j: usize| {
                let axis = &grid.axes()[j];
                let position = (from_dyadic(point[j]).unwrap_or_default() - axis.lower()) / axis.width();
                noise.along(j, &position, (0, ground.cells[j] - 1))
            };
            let stencil = stencil(ground, &(0..point.len()).map(along).collect::<Vec<_>>());
            let RowBuffer { mut entries, mut coordinates } = RowBuffer::default();
            ground.origin(target, &mut coordinates);
            let (special, cells) = merged(ground, &stencil, &coordinates);
            let length = length(special, cells) as usize;
            rows.push_row(stencil.row(ground, &coordinates, (special, length), &mut entries));
        })
        .into(),
    };
    progress.finish();
    let unlisted = (f64::from(grid.num_cells()) * NEGLIGIBLE).next_up().min(1.0);
    Ok((rows, unlisted))
}

/// The noise, and how far a target may be missed.
struct Noise<'a> {
    components: &'a [Option<Distribution>],
    axes: &'a [GridAxis],
    tolerance: &'a [f64],
}

/// Bounds on the masses of cells along one dimension, from a first one on.
struct Along {
    first: i32,
    bounds: Vec<(f64, f64)>,
}

impl Noise<'_> {
    /// The masses of the cells of a range around an origin, for a target at a position counted from there in cells; those
    /// at the ends that are negligible are left out.
    fn along(&self, j: usize, position: &Rational, (first, last): (i32, i32)) -> Along {
        let nothing = Distribution::Atoms(vec![(Rational::zero(), Rational::one())]);
        let noise = self.components[j].as_ref().unwrap_or(&nothing);
        let missed = from_dyadic(self.tolerance[j]);
        let face = |o: i32| (Rational::from_integer(o.into()) - position) * self.axes[j].width();
        let bounds = |o: i32| {
            let (a, b) = (face(o), face(o + 1));
            // A bound that is no number says nothing.
            let Some(missed) = &missed else { return (0.0, 1.0) };
            let inner = noise.mass(Some(&(&a + missed)), Some(&(&b - missed)));
            let outer = noise.mass(Some(&(a - missed)), Some(&(b + missed)));
            (inner.lower().max(0.0), outer.upper().min(1.0))
        };
        let mut all: Vec<(i32, (f64, f64))> = (first..=last).map(|o| (o, bounds(o))).collect();
        let matters = |(_, (_, most)): &(i32, (f64, f64))| *most > NEGLIGIBLE;
        let end = all.iter().rposition(matters).map_or(0, |last| last + 1);
        all.truncate(end);
        let begin = all.iter().position(matters).unwrap_or(0);
        let first = all.get(begin).map_or(first, |&(o, _)| o);
        Along { first, bounds: all.drain(begin..).map(|(_, bounds)| bounds).collect() }
    }
}

/// The products of the masses along all dimensions.
fn stencil(ground: &Ground, along: &[Along]) -> Stencil {
    let last = |along: &Along| along.first + along.bounds.len() as i32 - 1;
    let hull = CellBox {
        lower: along.iter().map(|along| along.first).collect(),
        upper: along.iter().map(last).collect(),
    };
    let product = |mut position: usize| {
        let (mut lower, mut upper) = (1.0f64, 1.0f64);
        for along in along.iter().rev() {
            let (l, u) = along.bounds[position % along.bounds.len()];
            position /= along.bounds.len();
            lower = (lower * l).next_down().max(0.0);
            upper = (upper * u).next_up();
        }
        let upper = round_decimal_up(upper, DIGITS).min(1.0);
        (upper > NEGLIGIBLE).then(|| (round_decimal_down(lower, DIGITS), upper))
    };
    let bounds: Vec<Option<(f64, f64)>> = (0..hull.volume()).map(product).collect();
    let listed = bounds.iter().flatten().fold(0.0, |sum: f64, (lower, _)| (sum + lower).next_down().max(0.0));
    Stencil::new(&hull, ground, (0.0, rest(listed)), |position| bounds[position])
}

/// What remains beside a mass of at least this.
fn rest(listed: f64) -> f64 {
    round_decimal_up((1.0 - listed).next_up().max(0.0), DIGITS).min(1.0)
}

/// The row at `origin`.
fn chosen(ground: &Ground, stencil: &Stencil, origin: &[i32], special: &[BoxCount]) -> Chosen {
    let hull = stencil.runs().hull();
    let is_whole = ground.contains(hull, origin) && special.iter().all(|cells| cells.of(hull, origin) == 0);
    let (special, cells) = match is_whole {
        true => (Special { first: stencil.usual(), reached: None }, stencil.runs().len() as u32),
        false => merged(ground, stencil, origin),
    };
    Chosen { stencil: 0, special, length: length(special, cells) }
}

/// How many entries a row with so many cells has.
fn length(special: Special, cells: u32) -> u32 {
    1 + u32::from(special.reached.is_some()) + cells
}

/// What the special states of the row at `origin` get, and how many cells it lists.
fn merged(ground: &Ground, stencil: &Stencil, origin: &[i32]) -> (Special, u32) {
    let (mut listed, mut cells) = (0.0f64, 0);
    let mut goal: Option<(f64, f64)> = None;
    stencil.runs().for_each(ground, origin, |first, position, length| {
        for (i, &state) in ground.states[first..first + length].iter().enumerate() {
            let (lower, upper) = (stencil.lower(position + i), stencil.upper(position + i));
            if ground.lists(state) {
                listed = (listed + lower).next_down().max(0.0);
                cells += 1;
            } else if state == REACHED {
                let (least, most) = goal.unwrap_or_default();
                goal = Some(((least + lower).next_down().max(0.0), (most + upper).next_up()));
            }
        }
    });
    let reached = goal
        .map(|(least, most)| (round_decimal_down(least, DIGITS), round_decimal_up(most, DIGITS).min(1.0)));
    let all = (listed + reached.map_or(0.0, |(least, _)| least)).next_down().max(0.0);
    (Special { first: (0.0, rest(all)), reached }, cells)
}
