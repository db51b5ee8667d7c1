//! The refined feedback law `c(x, k)`, and the closed loop that it makes.

pub mod export;
mod law;
mod refined;
mod schedule;
mod simulation;

pub use refined::{Controller, ControllerError, Decision};
pub use schedule::Entry;
pub use simulation::{
    End, Frequency, InputCheck, Noise, Plant, RunOutcome, Simulation, Tally, Trajectory, TrajectoryStep,
    Violation,
};
