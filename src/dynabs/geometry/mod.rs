//! Convex sets of inputs and states: polytopes in half-space form.

mod linear_program;
mod polytope;

pub use polytope::Polytope;
