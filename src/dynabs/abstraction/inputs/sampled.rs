//! What samples prove of the noise on a lattice.
//!
//! **Claim.** Let the samples be independent of each other and of the noise at run time, all with one distribution (and, where
//! that is assumed, with components that are independent of each other). With probability at least `1 − β` over the samples
//! all bounds hold together: whatever the inputs, the dynamics, the task and the horizon, for they speak of the noise and of
//! the pitch of the lattice alone.
//!
//! **Proof.** The events are fixed by the lattice and by how far images are from the partition, before any sample is looked
//! at, and their levels sum to `β` ([`ConfidenceBudget`]):
//! - *jointly*: for every box `k` of the lattice that may matter, `P(η ∈ k)` lies between its two one-sided Clopper–Pearson
//!   bounds (*cells*), and `P(η ∉ W) ≤ ε` for the window of all samples but the farthest (*windows*,
//!   [`super::super::windows`]). Listed are the boxes of the window: what is not listed has at most `ε`.
//! - *intervals*: the same for each component by itself, with its part of `β`.
//! - *bands*: for each component, `sup |F − F_N| ≤ √(ln(2/β′) / 2N)` except with probability `β′` (Dvoretzky, Kiefer,
//!   Wolfowitz 1956, with Massart's constant, *Ann. Probab.* 18, 1990), for any distribution, limits from below included.
//!
//! Samples whose box is uncertain in floating point count for the upper bounds of all that they may lie in and for the lower
//! bounds of none. Boxes at the ends stand for everything beyond, which leads out of the partition from every image; where that
//! is not so, they are not listed. ∎

use super::InputsError;
use super::reach::Reach;
use crate::Warning;
use crate::abstraction::Footprint;
use crate::abstraction::cell_counts::CellCounts;
use crate::abstraction::pac::{offset_weight, total_offset_weight};
use crate::abstraction::placement::Placement;
use crate::abstraction::windows::{Stack, Windows};
use crate::guarantee::SampleEvidence;
use crate::landing::{Band, Stencil, Tap};
use crate::memory::Need;
use crate::noise::NoiseSamples;
use crate::partition::Grid;
use crate::problem::{Components, StepSamples};
use crate::statistics::{ConfidenceBudget, lower_bound, upper_bound};
use imdp::numeric::{Rational, round_decimal_down, round_decimal_up, to_f64};
use num_bigint::BigInt;
use num_traits::One;

/// What the family of cells gets of what is spent on boxes, in hundredths; windows get the rest.
const CELLS_SHARE: i64 = 85;

/// Written bounds have this many digits, rounded outwards.
const DIGITS: usize = 10;

/// More may not be unseen.
const MAX_UNSEEN: f64 = 0.5;

/// What a box takes, in all tables, and for every coordinate.
const BYTES_OF_BOX: u64 = 200;
const BYTES_OF_SIDE: u64 = 12;

/// What was found.
pub(super) struct Proved {
    /// The noise, one component after the other if they are independent.
    pub(super) noise: Vec<Stencil>,
    pub(super) evidence: SampleEvidence,
    pub(super) warnings: Vec<Warning>,
}

/// What `samples` prove on a lattice with these pitches.
pub(super) fn prove(
    samples: &StepSamples,
    pitch: &[Rational],
    reach: &[Reach],
    footprint: &mut Footprint,
) -> Result<Proved, InputsError> {
    let n = pitch.len();
    let whole = &samples.beta / Rational::from_integer(samples.sweep.into());
    let mut budget = ConfidenceBudget::new(whole);
    let all = &samples.noise.samples;
    let mut found = Proved { noise: vec![], evidence: evidence(samples), warnings: vec![] };
    match samples.components {
        Components::Joint => {
            let (cells, windows) = ("cells".to_owned(), "windows".to_owned());
            let family = Family { cells, windows, share: Rational::one() };
            let mut spent = (&mut budget, &mut *footprint);
            boxes(all, pitch, reach, &family, samples.discard, &mut spent, &mut found)?;
        }
        Components::Intervals => {
            for j in 0..n {
                let family = Family {
                    cells: format!("cells of coordinate {}", j + 1),
                    windows: format!("windows of coordinate {}", j + 1),
                    share: Rational::new(1.into(), n.into()),
                };
                let (own, before) = (component(all, j), found.noise.len());
                let one = (&pitch[j..=j], &reach[j..=j]);
                let mut spent = (&mut budget, &mut *footprint);
                boxes(&own, one.0, one.1, &family, samples.discard, &mut spent, &mut found)?;
                found.noise[before..].iter_mut().for_each(|noise| embed(noise, j, n));
            }
        }
        Components::Bands => {
            for j in 0..n {
                let share = Rational::new(1.into(), n.into());
                let one = BigInt::one();
                let grant = budget.spend(&format!("band of coordinate {}", j + 1), &share, &one, &one)?;
                let mut noise = band(&component(all, j), &pitch[j], &reach[j], grant.level(1));
                embed(&mut noise, j, n);
                found.evidence.unseen_mass = found.evidence.unseen_mass.max(noise.elsewhere);
                found.noise.push(noise);
            }
        }
    }
    found.evidence.budget = budget.allocations().to_vec();
    Ok(found)
}

fn evidence(samples: &StepSamples) -> SampleEvidence {
    SampleEvidence {
        follows_plan: false,
        number: samples.noise.samples.len() as u64,
        beta: to_f64(&samples.beta),
        sweep: samples.sweep,
        budget: vec![],
        unseen_mass: 0.0,
        components: Some(samples.components),
    }
}

/// The samples of one component.
fn component(samples: &NoiseSamples, j: usize) -> NoiseSamples {
    NoiseSamples::new(1, samples.iter().map(|sample| sample[j]).collect())
}

/// Makes a noise of one coordinate one of coordinate `j` of `n`.
fn embed(noise: &mut Stencil, j: usize, n: usize) {
    for tap in &mut noise.taps {
        let (own, size) = (tap.first[0], tap.size[0]);
        tap.first = (0..n).map(|i| if i == j { own } else { 0 }).collect();
        tap.size = (0..n).map(|i| if i == j { size } else { 1 }).collect();
    }
}

/// The names of the two families of events about boxes, and their part of the budget.
struct Family {
    cells: String,
    windows: String,
    share: Rational,
}

fn boxes(
    samples: &NoiseSamples,
    pitch: &[Rational],
    reach: &[Reach],
    family: &Family,
    discard: u64,
    (budget, footprint): &mut (&mut ConfidenceBudget, &mut Footprint),
    found: &mut Proved,
) -> Result<(), InputsError> {
    let n = pitch.len();
    let ranges: Vec<(i64, i64)> = reach.iter().map(|reach| (reach.lowest, reach.highest)).collect();
    let events: BigInt = ranges.iter().map(|(low, high)| BigInt::from(high - low + 1)).product();
    let share = |hundredths: i64| &family.share * Rational::new(hundredths.into(), 100.into());
    let weight = total_offset_weight(&ranges) * 2;
    let cells = budget.spend(&family.cells, &share(CELLS_SHARE), &events, &weight)?;
    let one = BigInt::one();
    let windows = budget.spend(&family.windows, &share(100 - CELLS_SHARE), &one, &one)?;

    let placement = Placement::of_noise(pitch, &ranges);
    let unit = Grid::new(&vec![Rational::default(); n], pitch, &vec![1; n])?;
    let stack = Stack { last: samples, between: &[], watched: &[] };
    let window = Windows::new(stack, &unit, Some(&placement), discard as usize, &[windows.level(1)]);
    let mut unseen = round_decimal_up(window.unseen().first().copied().unwrap_or(1.0), DIGITS).min(1.0);
    let number = samples.len() as u64;
    if unseen > MAX_UNSEEN {
        return Err(InputsError::TooFewSamples { samples: number, unseen });
    }
    found.evidence.unseen_mass = found.evidence.unseen_mass.max(unseen);
    found.warnings.extend(window.contradiction());
    let Some(listed) = window.cells(&placement).into_iter().next() else {
        return Err(InputsError::TooFewSamples { samples: number, unseen: 1.0 });
    };
    let mut table = listed.clone();
    samples.measured().for_each(|sample| table.include(&placement.spread(sample)));
    let sides = table.lower.iter().zip(&table.upper).map(|(low, high)| (high - low + 1) as u64);
    let bytes = sides.fold(BYTES_OF_BOX + BYTES_OF_SIDE * n as u64, u64::saturating_mul);
    footprint.take(Need { what: "the boxes of the noise", bytes, field: "/partition/cells" })?;
    let counts = CellCounts::new(samples, &placement, Some(&listed), None);
    let mut taps = vec![];
    listed.for_each(|place| {
        let is_known = |(reach, &k): (&Reach, &i32)| reach.is_known(i64::from(k));
        if !reach.iter().zip(place).all(is_known) {
            // The window goes beyond what is told apart: what is there may be any part of the rest.
            unseen = 1.0;
            return;
        }
        let count = counts.counts()[counts.table().position(place)];
        let square = place.iter().map(|&k| i64::from(k).pow(2) as u64).sum();
        let level = cells.level(offset_weight(n, square));
        let lower = lower_bound(count.certain[0].into(), number, level);
        let upper = upper_bound(count.possible.into(), number, level);
        taps.push(Tap {
            first: place.iter().map(|&k| i64::from(k)).collect(),
            size: vec![2; n],
            lower: round_decimal_down(lower, DIGITS),
            upper: round_decimal_up(upper, DIGITS).min(1.0),
        });
    });
    found.noise.push(Stencil { taps, elsewhere: unseen, band: None });
    Ok(())
}

/// The distribution function of a component, at the faces of the lattice.
fn band(samples: &NoiseSamples, pitch: &Rational, reach: &Reach, level: f64) -> Stencil {
    let number = samples.len() as f64;
    let width = ((2.0 / level).ln() / (2.0 * number)).sqrt() * (1.0 + 1e-14);
    let placement = Placement::of_noise(std::slice::from_ref(pitch), &[(reach.lowest, reach.highest)]);
    let (mut least, mut most): (Vec<i64>, Vec<i64>) = samples
        .measured()
        .map(|sample| placement.spread(sample))
        .map(|spread| (i64::from(spread.lower[0]), i64::from(spread.upper[0])))
        .unzip();
    least.sort_unstable();
    most.sort_unstable();
    // Of the lower edge of tap `k`: those below it for certain, and those that may be.
    let edge = |k: i64| {
        let certain = most.partition_point(|&at| at < k) as f64 / number;
        let possible = least.partition_point(|&at| at < k) as f64 / number;
        ((certain - width).next_down().max(0.0), (possible + width).next_up().min(1.0))
    };
    let (first, last) = reach.known();
    let mut edges: Vec<(f64, f64)> = (first..=last + 1).map(edge).collect();
    if reach.leads_out {
        // The taps at the ends are all that is beyond.
        let end = edges.len() - 1;
        (edges[0], edges[end]) = ((0.0, 0.0), (1.0, 1.0));
    }
    let tap = |(k, pair): (i64, &[(f64, f64)])| Tap {
        first: vec![k],
        size: vec![2],
        lower: (pair[1].0 - pair[0].1).next_down().max(0.0),
        upper: (pair[1].1 - pair[0].0).next_up().min(1.0),
    };
    let taps = (first..).zip(edges.windows(2)).map(tap).collect();
    let (below, above) = (edges[0].1, 1.0 - edges[edges.len() - 1].0);
    let elsewhere = if reach.leads_out { 0.0 } else { (below + above).next_up().min(1.0) };
    let (lower, upper) = edges.into_iter().unzip();
    Stencil { taps, elsewhere, band: Some(Band { lower, upper, is_complete: reach.leads_out }) }
}
