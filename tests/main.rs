//! The integration tests: one binary, a module for each thing that is promised.
//!
//! `common` holds what several share. Tests of the guarantee's coverage, which take longer, are a binary of their own.
#![allow(missing_docs, unreachable_pub, clippy::unwrap_used, clippy::expect_used)]

mod common;

mod bad_input;
mod binomial;
mod cases;
mod controller;
mod costs;
mod covered;
mod crosscheck_engines;
mod crosscheck_storm;
mod design;
mod diff;
mod enclosure;
mod exports;
mod faults;
mod formats;
mod guarantee;
mod import;
mod input_models;
mod input_noise;
mod inputs;
mod intervals;
mod known_targets;
mod memory;
mod native;
mod noise_masses;
mod one_tool;
mod open;
mod output;
mod overflow;
mod paper;
mod predecessors;
mod promises;
mod prune;
mod ranks;
mod readme;
mod references;
mod reliability;
mod report;
mod riccati;
mod schemas;
mod search;
mod simulate;
mod solution;
mod solver;
mod soundness;
mod steering;
mod sweep;
mod systems;
mod target_tasks;
mod tasks;
mod tracking;
mod type_names;
mod validate;
mod values;
mod verify;
