//! Targets, the law that steers to them, and where it may be used: what samples have no part in.

use super::AbstractionError;
use super::enabled::{EnabledActions, enabled_actions};
use super::targets::Targets;
use crate::partition::{CellId, CellKind};
use crate::problem::{Actions, Problem};
use crate::system::{Extent, FeedbackLaw, SteeringConstraint};
use imdp::progress::Progress;

/// The law of a problem and the conditions under which it is applied.
pub(super) struct Steering {
    pub(super) targets: Targets,
    pub(super) law: FeedbackLaw,
    pub(super) extent: Extent,
    constraints: Vec<SteeringConstraint>,
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
        Ok(Self { targets, law, extent, constraints })
    }

    /// How many ranges of actions are enabled in some cells.
    pub(super) fn ranges(&self, problem: &Problem, cells: &[CellId]) -> usize {
        enabled_actions(problem.grid(), cells, &self.targets, &self.constraints, &()).ranges.len()
    }

    /// The actions of all ordinary cells, in the order of the cells.
    pub(super) fn enabled(
        &self,
        problem: &Problem,
        progress: &dyn Progress,
    ) -> Result<EnabledActions, AbstractionError> {
        let ordinary: Vec<CellId> = (problem.labels().iter())
            .filter_map(|(cell, kind)| (kind == CellKind::Ordinary).then_some(cell))
            .collect();
        progress.start("enabled actions", ordinary.len() as u64);
        let enabled = enabled_actions(problem.grid(), &ordinary, &self.targets, &self.constraints, progress);
        progress.finish();
        if enabled.ranges.is_empty() && !ordinary.is_empty() {
            return Err(AbstractionError::NothingEnabled { stabilized: problem.stabilizer().is_some() });
        }
        Ok(enabled)
    }
}
