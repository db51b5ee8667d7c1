//! Targets, the law that steers to them, and where it may be used: what samples have no part in.

use super::enabled::{EnabledActions, enabled_around};
use super::targets::Targets;
use crate::partition::{CellId, CellKind};
use crate::problem::{Actions, Problem, Stabilizer};
use crate::system::{Demands, Extent, FeedbackLaw, SteeringConstraint};
use imdp::progress::Progress;

/// So many cells, spread evenly, stand for all of a kind.
const REPRESENTATIVES: usize = 500;

/// What the law of a problem is made for: to be able to stay where it may be; in the goal as a whole as much as elsewhere.
pub fn demands(problem: &Problem) -> Demands {
    let (grid, labels) = (problem.grid(), problem.labels());
    let centers: Vec<Vec<f64>> = grid.axes().iter().map(|axis| axis.centers()).collect();
    let of_kind = |kind| {
        let count = labels.count(kind);
        let cells = labels.iter().filter(move |(_, of_cell)| *of_cell == kind);
        let weight = 1.0 / count.div_ceil(count.div_ceil(REPRESENTATIVES).max(1)).max(1) as f64;
        let centers = &centers;
        cells.step_by(count.div_ceil(REPRESENTATIVES).max(1)).map(move |(cell, _)| {
            let x = (0..centers.len()).map(|j| centers[j][grid.coordinate(cell, j) as usize]);
            (x.collect(), weight)
        })
    };
    let cell = grid.widths().iter().map(|width| width / 2.0).collect();
    Demands { cell, holds: of_kind(CellKind::Ordinary).chain(of_kind(CellKind::Goal)).collect() }
}

/// The law of a problem and the conditions under which it is applied.
pub(super) struct Steering {
    pub(super) targets: Targets,
    pub(super) law: FeedbackLaw,
    pub(super) extent: Extent,
    constraints: Vec<SteeringConstraint>,
    /// Those of the cells, by dimension.
    centers: Vec<Vec<f64>>,
}

impl Steering {
    pub(super) fn new(problem: &Problem, law: FeedbackLaw) -> Self {
        let Actions::Targets(points) = problem.actions();
        let targets = Targets::new(points, problem.grid());
        let layers = problem.stabilizer().and_then(Stabilizer::feedback).map(|feedback| &feedback.layers);
        let extent = Extent { state: problem.grid().magnitudes(), target: targets.magnitudes() };
        let constraints =
            law.constraints(problem.input(), layers.map(|layers| layers.abstract_input()), &extent);
        let centers = problem.grid().axes().iter().map(|axis| axis.centers()).collect();
        Self { targets, law, extent, constraints, centers }
    }

    /// The actions that the law allows in each of `cells`.
    pub(super) fn enabled(
        &self,
        problem: &Problem,
        cells: &[CellId],
        progress: &dyn Progress,
    ) -> EnabledActions {
        enabled_around(&self.centers, problem.grid(), cells, &self.targets, &self.constraints, progress)
    }
}
