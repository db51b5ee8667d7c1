//! The robust expectation of a row, rounded in a known direction (O-maximization).
//!
//! For a row with bounds `l, u` and values `V` sorted ascending, `T_k` the successors from the `k`-th on
//! and `V_0 = 0`:
//!
//! `min_p p·V = Σ_k (V_k − V_{k−1}) min p(T_k)`, `min p(T) = max(Σ_T l, 1 − Σ_{Tᶜ} u)`,
//!
//! which is computed by giving every successor `l` and pouring the slack `1 − Σ l` from the lowest value
//! upwards, `u − l` each; for the maximum, from the highest value downwards.
//!
//! **What "exact" means.** A bound may be the double nearest to a decimal, so it can be read as that
//! decimal or as the double: `l(1+δ)`, `|δ| ≤ ε = 2⁻⁵³`. The bounds computed here hold for every reading
//! that admits a distribution. If rounding left none (`Σ l` or `Σ u` on the wrong side of 1 by at most
//! `m·2⁻⁵³`), the pouring itself is the definition: `l` plus `max(0, 1 − Σ l)` poured, mass 1 in total.
//!
//! **Why the rounding is sound.** Let `m` be the row's length. Since `V ≥ 0`, a bound on the mass of every
//! `T_k` is a bound on the expectation.
//! - The mass `Σ_T l` (or `Σ_T u`, for the maximum) has only positive terms: reading, products and sums
//!   change it by a factor within `1 ± (2m+8)ε`, which the last factor `1 ± 2(2m+8)ε` covers.
//! - The mass `1 − Σ_{Tᶜ} u` (or `1 − Σ_{Tᶜ} l`) matters only while slack is left, so only if
//!   `Σ_{Tᶜ} u ≤ 1`. It differs from the poured one by the reading and the difference `u − l`
//!   (`≤ 2ε` altogether), the sum `Σ l` (`≤ (m+1)ε`) and `m` subtractions from the remaining slack
//!   (`≤ mε`): less than `η = (2m+8)ε`, by which the slack is lowered or raised beforehand.
//! - Slack that finds no room goes to the highest value when the minimum is rounded up, and is dropped
//!   when a bound from below is wanted.
//! - Finally the result lies between the smallest and the largest value of the row (where `u > 0`).

use super::query::Direction;
use crate::model::{Row, RowId, Rows};
use crate::numeric::rounding_factor;

/// Which side of the exact value a result is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bound {
    /// At most the exact value.
    Lower,
    /// At least the exact value.
    Upper,
}

/// Covers underflow: products and bounds below the normal range lose absolute, not relative, accuracy.
const UNDERFLOW: f64 = 1e-300;

/// Rows with the order in which each was last sorted, which is nearly right for the next iteration.
#[derive(Clone, Debug)]
pub(super) struct RowBlock {
    pub rows: Vec<RowId>,
    /// The positions within each row, one row after the other, ascending in value.
    order: Vec<u32>,
    /// `1 − Σ l` of every row.
    slacks: Vec<f64>,
    scratch: Vec<f64>,
}

impl RowBlock {
    pub(super) fn new(all: &Rows, rows: Vec<RowId>) -> Self {
        let order = rows.iter().flat_map(|&row| 0..all.row_len(row) as u32).collect();
        let slacks = rows.iter().map(|&row| slack(all.row(row))).collect();
        Self { rows, order, slacks, scratch: vec![] }
    }

    /// The expectations of the rows of the block, in their order.
    pub(super) fn evaluate(
        &mut self,
        all: &Rows,
        values: &[f64],
        nature: Direction,
        side: Bound,
    ) -> Vec<f64> {
        let Self { rows, order, slacks, scratch } = self;
        let mut order = &mut order[..];
        let expectations = rows.iter().zip(slacks).map(|(&id, slack)| {
            let row = all.row(id);
            let (own, rest) = std::mem::take(&mut order).split_at_mut(row.len());
            order = rest;
            expectation((row, *slack), values, (own, scratch), nature, side)
        });
        expectations.collect()
    }
}

/// The least expectation of `values ≥ 0` that each row allows, rounded down.
pub fn worst_expectations(rows: &Rows, values: &[f64]) -> Vec<f64> {
    let all = RowId::first(rows.len()).collect();
    RowBlock::new(rows, all).evaluate(rows, values, Direction::Min, Bound::Lower)
}

/// `1 − Σ l`, to nearest.
fn slack(row: Row<'_>) -> f64 {
    1.0 - row.lower.iter().sum::<f64>()
}

/// A bound on `min_p p·V` or `max_p p·V`, see the module's documentation.
fn expectation(
    (row, slack): (Row<'_>, f64),
    values: &[f64],
    (order, scratch): (&mut [u32], &mut Vec<f64>),
    nature: Direction,
    side: Bound,
) -> f64 {
    if order.len() < 2 {
        // A single successor has all the mass.
        return values[row.successors[0].index()];
    }
    scratch.clear();
    scratch.extend(row.successors.iter().map(|&s| values[s.index()]));
    sort(order, scratch);
    // Successors that cannot have any mass bound nothing.
    let possible = |i: &&u32| row.upper[**i as usize] > 0.0;
    let value = |i: Option<&u32>| i.map_or(0.0, |&i| scratch[i as usize]);
    let (lowest, highest) = (value(order.iter().find(possible)), value(order.iter().rfind(possible)));
    if lowest == highest {
        return lowest;
    }
    let base = dot(row.lower, scratch);
    // `rounding_factor` doubles: this is η = (2m + 8)ε.
    let margin = rounding_factor(row.len() + 4);
    let slack = match side {
        Bound::Lower => (slack - margin).max(0.0),
        Bound::Upper => (slack + margin).max(0.0),
    };
    let poured = match nature {
        Direction::Min => {
            let (poured, left) = pour(row, scratch, slack, order.iter());
            if side == Bound::Upper { poured + left * highest } else { poured }
        }
        Direction::Max => pour(row, scratch, slack, order.iter().rev()).0,
    };
    let factor = rounding_factor(2 * row.len() + 8);
    match side {
        Bound::Lower => ((base + poured) * (1.0 - factor) - UNDERFLOW).max(lowest).min(highest),
        Bound::Upper => ((base + poured) * (1.0 + factor) + UNDERFLOW).min(highest).max(lowest),
    }
}

/// `Σ a b` in four interleaved sums, which the error bound for one sum covers as well.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (a, b) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a.remainder().iter().zip(b.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in a.zip(b) {
        for lane in 0..4 {
            sums[lane] += a[lane] * b[lane];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// Pours the slack in the given order; returns its share of the expectation and what found no room.
fn pour<'a>(
    row: Row<'_>,
    values: &[f64],
    mut slack: f64,
    order: impl Iterator<Item = &'a u32>,
) -> (f64, f64) {
    let mut sum = 0.0;
    for &i in order {
        let i = i as usize;
        let room = row.upper[i] - row.lower[i];
        if room >= slack {
            return (sum + slack * values[i], 0.0);
        }
        sum += room * values[i];
        slack -= room;
    }
    (sum, slack)
}

/// The distribution that attains the optimum, up to rounding: `p − l` by position.
pub(super) fn poured_mass(row: Row<'_>, values: &[f64], nature: Direction) -> Vec<f64> {
    let mut order: Vec<usize> = (0..row.len()).collect();
    order.sort_by(|&i, &j| values[row.successors[i].index()].total_cmp(&values[row.successors[j].index()]));
    if nature == Direction::Max {
        order.reverse();
    }
    let mut left = slack(row).max(0.0);
    let mut poured = vec![0.0; row.len()];
    for i in order {
        poured[i] = (row.upper[i] - row.lower[i]).min(left);
        left -= poured[i];
    }
    poured
}

/// Sorts positions by value; linear when they are nearly sorted.
fn sort(order: &mut [u32], values: &[f64]) {
    // Insertion sort moves an element at a time; beyond this many moves a general sort is cheaper.
    let mut budget = 4 * order.len() + 32;
    for i in 1..order.len() {
        let element = order[i];
        let key = values[element as usize];
        let mut j = i;
        while j > 0 && values[order[j - 1] as usize] > key {
            order[j] = order[j - 1];
            j -= 1;
        }
        order[j] = element;
        if i - j > budget {
            order
                .sort_unstable_by(|&a, &b| values[a as usize].total_cmp(&values[b as usize]).then(a.cmp(&b)));
            return;
        }
        budget -= i - j;
    }
}
