//! Whether the intervals of a choice admit a distribution, judged on the decimals as written.

use std::cmp::Ordering;

use super::exact_sum::ExactSum;
use crate::model::End;
use crate::numeric::{round_decimal_down, round_decimal_up, rounding_factor};

/// Covers the roundings of a scaled bound, with room to spare below the 15 digits it is rounded to.
const SCALING_MARGIN: f64 = 4e-15;

/// What [`judge`] did to the bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Judgement {
    /// The lower bounds exceeded 1 by at most 10⁻⁹ and now contain what was written and a distribution.
    pub lowered: bool,
    /// The upper bounds missed 1 by at most 10⁻⁹ and now contain what was written and a distribution.
    pub raised: bool,
}

impl Judgement {
    /// They admit a distribution as they are.
    pub(crate) const FINE: Self = Self { lowered: false, raised: false };

    /// Whether bounds were changed at one end.
    pub(crate) fn changed(self, end: End) -> bool {
        match end {
            End::Lower => self.lowered,
            End::Upper => self.raised,
        }
    }
}

/// Bounds that admit no distribution.
#[derive(Debug, PartialEq)]
pub(crate) struct NoDistribution {
    /// What the sum should be.
    pub expected: &'static str,
    /// What it is.
    pub sum: String,
}

/// Whether sums of `len` doubles decide the question without looking at the decimals.
///
/// Reading and adding err by less than `len` roundings each.
#[inline]
pub(crate) fn is_clear(len: usize, lower_sum: f64, upper_sum: f64) -> bool {
    let allowance = rounding_factor(2 * len);
    lower_sum <= 1.0 - allowance && upper_sum >= 1.0 + allowance
}

/// Sums the written bounds of one choice exactly and widens them where they miss 1 by at most 10⁻⁹.
///
/// `written` gives the texts of the bounds, any number of times.
pub(crate) fn judge<'t, 'b, I: Iterator<Item = (&'t [u8], &'t [u8])>>(
    written: impl Fn() -> I,
    bounds: impl Iterator<Item = (&'b mut f64, &'b mut f64)>,
) -> Result<Judgement, NoDistribution> {
    let lower = ExactSum::of(written().map(|(lower, _)| lower));
    // A plain number is both bounds.
    let plain = written().all(|(lower, upper)| lower == upper);
    let upper = if plain { lower.clone() } else { ExactSum::of(written().map(|(_, upper)| upper)) };
    let lower_misses = lower.cmp_one() == Ordering::Greater;
    let upper_misses = upper.cmp_one() == Ordering::Less;
    if lower_misses && !lower.is_nearly_one() {
        let expected = "lower bounds of one choice that sum to at most 1";
        return Err(NoDistribution { expected, sum: lower.to_text() });
    }
    if upper_misses && !upper.is_nearly_one() {
        let expected = "upper bounds of one choice that sum to at least 1";
        return Err(NoDistribution { expected, sum: upper.to_text() });
    }
    for (lower_bound, upper_bound) in bounds.filter(|_| lower_misses || upper_misses) {
        if lower_misses && *lower_bound > 0.0 {
            let scaled = *lower_bound * (1.0 - lower.distance_from_one() - SCALING_MARGIN);
            *lower_bound = round_decimal_down(scaled, 15);
        }
        if upper_misses && *upper_bound > 0.0 {
            let scaled = *upper_bound * (1.0 + upper.distance_from_one() + SCALING_MARGIN);
            *upper_bound = round_decimal_up(scaled, 15).min(1.0);
        }
    }
    Ok(Judgement { lowered: lower_misses, raised: upper_misses })
}

/// The two bounds in the text of an interval that has been parsed before, blanks around them aside.
///
/// A plain number is both.
pub(crate) fn written_bounds(interval: &[u8]) -> Option<(&[u8], &[u8])> {
    let Some(inside) = interval.strip_prefix(b"[").and_then(|rest| rest.strip_suffix(b"]")) else {
        return Some((interval, interval));
    };
    let comma = inside.iter().position(|&byte| byte == b',')?;
    Some((inside[..comma].trim_ascii(), inside[comma + 1..].trim_ascii()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::{Rational, from_decimal, from_dyadic};

    fn judged(lines: &str, lower: &mut [f64], upper: &mut [f64]) -> Result<Judgement, NoDistribution> {
        let written = || lines.split('\n').filter_map(|line| written_bounds(line.as_bytes()));
        judge(written, lower.iter_mut().zip(upper.iter_mut()))
    }

    #[test]
    fn sums_that_miss_by_little_are_widened() {
        let lines = "[0.5000000003,0.6]\n[0.5000000004, 0.6]";
        let (mut lower, mut upper) = ([0.5000000003, 0.5000000004], [0.6, 0.6]);
        let original = lower;
        assert_eq!(judged(lines, &mut lower, &mut upper), Ok(Judgement { lowered: true, raised: false }));
        for reading in [from_decimal, from_dyadic] {
            let sum: Rational = lower.iter().map(|&x| reading(x).unwrap()).sum();
            assert!(sum <= from_decimal(1.0).unwrap(), "{sum}");
        }
        for (new, old) in lower.into_iter().zip(original) {
            assert!(new <= old && old - new < 1e-8);
        }
        assert_eq!(upper, [0.6, 0.6]);

        let lines = "0.3333333333\n0.3333333333\n0.3333333333";
        let (mut lower, mut upper) = ([0.3333333333; 3], [0.3333333333; 3]);
        assert_eq!(judged(lines, &mut lower, &mut upper), Ok(Judgement { lowered: false, raised: true }));
        assert_eq!(lower, [0.3333333333; 3]);
        for reading in [from_decimal, from_dyadic] {
            let sum: Rational = upper.iter().map(|&x| reading(x).unwrap()).sum();
            assert!(sum >= from_decimal(1.0).unwrap(), "{sum}");
        }
    }

    #[test]
    fn the_decimals_decide() {
        let exact = "0.1\n0.2\n0.7";
        assert_eq!(judged(exact, &mut [0.1, 0.2, 0.7], &mut [0.1, 0.2, 0.7]), Ok(Judgement::FINE));
        let above = "[0.5,1]\n[0.50000000100000000000001,1]";
        assert_eq!(judged(above, &mut [0.5; 2], &mut [1.0; 2]).unwrap_err().sum, "1.00000000100000000000001");
    }
}
