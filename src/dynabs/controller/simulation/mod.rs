//! The closed loop, many times: what happens, as against what was promised.

mod input_check;
mod motion;
mod noise;
mod outcome;
mod plant;
mod replay;
mod runs;
mod tally;
mod trajectory;
mod witness;

pub use input_check::{InputCheck, Violation};
pub use motion::ParameterChoice;
pub use noise::Noise;
pub use outcome::{End, RunOutcome};
pub use plant::Plant;
pub use replay::samples_per_run;
pub use runs::{Moment, Simulation};
pub use tally::{Frequency, Tally};
pub use trajectory::{Trajectory, TrajectoryStep};
