//! How often the promises are broken, over thousands of sample sets from known distributions.
//!
//! `cargo bench --bench coverage [-- REPLICATIONS [between]]` prints two Markdown tables, or only the second one, about what
//! lies between grouped steps; ends with 1 if some claim fails more often than promised.
#![allow(missing_docs, clippy::unwrap_used, unreachable_pub)]

#[path = "../coverage/between.rs"]
mod between;
#[path = "../coverage/noise.rs"]
mod noise;
#[path = "../coverage/replication.rs"]
mod replication;
#[path = "../coverage/truth.rs"]
mod truth;

use between::{BetweenFailures, Experiment, Layers};
use dynabs::statistics::{lower_bound, upper_bound};
use noise::Noise;
use rayon::prelude::*;
use replication::{Failures, replicate};
use std::process::ExitCode;
use truth::Layout;

const BETA: f64 = 0.1;
const SAMPLES: usize = 300;
/// The confidence of the intervals of the frequencies themselves.
const TAIL: f64 = 0.005;

fn main() -> ExitCode {
    let replications = std::env::args().skip(1).find_map(|argument| argument.parse().ok()).unwrap_or(5000);
    println!(
        "{replications} sample sets of {SAMPLES} per row, β = {BETA}; frequencies with 99 % intervals\n"
    );
    let mut kept = std::env::args().any(|argument| argument == "between") || each_step(replications);
    kept &= between_steps(replications);
    if kept { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The first table; false if some claim fails too often.
fn each_step(replications: u64) -> bool {
    println!(
        "| noise | targets | value above truth | rows | cells | goal | failed | no unseen mass | no union bound |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    let mut kept = true;
    for layout in [Layout::Centers, Layout::Points, Layout::InOrder] {
        for noise in Noise::ALL {
            let failures = run(layout, noise, replications);
            kept &= failures.rows as f64 <= BETA * replications as f64;
            kept &= failures.values as f64 <= BETA * replications as f64;
            let cell = |count| frequency(count, replications);
            println!(
                "| {noise:?} | {layout:?} | {} | {} | {} | {} | {} | {} | {} |",
                cell(failures.values),
                cell(failures.rows),
                cell(failures.cells),
                cell(failures.goal),
                cell(failures.failed),
                cell(failures.without_unseen),
                cell(failures.without_union)
            );
        }
    }
    kept
}

/// The second table, of two steps grouped, with a limit in between.
fn between_steps(replications: u64) -> bool {
    let mut kept = true;
    println!("\nTwo steps grouped, with a limit in between:\n");
    println!(
        "| layers | promised at best | value above truth | rows | rows at instants | lower bounds of all noise |"
    );
    println!("|---|---|---|---|---|---|");
    let experiment = Experiment::new();
    for layers in [Layers::One, Layers::Two] {
        let failures = run_between(&experiment, layers, replications);
        kept &= failures.rows.max(failures.values) as f64 <= BETA * replications as f64;
        let cell = |count| frequency(count, replications);
        println!(
            "| {layers:?} | {:.4} | {} | {} | {} | {} |",
            experiment.best_value(layers, BETA, 0),
            cell(failures.values),
            cell(failures.rows),
            cell(failures.rows_at_instants),
            cell(failures.without_condition)
        );
    }
    kept
}

/// A frequency with its interval, in percent.
fn frequency(count: u64, replications: u64) -> String {
    let (low, high) = (lower_bound(count, replications, TAIL), upper_bound(count, replications, TAIL));
    let rate = count as f64 / replications as f64;
    format!("{:.2} % [{:.2}, {:.2}]", 100.0 * rate, 100.0 * low, 100.0 * high)
}

fn run_between(experiment: &Experiment, layers: Layers, replications: u64) -> BetweenFailures {
    let one = |seed| experiment.replicate(layers, BETA, 1_000_000 + seed);
    let add = |mut all: BetweenFailures, one| {
        all += one;
        all
    };
    (0..replications).into_par_iter().map(one).reduce(BetweenFailures::default, add)
}

fn run(layout: Layout, noise: Noise, replications: u64) -> Failures {
    let seeds: Vec<u64> = (0..replications).collect();
    let parts = seeds.par_chunks(50).map(|seeds| {
        let mut failures = Failures::default();
        seeds.iter().for_each(|&seed| {
            // Other sets than those of the tests.
            failures += replicate(layout, noise, (SAMPLES, BETA), 1_000_000 + seed);
        });
        failures
    });
    parts.reduce(Failures::default, |mut all, one| {
        all += one;
        all
    })
}
