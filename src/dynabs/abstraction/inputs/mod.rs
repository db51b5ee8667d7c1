//! Actions that are inputs: any system, any noise.
//!
//! A cell's image under an input lands on a lattice ([`crate::landing`]); the noise takes it on from there. Nothing is
//! stored per transition, and the abstraction has bounds on both sides.

mod correlated;
mod costs;
mod error;
mod export;
mod leaving;
mod reach;
mod resolution;
mod sampled;
#[cfg(test)]
mod sampled_tests;
mod tables;

use super::Footprint;
use crate::Warning;
use crate::guarantee::Evidence;
use crate::landing::{Axis, Images, Landing, Layout, Question, Stencil, Taps, occurring};
use crate::memory::Need;
use crate::noise::known::Distribution;
use crate::partition::{CellId, CellKind};
use crate::problem::{InputNoise, InputProblem};
use crate::system::{ImageMap, Lattice};
use crate::task::CellTask;
pub use error::InputsError;
pub use export::{InputEncoding, InputModel};
use imdp::numeric::Rational;
use imdp::property::{Threshold, ThresholdComparison, Verdict};
use imdp::solver::ValueBounds;
use reach::Reach;
use sampled::Proved;
use std::time::{Duration, Instant};
use tables::Tables;

/// What is stored of a cell with a memory: values on both sides, the best of a step, inputs chosen.
const BYTES_OF_PAIR: u64 = 64;

/// A control problem whose actions are inputs, as a game on a lattice.
#[derive(Clone, Debug)]
pub struct InputAbstraction {
    landing: Landing,
    images: Images,
    open: Vec<u32>,
    task: CellTask,
    steps: Option<u64>,
    /// The landing of the model that files have, where that is looser.
    relaxed: Option<Landing>,
    /// What the probabilities rest on.
    pub evidence: Evidence,
    /// What the user should know.
    pub warnings: Vec<Warning>,
    /// How many sub-cells a cell has, by coordinate.
    pub resolution: Vec<u32>,
    /// The number of cells in which something could be decided but no input is enabled.
    pub blocked: usize,
    /// How much memory was expected to be needed.
    pub footprint: Footprint,
    /// How long each phase took.
    pub phases: Vec<(&'static str, Duration)>,
}

impl InputAbstraction {
    /// Abstracts a problem.
    ///
    /// # Errors
    /// [`InputsError`] if dynamics are undefined in a cell, nothing is enabled, or the lattice is too large.
    pub fn new(problem: &InputProblem) -> Result<Self, InputsError> {
        let start = Instant::now();
        let grid = problem.grid();
        let noisy = problem.noise().noisy(grid.dimension());
        let resolution = resolution::choose(problem);
        let lattice = Lattice::new(grid, &resolution, &noisy);
        let inputs = problem.inputs();
        if inputs.is_empty() {
            return Err(InputsError::NothingEnabled);
        }
        let mut footprint = Footprint::of_cells(grid);
        footprint.take(need_of_memories(problem))?;
        let images = ImageMap::new(problem.mode(), problem.feedback(), grid, lattice, inputs);
        let tables = Tables::new(grid, &images, inputs.len())?;
        let tabulated = start.elapsed();

        let task = problem.cell_task();
        let ordinary: Vec<u32> =
            (0..grid.num_cells()).filter(|&cell| !task.open(cell as usize).is_empty()).collect();
        let occurs = occurring(&tables, &ordinary, grid.dimension());
        let extent: Vec<_> = (0..grid.dimension()).map(|j| tables.extent(j, &occurs[j])).collect();
        let Landed { landing, relaxed, evidence, warnings } =
            landed(problem, &resolution, &extent, &mut footprint)?;
        let (what, bytes) = ("the arrays that noise moves", landing.bytes_of_moves());
        if bytes > 0 {
            footprint.take(Need { what, bytes, field: "/partition/cells" })?;
        }
        let pairs = ordinary.len() as u64 * inputs.len() as u64;
        let layout = Layout::new(&tables, &occurs, landing.axes(), pairs)?;
        let bytes = Images::bytes(&layout, ordinary.len(), inputs.len());
        let what = "the images of all cells under all inputs";
        footprint.take(Need { what, bytes, field: "/partition/cells" })?;
        let images = Images::new(&tables, &ordinary, layout);
        if let Some(which) = leaving::all_leave(problem, &landing, &images, (&extent, &resolution)) {
            return Err(InputsError::LeavesPartition { which });
        }
        let open = images.acting();
        let phases = vec![("images", tabulated), ("landing", start.elapsed() - tabulated)];
        Ok(Self {
            blocked: ordinary.len() - open.len(),
            task: task.clone(),
            steps: problem.horizon(),
            landing,
            relaxed,
            evidence,
            warnings,
            images,
            open,
            resolution,
            footprint,
            phases,
        })
    }

    /// The task on the lattice.
    pub fn question(&self) -> Question<'_> {
        let Self { landing, images, open, task, steps, .. } = self;
        Question { landing, images, open, task, steps: *steps }
    }

    /// The task on the lattice of the model that files have: looser where no interval model says as much as the samples.
    pub fn exported(&self) -> Question<'_> {
        Question { landing: self.relaxed.as_ref().unwrap_or(&self.landing), ..self.question() }
    }

    /// Whether the model that files have is looser than the task on the lattice.
    pub fn is_relaxed(&self) -> bool {
        self.relaxed.is_some()
    }

    /// The number of pairs of a cell and an input that is enabled in it.
    pub fn num_choices(&self) -> usize {
        self.images.len()
    }

    /// How many steps of the model are one of the system.
    pub fn micro_steps(&self) -> u64 {
        self.question().micro_steps()
    }

    /// Whether something could be decided in a cell but no input is enabled.
    pub fn is_blocked(&self, cell: CellId) -> bool {
        self.open.binary_search(&cell.0).is_err() && !self.task.open(cell.index()).is_empty()
    }

    /// The cells in which the controller decides something, ascending: not those in which it takes the task for lost, for a
    /// part of them is unsafe.
    pub fn decided(&self) -> Vec<u32> {
        let decides = |&cell: &u32| self.task.kind(CellId(cell)) == CellKind::Ordinary;
        self.open.iter().copied().filter(decides).collect()
    }

    /// The cells that are initial: the given one, or all in which something is decided.
    pub fn initial(&self, given: Option<CellId>) -> Vec<u32> {
        let decided = self.decided();
        match given {
            Some(cell) => vec![cell.0],
            None if decided.is_empty() => (0..self.task.num_cells() as u32).collect(),
            None => decided,
        }
    }

    /// Whether the threshold of the task is met from all initial cells, with bounds by cell; `None` if it has none.
    pub fn verdict(&self, problem: &InputProblem, values: &ValueBounds) -> Option<Verdict> {
        let probability = problem.threshold()?.clone();
        let threshold = Threshold { comparison: ThresholdComparison::AtLeast, probability };
        let of_cell = |cell: u32| {
            let cell = CellId(cell).index();
            threshold.decide(values.lower[cell], values.upper[cell])
        };
        Some(Verdict::in_all(self.initial(problem.initial_cell()).into_iter().map(of_cell)))
    }
}

/// Where noise takes what lands, and what that rests on.
struct Landed {
    landing: Landing,
    relaxed: Option<Landing>,
    evidence: Evidence,
    warnings: Vec<Warning>,
}

fn landed(
    problem: &InputProblem,
    resolution: &[u32],
    extent: &[(i64, i64)],
    footprint: &mut Footprint,
) -> Result<Landed, InputsError> {
    let axes = problem.grid().axes();
    let pitch: Vec<Rational> = axes
        .iter()
        .zip(resolution)
        .map(|(axis, &r)| axis.width() / Rational::from_integer(r.into()))
        .collect();
    let sub_cells = |j: usize| i64::from(axes[j].cells()) * i64::from(resolution[j]);
    let axis = |j: usize, noise: Option<Taps>| {
        Axis::new(axes[j].cells() as usize, resolution[j] as usize, problem.periodic()[j], noise, extent[j])
    };
    let all = 0..axes.len();
    let in_boxes = |noise: &[Stencil]| {
        Landing::with_noise_in_boxes(all.clone().map(|j| axis(j, None)).collect(), extent, noise)
    };
    let known = |landing: Landing, unlisted: f64| Landed {
        landing,
        relaxed: None,
        evidence: Evidence::Known { unlisted, both_sides: true },
        warnings: vec![],
    };
    match problem.noise() {
        InputNoise::Components(components) => {
            let taps = |j: usize, noise: &Distribution| {
                noise.taps(&pitch[j], reach(extent[j], sub_cells(j), problem.periodic()[j]))
            };
            let taps = |j: usize| components[j].as_ref().map(|noise| taps(j, noise));
            let landing = Landing::new(all.clone().map(|j| axis(j, taps(j))).collect());
            let slacks = landing.axes().iter().flat_map(|axis| &axis.noise).map(Taps::slack);
            let unlisted = slacks.fold(0.0, f64::max);
            Ok(known(landing, unlisted))
        }
        InputNoise::Gaussian(noise) => {
            let far = |j: usize| (-4 * sub_cells(j) - 16, 4 * sub_cells(j) + 16);
            let noise = correlated::stencils(noise, &pitch, &all.clone().map(far).collect::<Vec<_>>());
            let unlisted = noise.iter().map(|noise| noise.elsewhere).fold(0.0, f64::max);
            Ok(known(in_boxes(&noise), unlisted))
        }
        InputNoise::Sampled(samples) => {
            let reach = |j| Reach::new(extent[j], sub_cells(j), problem.periodic()[j]);
            let reach: Vec<Reach> = all.clone().map(reach).collect();
            let Proved { noise, evidence, warnings } = sampled::prove(samples, &pitch, &reach, footprint)?;
            let relaxed: Vec<Stencil> = noise.iter().map(Stencil::relaxed).collect();
            let is_looser = noise.iter().any(|noise| noise.band.is_some());
            Ok(Landed {
                landing: in_boxes(&noise),
                relaxed: is_looser.then(|| in_boxes(&relaxed)),
                evidence: Evidence::Samples(evidence),
                warnings,
            })
        }
    }
}

/// What the memories of the task take in all cells.
fn need_of_memories(problem: &InputProblem) -> Need {
    let (cells, memories) = (problem.grid().num_cells(), problem.cell_task().memories());
    let bytes = u64::from(cells).saturating_mul(u64::from(memories)).saturating_mul(BYTES_OF_PAIR);
    let field = if memories > 1 { "/task" } else { "/partition/cells" };
    Need { what: "what the task remembers in all cells", bytes, field }
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
