//! The intervals of the published tool, to the last printed digit.

use super::clopper_pearson::{lower_bound, upper_bound};

/// Probability intervals as the published reference tool prints them: for comparison, not a guarantee.
///
/// With `k` of `N` samples outside a cell and `b = β / (2N)`,
/// `P_low = 1 − I⁻¹(1−b; k+1, N−k)` (0 at `k = N`) and `P_upp = 1 − I⁻¹(b; k, N−k+1)` (1 at `k = 0`): the
/// Clopper–Pearson bounds of the mass inside at one-sided level `b`. There is no union over intervals.
#[derive(Clone, Copy, Debug)]
pub struct ReferenceIntervals {
    samples: u64,
    level: f64,
}

/// `f(x) = rint((x − 0.5·10⁻⁵)·10⁵) / 10⁵` in doubles, ties to even: the published tool's way to five digits.
fn print_rounding(x: f64) -> f64 {
    ((x - 0.5e-5) * 1e5).round_ties_even() / 1e5
}

impl ReferenceIntervals {
    /// Intervals from `samples` samples at `β` per interval.
    pub fn new(samples: u64, beta: f64) -> Self {
        Self { samples, level: beta / (2.0 * samples as f64) }
    }

    /// `(P_low, P_upp)` for a set with `inside` samples in it, before printing.
    pub fn exact(&self, inside: u64) -> (f64, f64) {
        (lower_bound(inside, self.samples, self.level), upper_bound(inside, self.samples, self.level))
    }

    /// The interval of a cell with `inside` samples in it, as printed.
    pub fn of_cell(&self, inside: u64) -> (f64, f64) {
        let (low, upp) = self.exact(inside);
        Self::printed(low, upp)
    }

    /// The interval of "outside the partition" with `inside` samples in it: `[1 − P_upp, 1 − P_low]`.
    pub fn of_outside(&self, inside: u64) -> (f64, f64) {
        let (low, upp) = self.exact(inside);
        Self::printed(1.0 - upp, 1.0 - low)
    }

    /// `lb → f(max(10⁻⁴, f(lb)))`, `ub → f(min(1, f(ub)))`.
    fn printed(low: f64, upp: f64) -> (f64, f64) {
        let lower = print_rounding(print_rounding(low).max(1e-4));
        let upper = print_rounding(print_rounding(upp).min(1.0));
        (lower, upper)
    }
}
