//! The guarantee itself: over many sample sets from known distributions, the claims hold as often as promised.
//!
//! `cargo bench --bench coverage` repeats this thousands of times.
#![allow(missing_docs, clippy::unwrap_used, unreachable_pub)]

mod between;
mod noise;
mod replication;
mod truth;

use between::{BetweenFailures, Experiment, Layers};
use dynabs::statistics::{lower_bound, upper_bound};
use noise::Noise;
use rayon::prelude::*;
use replication::{Failures, replicate};
use truth::Layout;

const REPLICATIONS: u64 = 200;
/// A confidence budget so large that failures are visible.
const BETA: f64 = 0.2;
const SAMPLES: usize = 200;

/// Four standard deviations of the observed frequency of an event with this probability.
fn noise_of(probability: f64) -> f64 {
    4.0 * (probability * (1.0 - probability) / REPLICATIONS as f64).sqrt()
}

fn failures(layout: Layout, noise: Noise) -> Failures {
    let mut failures = Failures::default();
    for seed in 0..REPLICATIONS {
        failures += replicate(layout, noise, (SAMPLES, BETA), seed);
    }
    println!("{layout:?}, {noise:?}, {REPLICATIONS} replications: {failures:?}");
    failures
}

#[test]
fn claims_hold_together_as_often_as_promised() {
    let layouts = Noise::ALL.map(|noise| (Layout::Centers, noise)).into_iter();
    for (layout, noise) in layouts.chain([
        (Layout::Points, Noise::Gaussian),
        (Layout::Points, Noise::Bimodal),
        (Layout::InOrder, Noise::Gaussian),
    ]) {
        let failures = failures(layout, noise);
        let rate = |count: u64| count as f64 / REPLICATIONS as f64;
        assert!(rate(failures.rows) <= BETA, "{layout:?} {noise:?}: {failures:?}");
        // A bound on the goal is one of its own or the sum of its cells'; `failed` rests on two families.
        for (count, share) in [(failures.cells, 0.34), (failures.goal, 0.42), (failures.failed, 0.58)] {
            let budget = share * BETA;
            assert!(rate(count) <= budget + noise_of(budget), "{layout:?} {noise:?}: {failures:?}");
        }
        assert!(rate(failures.values) <= BETA, "{layout:?} {noise:?}: {failures:?}");
        // A control: the test does notice broken promises. Uniform noise meets too few cells for this one.
        if noise != Noise::Uniform {
            assert!(rate(failures.without_union) > 2.0 * BETA, "{layout:?} {noise:?}: {failures:?}");
        }
    }
}

#[test]
fn unseen_mass_is_needed() {
    // Heavy tails need windows as large as the grid, beyond which everything is lost, not unseen.
    for noise in [Noise::Gaussian, Noise::Bimodal, Noise::Correlated] {
        let failures = failures(Layout::Centers, noise);
        let rate = failures.without_unseen as f64 / REPLICATIONS as f64;
        assert!(rate > BETA, "{noise:?}: {failures:?}");
    }
}

#[test]
fn boxes_have_the_measure_that_samples_say() {
    let boxes = [([-0.3, -0.2], [0.5, 0.1]), ([-9.0, -9.0], [0.1, 9.0]), ([0.4, 0.2], [1.5, 2.0])];
    for noise in Noise::ALL {
        let samples = noise.draw(40_000, 1);
        for (lower, upper) in boxes {
            let inside = |x: &&[f64]| (0..2).all(|j| lower[j] <= x[j] && x[j] < upper[j]);
            let rate = samples.chunks_exact(2).filter(inside).count() as f64 / 40_000.0;
            let p = noise.measure(lower, upper);
            assert!((rate - p).abs() <= 4.5 * (p * (1.0 - p) / 40_000.0).sqrt(), "{noise:?}: {rate} {p}");
        }
        let all = noise.measure([f64::NEG_INFINITY; 2], [f64::INFINITY; 2]);
        assert!((all - 1.0).abs() < 1e-12, "{noise:?}: {all}");
    }
}

#[test]
fn every_step_of_a_group_is_covered() {
    let experiment = Experiment::new();
    for layers in [Layers::One, Layers::Two] {
        assert!(experiment.best_value(layers, BETA, 1) > 0.5);
        let mut failures = BetweenFailures::default();
        let one = |seed| experiment.replicate(layers, BETA, seed);
        let all: Vec<BetweenFailures> = (0..REPLICATIONS).into_par_iter().map(one).collect();
        all.into_iter().for_each(|one| failures += one);
        println!("in between, {layers:?}, {REPLICATIONS} replications: {failures:?}");
        // If promises failed with probability β, so few failures were less likely than one in a thousand.
        let at_most = |count| upper_bound(count, REPLICATIONS, 0.001);
        assert!(at_most(failures.rows) < BETA && at_most(failures.values) < BETA, "{failures:?}");
        // Controls: what holds at grouped instants does not hold at every step, nor does a count of all samples.
        let at_least = |count| lower_bound(count, REPLICATIONS, 0.001);
        assert!(at_least(failures.rows_at_instants) > 2.0 * BETA, "{failures:?}");
        assert!(at_least(failures.without_condition) > 2.0 * BETA, "{failures:?}");
    }
}
