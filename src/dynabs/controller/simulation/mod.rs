//! The closed loop, many times: what happens, as against what was promised.

mod input_check;
mod input_runs;
mod noise;
mod plant;
mod runs;
mod tally;
mod trajectory;
mod witness;

pub use input_check::{InputCheck, Violation};
pub use input_runs::{InputSimulation, ParameterChoice};
pub use noise::Noise;
pub use plant::Plant;
pub use runs::{End, RunOutcome, Simulation};
pub use tally::{Frequency, Tally};
pub use trajectory::{Trajectory, TrajectoryStep};
