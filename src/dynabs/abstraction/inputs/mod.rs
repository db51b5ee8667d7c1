//! Actions that are inputs: any system, known noise.
//!
//! A cell's image under an input lands on a lattice ([`crate::landing`]); the noise takes it on from there. Nothing is
//! stored per transition, and the abstraction has bounds on both sides.

mod resolution;
mod tables;

use crate::landing::{Axis, Images, Landing, LandingError, Layout, Question, occurring};
use crate::noise::known::Distribution;
use crate::partition::CellId;
use crate::problem::InputProblem;
use crate::system::{ImageError, ImageMap, Lattice};
use crate::task::{Aim, CellTask};
use imdp::model::{MemoryError, require_memory};
use imdp::property::{PathFormula, Property, Resolution, StateFormula};
use std::time::{Duration, Instant};
use tables::Tables;

/// What is stored of a cell: values on both sides, the best of a step, inputs chosen.
const BYTES_OF_CELL: u64 = 64;

/// A control problem whose actions are inputs, as a game on a lattice.
#[derive(Clone, Debug)]
pub struct InputAbstraction {
    landing: Landing,
    images: Images,
    open: Vec<u32>,
    task: CellTask,
    steps: Option<u64>,
    /// How many sub-cells a cell has, by coordinate.
    pub resolution: Vec<u32>,
    /// The number of cells in which something could be decided but no input is enabled.
    pub blocked: usize,
    /// How long each phase took.
    pub phases: Vec<(&'static str, Duration)>,
}

/// Why there is no abstraction.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum InputsError {
    /// The dynamics are undefined somewhere.
    #[error("{error}\n  {remedy}", error = .0, remedy = ImageError::REMEDY)]
    Image(Box<ImageError>),
    /// The lattice or the list of images is too large.
    #[error("{0}\n  Use fewer cells or inputs, or a coarser /partition/resolution.")]
    Landing(#[from] LandingError),
    /// The machine is too small.
    #[error("{0}\n  Use fewer cells or inputs, or a coarser /partition/resolution.")]
    Memory(#[from] MemoryError),
    /// No input is enabled in any cell.
    #[error(
        "no input is enabled in any cell: no input leaves room for the feedback\n  Use smaller cells, a smaller gain or a larger U."
    )]
    NothingEnabled,
}

impl InputAbstraction {
    /// Abstracts a problem.
    ///
    /// # Errors
    /// [`InputsError`] if dynamics are undefined in a cell, nothing is enabled, or the lattice is too large.
    pub fn new(problem: &InputProblem) -> Result<Self, InputsError> {
        let start = Instant::now();
        let grid = problem.grid();
        let noisy: Vec<bool> = problem.noise().iter().map(Option::is_some).collect();
        let resolution = resolution::choose(problem);
        let lattice = Lattice::new(grid, &resolution, &noisy);
        let inputs = problem.inputs();
        if inputs.is_empty() {
            return Err(InputsError::NothingEnabled);
        }
        let images = ImageMap::new(problem.mode(), problem.feedback(), grid, lattice, inputs);
        let tables = Tables::new(grid, &images, inputs.len())?;
        let tabulated = start.elapsed();

        let task = problem.cell_task();
        let ordinary: Vec<u32> =
            (0..grid.num_cells()).filter(|&cell| !task.open(cell as usize).is_empty()).collect();
        let occurs = occurring(&tables, &ordinary, grid.dimension());
        let extent: Vec<_> = (0..grid.dimension()).map(|j| tables.extent(j, &occurs[j])).collect();
        let axis = |j: usize| {
            let cells = grid.axes()[j].cells() as usize;
            let noise = problem.noise()[j].as_ref().map(|noise: &Distribution| {
                let pitch =
                    grid.axes()[j].width() / imdp::numeric::Rational::from_integer(resolution[j].into());
                noise.taps(
                    &pitch,
                    reach(extent[j], (cells as i64) * i64::from(resolution[j]), problem.periodic()[j]),
                )
            });
            Axis::new(cells, resolution[j] as usize, problem.periodic()[j], noise, extent[j])
        };
        let landing = Landing::new((0..grid.dimension()).map(axis).collect());
        let pairs = ordinary.len() as u64 * inputs.len() as u64;
        let layout = Layout::new(&tables, &occurs, landing.axes(), pairs)?;
        require_memory(
            "the images of all cells and inputs",
            Images::bytes(&layout, ordinary.len(), inputs.len())
                + BYTES_OF_CELL * u64::from(grid.num_cells()),
        )?;
        let images = Images::new(&tables, &ordinary, layout);
        let open = images.acting();
        let phases = vec![("images", tabulated), ("landing", start.elapsed() - tabulated)];
        Ok(Self {
            blocked: ordinary.len() - open.len(),
            task: task.clone(),
            steps: problem.horizon(),
            landing,
            images,
            open,
            resolution,
            phases,
        })
    }

    /// The task on the lattice.
    pub fn question(&self) -> Question<'_> {
        let Self { landing, images, open, task, steps, .. } = self;
        Question { landing, images, open, task, steps: *steps }
    }

    /// The number of pairs of a cell and an input that is enabled in it.
    pub fn num_choices(&self) -> usize {
        self.images.len()
    }

    /// How many steps of the model are one of the system.
    pub fn micro_steps(&self) -> u64 {
        self.question().micro_steps()
    }

    /// The most mass of a component of the noise that is not listed.
    pub fn unlisted(&self) -> f64 {
        self.landing.axes().iter().flat_map(|axis| &axis.noise).map(|taps| taps.slack()).fold(0.0, f64::max)
    }

    /// Whether something could be decided in a cell but no input is enabled.
    pub fn is_blocked(&self, cell: CellId) -> bool {
        self.open.binary_search(&cell.0).is_err() && !self.task.open(cell.index()).is_empty()
    }

    /// The task as a property of the model; with `Pmaxmin` its value is the lower bound, with `Pmaxmax` the upper one.
    pub fn property(&self, resolution: Resolution) -> Property {
        let steps = self.steps.map(|steps| steps.saturating_mul(self.micro_steps()));
        let safe = StateFormula::negation(StateFormula::label("failed"));
        let path = match self.task.aim() {
            Aim::Reach | Aim::End => {
                PathFormula::Until { left: safe, right: StateFormula::label("reached"), steps }
            }
            Aim::Stay => PathFormula::Globally { formula: safe, steps },
        };
        Property::value(resolution, path)
    }

    /// The cells that are initial: the given one, or all in which something is decided.
    pub fn initial(&self, given: Option<CellId>) -> Vec<u32> {
        match given {
            Some(cell) => vec![cell.0],
            None if self.open.is_empty() => (0..self.task.num_cells() as u32).collect(),
            None => self.open.clone(),
        }
    }
}

/// From which to which lattice interval noise matters: others lead out of the partition from every image.
fn reach((first, last): (i64, i64), sub_cells: i64, periodic: bool) -> (i64, i64) {
    // Images that reach far beyond are as good as lost.
    let far = 4 * sub_cells + 16;
    if periodic {
        return (-far, far);
    }
    let (first, last) = (first.clamp(-far, far), last.clamp(-far, far));
    (-1 - last.max(first), sub_cells - first.min(last))
}
