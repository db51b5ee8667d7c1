//! From a noisy linear control system to a controller with a proof.
pub mod abstraction;
#[cfg(feature = "cli")]
pub mod cli;
pub mod crosscheck;
pub mod dynamics;
pub mod formats;
pub mod geometry;
pub mod imdp;
pub mod noise;
pub mod numeric;
pub mod partition;
pub mod progress;
pub mod property;
pub mod run_directory;
pub mod solver;
pub mod spec;
pub mod statistics;
