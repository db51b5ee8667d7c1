//! From a noisy linear control system to a controller with a proof.
pub mod dynamics;
pub mod geometry;
pub mod imdp;
pub mod noise;
pub mod numeric;
pub mod partition;
pub mod property;
pub mod solver;
pub mod statistics;
