//! Texts and what becomes of them.

mod accepted;
mod documents;
mod evaluated;
mod generated;
mod refused;
mod resolved;
