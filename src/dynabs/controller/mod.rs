//! The refined feedback law `c(x, k)`, and the closed loop that it makes.
//!
//! A [`Controller`] is made of a problem, its abstraction and a solved answer, all of which a
//! [`Run`](crate::run::Run) has. It answers for states ([`Controller::control`]) and for cells
//! ([`Controller::decide_in`], [`Controller::entries`], [`Controller::bound`]); the mean of the next grouped
//! state is the target itself ([`Controller::target_point`]) plus the mean of the noise. [`Simulation`] closes
//! the loop with the original system, [`export`] writes the law as files.

pub mod export;
mod input_controller;
mod law;
mod memory;
mod refined;
mod schedule;
mod simulation;

pub use input_controller::InputController;
pub use memory::RunMemory;
pub use refined::{Controller, ControllerError, Decision};
pub use schedule::Entry;
pub use simulation::{
    End, Frequency, InputCheck, InputSimulation, Noise, ParameterChoice, Plant, RunOutcome, Simulation,
    Tally, Trajectory, TrajectoryStep, Violation,
};
