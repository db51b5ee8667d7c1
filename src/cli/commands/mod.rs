//! One file for every subcommand.

pub mod all;
pub mod check;
pub mod compile;
mod compile_inputs;
pub mod controller;
pub mod convert;
pub mod crosscheck;
pub mod diff;
pub mod explain;
mod init;
pub mod report;
mod search;
pub mod simulate;
pub mod solve;
pub mod sweep;
pub mod validate;
pub mod verify;
