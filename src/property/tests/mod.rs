//! Texts and what becomes of them.

mod accepted;
mod generated;
mod refused;
mod resolved;
