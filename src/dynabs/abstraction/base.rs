//! What a model is built on: where noise lands, in which windows, and which actions are enabled.

use super::AbstractionError;
use super::action_counts::TargetPlacements;
use super::enabling::Enabling;
use super::hazards::Hazards;
use super::pac::{Prepared, TaskEnds};
use super::states::StateSpace;
use super::steering::Steering;
use super::windows::Windows;
use crate::Warning;
use crate::noise::known::Distribution;
use crate::problem::{Knowledge, Problem, SampledNoise};
use imdp::progress::Progress;

/// All that is known before the choices of the model are.
pub(super) struct Base<'a> {
    pub(super) placements: TargetPlacements<'a>,
    pub(super) intervals: Intervals<'a>,
    pub(super) enabling: Enabling,
}

/// How intervals are to be computed.
pub(super) enum Intervals<'a> {
    /// Jointly valid, with these levels and windows.
    Pac(&'a SampledNoise, Box<Prepared>),
    /// Of the masses of known distributions.
    Known(&'a [Option<Distribution>]),
    /// Those of the published tool, each with this failure probability.
    Reference(&'a SampledNoise, f64),
}

impl Intervals<'_> {
    /// The windows that rows are made with; none in `reference` mode.
    fn windows(&self) -> Option<&Windows> {
        match self {
            Self::Pac(_, prepared) => Some(prepared.windows()),
            Self::Known(_) | Self::Reference(..) => None,
        }
    }

    /// A warning if samples contradict the windows.
    pub(super) fn contradiction(&self) -> Option<Warning> {
        self.windows().and_then(Windows::contradiction)
    }
}

impl<'a> Base<'a> {
    pub(super) fn new(
        problem: &'a Problem,
        states: &StateSpace,
        steering: &'a Steering,
        progress: &dyn Progress,
    ) -> Result<Self, AbstractionError> {
        let (law, targets) = (&steering.law, &steering.targets);
        let is_exact = matches!(problem.knowledge(), Knowledge::Published { .. });
        let tolerance = (!is_exact).then(|| law.steering_error(&steering.extent));
        let placements = TargetPlacements::new(problem.grid(), targets, tolerance);
        let hazards = Hazards::in_between(problem);
        let intervals = match problem.knowledge() {
            Knowledge::Samples { noise, beta, sweep, discard } => {
                let statement = (beta, sweep, discard as usize);
                let ends = TaskEnds::new(problem, states, targets);
                let (actions, hazards) = ((targets, ends), hazards.as_ref());
                let prepared = Prepared::new((problem, noise), statement, actions, &placements, hazards)?;
                Intervals::Pac(noise, Box::new(prepared))
            }
            Knowledge::Distribution(components) => Intervals::Known(components),
            Knowledge::Published { noise, beta_per_interval } => {
                Intervals::Reference(noise, beta_per_interval)
            }
        };
        let hazards = hazards.as_ref().zip(intervals.windows()).map(|(hazards, windows)| {
            let cells = placements.shared().and_then(|placement| windows.cells(placement).into_iter().next());
            (hazards, windows, cells.map_or(0, |cells| cells.volume()))
        });
        let enabling = Enabling::new(problem, steering, hazards, progress)?;
        Ok(Self { placements, intervals, enabling })
    }
}
