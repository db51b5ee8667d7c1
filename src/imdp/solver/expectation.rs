//! The robust expectation of a row, rounded in a known direction, without sorting.
//!
//! For a row with bounds `l ≤ p ≤ u` and values `V` the least expectation is, by duality of linear programs,
//!
//! `min_p p·V = max_τ  Σ l V + τ (1 − Σ l) − Σ (u − l) max(0, τ − V)`,
//!
//! a concave function of one number. It is attained where the successors with `V < τ` have just room for the slack `1 − Σ l`
//! and those with `V = τ` take the rest, so that
//!
//! `min_p p·V = Σ l V + Σ_{V<τ} (u − l) V + τ (1 − Σ l − Σ_{V<τ} (u − l))`,
//!
//! which is what pouring the slack from the lowest value upwards gives (O-maximization), in any order below `τ`; for the
//! maximum, `V > τ`. The successor that `τ` belonged to in the last iteration is mostly the right one, or next to it.
//!
//! **What "exact" means.** A bound may be the double nearest to a decimal, so it can be read as that
//! decimal or as the double: `l(1+δ)`, `|δ| ≤ ε = 2⁻⁵³`. The bounds computed here hold for every reading
//! that admits a distribution. If rounding left none (`Σ l` or `Σ u` on the wrong side of 1 by at most
//! `m·2⁻⁵³`), the pouring itself is the definition: `l` plus `max(0, 1 − Σ l)` poured, mass 1 in total.
//!
//! **Why the rounding is sound.** Let `m` be the row's length, the values `V_1 ≤ V_2 ≤ …`, `T_k` the successors from the
//! `k`-th on, `V_0 = 0`: `p·V = Σ_k (V_k − V_{k−1}) p(T_k)` and `min p(T) = max(Σ_T l, 1 − Σ_{Tᶜ} u)`. Since `V ≥ 0`, a bound
//! on the mass of every `T_k` is a bound on the expectation.
//! - The mass `Σ_T l` (or `Σ_T u`, for the maximum) has only positive terms: reading, products and sums
//!   change it by a factor within `1 ± (2m+8)ε`, which the last factor `1 ± 2(2m+8)ε` covers.
//! - The mass `1 − Σ_{Tᶜ} u` (or `1 − Σ_{Tᶜ} l`) matters only while slack is left, so only if
//!   `Σ_{Tᶜ} u ≤ 1`. It differs from the poured one by the reading and the difference `u − l`
//!   (`≤ 2ε` altogether), the sum `Σ l` (`≤ (m+1)ε`), the sum of the room below `τ` and its difference from the slack
//!   (`≤ (m+1)ε`): at most `η = (2m+8)ε`, by which the slack is lowered or raised beforehand.
//! - The room below `τ` and up to it is summed up in the same order for every `τ`, so rounding keeps it monotone: a threshold
//!   always exists, and where the sums say that slack is left it is, to within the same `η`.
//! - Slack that finds no room goes to the highest value when the minimum is rounded up, and is dropped
//!   when a bound from below is wanted.
//! - Finally the result lies between the smallest and the largest value of the row (where `u > 0`).

use super::query::Direction;
use super::threshold::{FirstPass, Scratch, Threshold};
use crate::model::{Row, RowBuffer, RowId, RowSet};
use crate::numeric::rounding_factor;
use fearless_simd::{Level, dispatch};

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

/// Rows with the thresholds of their last evaluation, which are nearly right for the next one.
#[derive(Clone, Debug)]
pub(super) struct RowBlock {
    pub rows: Vec<RowId>,
    /// The position in each row of the successor whose value is the threshold.
    critical: Vec<u32>,
    /// `1 − Σ l` of every row.
    slacks: Vec<f64>,
}

/// Room for the evaluation of one row after the other.
#[derive(Clone, Debug, Default)]
pub(super) struct Workspace {
    /// For as many values of a state as are looked at together.
    scratch: [Scratch; 2],
    buffer: RowBuffer,
}

impl RowBlock {
    /// The rows, ascending, which are not [prepared](Self::prepare).
    pub(super) fn new(rows: Vec<RowId>) -> Self {
        Self { rows, critical: vec![], slacks: vec![] }
    }

    /// The place of its first row among all rows.
    pub(super) fn start(&self) -> usize {
        self.rows.first().map_or(0, |row| row.index())
    }

    /// The place after its last row.
    pub(super) fn end(&self) -> usize {
        self.rows.last().map_or(0, |row| row.index() + 1)
    }

    /// Gets ready to evaluate the rows.
    pub(super) fn prepare(&mut self, all: &RowSet, Workspace { buffer, .. }: &mut Workspace) {
        self.slacks = self.rows.iter().map(|&row| slack(all.row(row, buffer))).collect();
        self.critical = vec![0; self.rows.len()];
    }

    /// The expectations of the rows of the block at one or two values of every state, those `wanted`: each row is looked at once.
    ///
    /// They are written to `out`, where the first row of the block is first and others have their places after it. The machine code is
    /// the best that the processor has; as sums have fixed [lanes](super::threshold), the results are the same everywhere.
    pub(super) fn evaluate<const N: usize>(
        &mut self,
        all: &RowSet,
        values: &[[f64; N]],
        way: (Direction, [Bound; N]),
        wanted: impl Fn(RowId) -> [bool; N],
        out: [&mut [f64]; N],
        workspace: &mut Workspace,
    ) {
        dispatch!(Level::new(), _ => self.evaluate_here(all, values, way, wanted, out, workspace));
    }

    #[inline(always)]
    fn evaluate_here<const N: usize>(
        &mut self,
        all: &RowSet,
        values: &[[f64; N]],
        (nature, sides): (Direction, [Bound; N]),
        wanted: impl Fn(RowId) -> [bool; N],
        out: [&mut [f64]; N],
        Workspace { scratch, buffer }: &mut Workspace,
    ) {
        let Self { rows, critical, slacks } = self;
        let Some(&first) = rows.first() else { return };
        for ((&id, &slack), critical) in rows.iter().zip(&*slacks).zip(critical) {
            let wanted = wanted(id);
            if wanted == [false; N] {
                continue;
            }
            let row = all.row(id, buffer);
            let [one, other] = scratch.each_mut().map(|scratch| &mut scratch.values);
            if N == 1 {
                one.clear();
                one.extend(row.successors.iter().map(|successor| values[successor.index()][0]));
            } else {
                // Successors are far apart in memory, so both of their values are fetched together.
                one.resize(row.len(), 0.0);
                other.resize(row.len(), 0.0);
                for (successor, (one, other)) in row.successors.iter().zip(one.iter_mut().zip(other)) {
                    let values = &values[successor.index()];
                    (*one, *other) = (values[0], values[N - 1]);
                }
            }
            for i in (0..N).filter(|&i| wanted[i]) {
                let parts = (&mut *critical, &mut scratch[i]);
                out[i][id.index() - first.index()] = expectation((row, slack), parts, nature, sides[i]);
            }
        }
    }
}

/// The least expectations that rows allow, one row after the other: quickest if their values are alike.
#[derive(Clone, Debug, Default)]
pub struct WorstExpectation {
    /// That of the row before.
    threshold: f64,
    scratch: Scratch,
}

impl WorstExpectation {
    /// The least expectation of `values ≥ 0` that a row allows, rounded down.
    pub fn of(&mut self, row: Row<'_>, values: &[f64]) -> f64 {
        let near = row.successors.iter().position(|s| values[s.index()] == self.threshold);
        let mut critical = near.unwrap_or(0) as u32;
        self.scratch.values.clear();
        self.scratch.values.extend(row.successors.iter().map(|&s| values[s.index()]));
        let (own, parts) = ((row, slack(row)), (&mut critical, &mut self.scratch));
        let worst = dispatch!(Level::new(), _ => expectation(own, parts, Direction::Min, Bound::Lower));
        self.threshold = row.successors.get(critical as usize).map_or(0.0, |s| values[s.index()]);
        worst
    }
}

/// `1 − Σ l`, to nearest.
fn slack(row: Row<'_>) -> f64 {
    1.0 - row.lower.iter().sum::<f64>()
}

/// A bound on `min_p p·V` or `max_p p·V` for the values of its successors, see the module's documentation.
#[inline(always)]
fn expectation(
    (row, slack): (Row<'_>, f64),
    (critical, scratch): (&mut u32, &mut Scratch),
    nature: Direction,
    side: Bound,
) -> f64 {
    if row.len() < 2 {
        // A single successor has all the mass.
        return scratch.values[0];
    }
    // `rounding_factor` doubles: this is η = (2m + 8)ε.
    let margin = rounding_factor(row.len() + 4);
    let slack = match side {
        Bound::Lower => (slack - margin).max(0.0),
        Bound::Upper => (slack + margin).max(0.0),
    };
    let pass = match nature {
        Direction::Min => FirstPass::new(row, scratch, *critical, |a, b| a < b),
        Direction::Max => FirstPass::new(row, scratch, *critical, |a, b| a > b),
    };
    let FirstPass { lowest, highest, base, ref before } = pass;
    if lowest >= highest {
        return lowest.min(highest).max(0.0);
    }
    let threshold = match nature {
        Direction::Min => Threshold::find(row, scratch, slack, (critical, before), |a, b| a < b),
        Direction::Max => Threshold::find(row, scratch, slack, (critical, before), |a, b| a > b),
    };
    let poured = match (nature, side) {
        (Direction::Min, Bound::Upper) => threshold.poured + threshold.left * highest,
        _ => threshold.poured,
    };
    let factor = rounding_factor(2 * row.len() + 8);
    match side {
        Bound::Lower => ((base + poured) * (1.0 - factor) - UNDERFLOW).max(lowest).min(highest),
        Bound::Upper => ((base + poured) * (1.0 + factor) + UNDERFLOW).min(highest).max(lowest),
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Rows, StateId};
    use proptest::prelude::*;

    /// Pours into one successor after the other, sorted by value.
    fn sorted(row: Row<'_>, values: &[f64], nature: Direction) -> f64 {
        let poured = poured_mass(row, values, nature);
        let mass = poured.iter().zip(row.lower).map(|(p, l)| p + l);
        mass.zip(row.successors).map(|(p, &s)| p * values[s.index()]).sum()
    }

    proptest! {
        /// From one evaluation to the next thresholds may move anywhere; values are often equal.
        #[test]
        fn thresholds_say_what_sorting_says(
            entries in prop::collection::vec((0.0f64..1.0, 0.0f64..1.0), 2..40),
            rounds in prop::collection::vec(prop::collection::vec(0u32..12, 40), 1..6),
        ) {
            let total: f64 = entries.iter().map(|(low, _)| low + 0.1).sum();
            let mut rows = Rows::new();
            let room: f64 = 1.0 - entries.iter().map(|(low, _)| low / total).sum::<f64>();
            for (i, (low, more)) in entries.iter().enumerate() {
                // Some of the rows have just enough room.
                let more = if i == 0 { room } else { more * room };
                rows.push_entry(StateId::from_index(i), low / total, (low / total + more).min(1.0));
            }
            let id = rows.finish_row();
            let rows = RowSet::from(rows);
            let mut workspace = Workspace::default();
            let mut block = RowBlock::new(vec![id]);
            block.prepare(&rows, &mut workspace);
            let mut buffer = RowBuffer::default();
            for values in rounds {
                let values: Vec<f64> = values.into_iter().map(|v| f64::from(v) / 11.0).collect();
                for nature in [Direction::Min, Direction::Max] {
                    let expected = sorted(rows.row(id, &mut buffer), &values, nature);
                    let (mut low, mut high) = ([0.0], [0.0]);
                    let (sides, out) = ([Bound::Lower, Bound::Upper], [&mut low[..], &mut high[..]]);
                    let both: Vec<[f64; 2]> = values.iter().map(|&value| [value; 2]).collect();
                    block.evaluate(&rows, &both, (nature, sides), |_| [true; 2], out, &mut workspace);
                    let ([low], [high]) = (low, high);
                    prop_assert!(low <= expected && expected <= high, "{low} {expected} {high}");
                    prop_assert!(high - low < 1e-12, "{low} {high}");
                }
            }
        }
    }
}
