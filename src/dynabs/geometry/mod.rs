//! Convex sets of inputs: polytopes in half-space form.

mod feasibility;
mod polytope;

pub use polytope::Polytope;
