//! From a noisy linear control system to a controller with a proof.
//!
//! # The problem
//!
//! A system `x⁺ = A x + B u + q + η` with states `x ∈ ℝⁿ`, inputs `u ∈ U ⊂ ℝᵖ` and independent noise `η` of
//! unknown distribution, of which there are `N` samples; a goal region, an unsafe region, a number of
//! steps. Wanted: a feedback controller that reaches the goal in time and avoids the unsafe region with at
//! least a given probability, and a guarantee of that which holds with confidence `1 − β` over the samples.
//!
//! # The way there
//!
//! Following Badings, Romao, Abate, Jansen, *A Stability-Based Abstraction Framework for Reach-Avoid Control
//! of Stochastic Dynamical Systems with Unknown Noise Distributions* (ECC 2024):
//!
//! | stage | module | what comes out |
//! |---|---|---|
//! | a problem is stated, in memory or as a model file | [`problem`], [`model_file`] | a [`Problem`](problem::Problem) |
//! | `d` steps become one; LQR closes a lower loop | [`system`] | `Â`, `B̂`, `K`, and the [`FeedbackLaw`](system::FeedbackLaw) |
//! | the state space is cut into cells | [`partition`] | a [`Grid`](partition::Grid) with exact faces, labelled cells |
//! | samples become probability intervals | [`noise`], [`statistics`] | bounds that hold together with probability `1 − β` |
//! | cells, targets and intervals meet | [`abstraction`] | an [`IntervalMdp`](imdp::model::IntervalMdp) with shared rows, and a property |
//! | it is written for others | [`imdp::formats`], [`run`] | PRISM's explicit files, DRN, UMB and others, a manifest |
//! | what holds is said | [`guarantee`] | one claim, in words and as JSON |
//! | it is solved | [`imdp::property`], [`imdp::solver`] | bounds on the robust value, a policy |
//! | the result is checked again | [`imdp::verify`] | a certificate, accepted in exact arithmetic |
//! | others are asked the same | [`imdp::engines`] | PRISM's and Storm's values of every state, and where they differ |
//! | the policy is refined | [`controller`] | a feedback [`Controller`](controller::Controller), its closed loop, C code |
//! | it is low, and why | [`explain`] | reasons, and what to change |
//! | it is shown | [`report`] | one HTML page, SVG |
//!
//! For any other system actions are inputs: an [`InputProblem`](problem::InputProblem), abstracted by
//! [`abstraction::inputs`] on the lattice of [`landing`]; tasks with a memory are [`task`]'s.
//!
//! What makes it fast: an action steers to a target point, so its distribution over cells does not depend
//! on the cell it is taken in. An interval MDP with tens of millions of transitions has a few thousand
//! distinct rows, and nothing here ever stores, hashes or solves per transition what belongs to a row.
//!
//! # Example
//!
//! ```
//! use dynabs::{abstraction, controller, imdp::solver, model_file};
//! use std::path::Path;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/room_temperature.json"));
//! let document = model_file::Document::parse(path, &std::fs::read_to_string(path)?)?;
//! let problem = document.problem()?;
//! let compiled = abstraction::compile(&problem, &())?;
//!
//! let options = solver::SolverOptions { policy: true, ..Default::default() };
//! let answer = solver::Answer::new(&compiled.model, &compiled.property, &options)?;
//! assert!(answer.lower > 0.99);
//!
//! let controller = controller::Controller::new(&problem, &compiled, &answer)?;
//! let (mut u, mut memory) = ([0.0], controller::RunMemory::default());
//! let decision = controller.control(&[2.0], 0, &mut memory, &mut u);
//! assert!(matches!(decision, controller::Decision::Act { .. }));
//! assert!(-1.75 <= u[0] && u[0] <= 1.75);
//! # Ok(())
//! # }
//! ```
//!
//! # Two crates
//!
//! Everything that speaks of interval MDPs alone is the crate [`imdp`]: the solver reads anyone's models, and the
//! models made here can be solved by anyone. It knows nothing of this one.

pub mod abstraction;
pub mod controller;
mod diagnostic;
pub mod explain;
pub mod geometry;
pub mod guarantee;
pub mod landing;
pub mod linear_algebra;
pub mod memory;
pub mod model_file;
pub mod noise;
pub mod partition;
pub mod problem;
mod rendered;
pub mod report;
pub mod run;
pub mod statistics;
pub mod system;
pub mod task;
mod warning;

pub use diagnostic::Diagnostic;
pub use imdp;
pub use warning::Warning;
