//! A control problem: its parts as plain numbers, a builder that checks that they fit, and what came of it.
//!
//! [`Problem::builder`] takes the parts from memory; a model file ([`crate::model_file`]) is one client of it.
//!
//! ```
//! use dynabs::problem::{
//!     DrawnNoise, GaussianNoise, InputSet, LinearDynamics, Partition, Problem, RegionBox, Task,
//! };
//!
//! # fn main() -> Result<(), dynabs::Diagnostic> {
//! // x⁺ = x + u + η, to be brought near 0 within five steps.
//! let dynamics = LinearDynamics { a: vec![vec![1.0]], b: vec![vec![1.0]], q: None };
//! let noise = GaussianNoise { mean: None, covariance: vec![vec![0.01]] };
//! let problem = Problem::builder(dynamics, InputSet::Box { lower: vec![-1.0], upper: vec![1.0] })
//!     .partition(Partition { lower: vec![-4.0], upper: vec![4.0], cells: vec![40] })
//!     .task(Task::reach(vec![RegionBox { lower: vec![-0.4], upper: vec![0.4] }]).within(5).at_least(0.9))
//!     .noise(DrawnNoise { distribution: noise, count: 1000, seed: 1 })
//!     .initial_state(vec![2.5])
//!     .build()?;
//! assert_eq!(problem.group_steps(), 1);
//!
//! let abstraction = dynabs::abstraction::compile(&problem, &()).unwrap();
//! assert!(abstraction.model.num_states() > 30);
//! # Ok(())
//! # }
//! ```

mod automaton;
mod builder;
mod checked_task;
mod cost;
mod distribution;
mod dynamics;
mod expression_dynamics;
mod feedback_choice;
mod grouping;
mod input_noise;
mod input_problem;
mod input_set;
mod lower_layer;
mod noise;
mod plant_noise;
mod probabilities;
#[expect(clippy::module_inception, reason = "the file of the type is called after it, as everywhere")]
mod problem;
mod regions;
mod shape_example;
mod target_id;
mod task;
mod tracking;
mod values;

pub use builder::ProblemBuilder;
pub use cost::{Cost, CostParts};
pub use distribution::DistributionParts;
pub use dynamics::{Dynamics, GroupSteps, LinearDynamics};
pub use expression_dynamics::{Constant, Equations, ExpressionDynamics};
pub use feedback_choice::FeedbackChoice;
pub use input_noise::{Components, InputNoise, InputNoiseParts, JointGaussian, StepSamples};
pub use input_problem::{InputChoice, InputParts, InputProblem};
pub use input_set::InputSet;
pub use lower_layer::{FeedbackLayer, Gain, LinearStabilizer, LowerLayer, LqrWeights, Stabilizer};
pub use noise::{
    DrawnNoise, GaussianNoise, GivenSamples, NoiseOrigin, NoiseSource, SampleKind, SampledNoise, SamplesFile,
    StepNoise,
};
pub use plant_noise::PlantNoise;
pub use probabilities::Probabilities;
pub use problem::{Actions, Knowledge, Objective, Problem, TargetPoints};
pub use regions::{Partition, RegionBox, RegionParts, ShapeParts, TargetChoice};
pub use target_id::TargetId;
pub use task::{Hazard, Horizon, Leg, Logic, Task, Wanted};
pub use tracking::{AUTOMATIC_SHARE, Heading, Tracking, TrackingLayer};
