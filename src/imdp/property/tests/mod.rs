//! Texts and what becomes of them.

mod accepted;
mod evaluated;
mod generated;
mod refused;
mod resolved;
