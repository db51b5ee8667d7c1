//! Targets, the law that steers to them, and where it may be used: what samples have no part in.

use super::AbstractionError;
use super::enabled::{EnabledActions, enabled_around};
use super::targets::Targets;
use crate::partition::CellId;
use crate::problem::{Actions, Problem};
use crate::system::{Extent, FeedbackLaw, SteeringConstraint};
use imdp::progress::Progress;

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
    pub(super) fn new(problem: &Problem) -> Result<Self, AbstractionError> {
        let Actions::Targets(points) = problem.actions();
        let targets = Targets::new(points, problem.grid());
        let layers = problem.stabilizer().map(|stabilizer| &stabilizer.layers);
        let law = FeedbackLaw::new(problem.system(), layers).ok_or(AbstractionError::NotSteerable)?;
        let extent = Extent { state: problem.grid().magnitudes(), target: targets.magnitudes() };
        let constraints =
            law.constraints(problem.input(), layers.map(|layers| layers.abstract_input()), &extent);
        let centers = problem.grid().axes().iter().map(|axis| axis.centers()).collect();
        Ok(Self { targets, law, extent, constraints, centers })
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
