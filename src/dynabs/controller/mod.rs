//! The refined feedback law `c(x, k)`, and the closed loop that it makes.
//!
//! A [`Controller`] is made of a problem, its abstraction and a solution, all of which a [`Run`](crate::run::Run) has, for
//! targets and inputs alike: the cell of the state and the memory of the task give an action, the action and the state an
//! input. It answers for states ([`Controller::control`]) and for cells ([`Controller::decide_in`],
//! [`Controller::entries`], [`Controller::bound`]); where actions are targets, the mean of the next grouped state is the
//! target itself ([`Controller::action`]) plus the mean of the noise. [`Simulation`] closes the loop with the original
//! system, [`export`] writes the law as files.

mod decision;
pub mod export;
mod law;
mod memory;
mod periods;
mod refined;
mod schedule;
mod simulation;

pub use decision::Decision;
pub use memory::RunMemory;
pub use refined::{Controller, ControllerError};
pub use schedule::Entry;
pub use simulation::{
    End, Frequency, InputCheck, Moment, Noise, ParameterChoice, Plant, RunOutcome, Simulation, Tally,
    Trajectory, TrajectoryStep, Violation, samples_per_run,
};
