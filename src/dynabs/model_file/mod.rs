//! The model file: JSON in, a validated [`Problem`] out, every error with the place it is about.

mod diagnostic;
mod document;
mod fields;
mod noise;
mod problem;
mod regions;
mod schema;
mod stabilizer;
mod values;

pub use diagnostic::Diagnostic;
pub use document::{Document, SetArgument};
pub use fields::{
    DynamicsSpec, GaussianSpec, GridSpec, GroupSteps, Horizon, LqrSpec, Mode, ModelFile, NoiseSpec,
    ProbabilitiesSpec, RegionSpec, SafetyCheck, SampleKind, SamplesSpec, SetSpec, StabilizerSpec,
    TargetsSpec, TaskSpec, UnsafeSpec,
};
pub use noise::{NoiseSource, StepNoise};
pub use problem::{Probabilities, Problem, TargetPoints};
pub use schema::{json_schema, starter_model};
pub use stabilizer::Stabilizer;
