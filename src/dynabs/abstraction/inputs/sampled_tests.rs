//! How often what samples prove is wrong, and that it would be noticed if it were wrong too often.

use super::super::Footprint;
use super::reach::Reach;
use super::sampled::prove;
use crate::linear_algebra::ExactMatrix;
use crate::noise::known::Distribution;
use crate::problem::{Components, DrawnNoise, GaussianNoise, NoiseSource, StepSamples};
use crate::statistics::{lower_bound, upper_bound};
use crate::system::LinearSystem;
use imdp::numeric::{Rational, from_decimal};
use num_traits::{One, Zero};

const RUNS: u64 = 50;
const SAMPLES: u64 = 400;
/// What may fail, in tenths.
const BETA: i64 = 2;

fn samples(components: Components, seed: u64) -> StepSamples {
    let distribution = GaussianNoise { mean: None, covariance: vec![vec![1.0, 0.0], vec![0.0, 0.25]] };
    let source: NoiseSource = DrawnNoise { distribution, count: SAMPLES, seed }.into();
    let zeros = ExactMatrix::zeros(2, 1);
    let system = LinearSystem::new(ExactMatrix::identity(2), zeros.clone(), zeros);
    StepSamples {
        noise: source.obtain(&system, 1).unwrap(),
        components,
        beta: Rational::new(BETA.into(), 10.into()),
        sweep: 1,
        discard: 0,
    }
}

fn pitch() -> [Rational; 2] {
    [from_decimal(0.5).unwrap(), from_decimal(0.4).unwrap()]
}

/// The mass of `[kδ, (k+1)δ)` of a coordinate.
fn mass(j: usize, k: i64) -> f64 {
    let variance = [Rational::one(), Rational::new(1.into(), 4.into())][j].clone();
    let face = |k: i64| &pitch()[j] * Rational::from_integer(k.into());
    Distribution::Gaussian { mean: Rational::zero(), variance }
        .mass(Some(&face(k)), Some(&face(k + 1)))
        .middle()
}

/// Whether everything that was proved is true.
fn is_true(components: Components, seed: u64) -> bool {
    let reach = [Reach::new((-3, 13), 12, false), Reach::new((-3, 13), 12, false)];
    let proved = prove(&samples(components, seed), &pitch(), &reach, &mut Footprint::default()).unwrap();
    proved.noise.iter().enumerate().all(|(j, noise)| {
        let end = |j: usize, k: i64| k == reach[j].lowest || k == reach[j].highest;
        let of_tap = |first: &[i64]| match components {
            Components::Joint => mass(0, first[0]) * mass(1, first[1]),
            _ => mass(j, first[j]),
        };
        let listed: f64 = noise.taps.iter().map(|tap| of_tap(&tap.first)).sum();
        let taps = noise.taps.iter().all(|tap| {
            let truth = of_tap(&tap.first);
            end(0, tap.first[0]) || end(1, tap.first[1]) || tap.lower <= truth && truth <= tap.upper
        });
        taps && (1.0 - listed) <= noise.elsewhere + 1e-6
    })
}

#[test]
fn what_is_proved_is_rarely_wrong() {
    for components in [Components::Joint, Components::Intervals, Components::Bands] {
        let wrong = (0..RUNS).filter(|&seed| !is_true(components, seed)).count();
        assert!((wrong as i64) * 10 <= RUNS as i64 * BETA, "{components:?}: {wrong} of {RUNS}");
    }
}

/// The control: the same intervals, each at the whole level, are wrong far too often; so are the frequencies themselves.
#[test]
fn intervals_that_do_not_share_the_level_are_noticed() {
    let level = BETA as f64 / 10.0;
    let is_wrong = |seed: u64| {
        let samples = samples(Components::Joint, seed);
        (-6..6).any(|k| {
            let inside = |x: f64| (0.5 * k as f64..0.5 * (k + 1) as f64).contains(&x);
            let hits = samples.noise.samples.iter().filter(|sample| inside(sample[0])).count() as u64;
            let truth = mass(0, k);
            truth < lower_bound(hits, SAMPLES, level / 2.0) || truth > upper_bound(hits, SAMPLES, level / 2.0)
        })
    };
    let wrong = (0..RUNS).filter(|&seed| is_wrong(seed)).count() as i64;
    assert!(wrong * 10 > 2 * RUNS as i64 * BETA, "{wrong} of {RUNS}");
}
