//! What makes a list of intervals not a row.

use super::exact_row::ExactRow;
use super::{Row, StateId};

/// What makes a list of intervals not a row.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RowError {
    /// There is no successor.
    #[error("found no successors; expected at least one")]
    Empty,
    /// The successors are not strictly ascending.
    #[error("found successor {successor} out of order or twice; expected them ascending")]
    Order {
        /// The successor.
        successor: StateId,
    },
    /// An interval is not within `[0, 1]` or its ends are swapped.
    #[error("found the interval [{lower}, {upper}] of successor {successor}; expected one within [0, 1]")]
    Interval {
        /// The successor.
        successor: StateId,
        /// Its lower bound.
        lower: f64,
        /// Its upper bound.
        upper: f64,
    },
    /// No distribution fits because the lower bounds exceed 1.
    #[error("found lower bounds that sum to {sum}; expected at most 1")]
    LowerSum {
        /// The sum.
        sum: f64,
    },
    /// No distribution fits because the upper bounds do not reach 1.
    #[error("found upper bounds that sum to {sum}; expected at least 1")]
    UpperSum {
        /// The sum.
        sum: f64,
    },
}

impl Row<'_> {
    /// Checks that some distribution satisfies the row.
    ///
    /// `0 ≤ l ≤ u ≤ 1` entry by entry, and `Σ l ≤ 1 ≤ Σ u`. Each bound may be the double nearest to a
    /// decimal, so the sums are allowed what such roundings explain: as much as the exact checker of certificates
    /// allows.
    ///
    /// # Errors
    /// The first [`RowError`] found.
    pub fn validate(&self) -> Result<(), RowError> {
        if self.is_empty() {
            return Err(RowError::Empty);
        }
        if let Some(pair) = self.successors.windows(2).find(|pair| pair[0] >= pair[1]) {
            return Err(RowError::Order { successor: pair[1] });
        }
        for (i, &successor) in self.successors.iter().enumerate() {
            let (lower, upper) = (self.lower[i], self.upper[i]);
            // Written so that NaN fails.
            if !(0.0 <= lower && lower <= upper && upper <= 1.0) {
                return Err(RowError::Interval { successor, lower, upper });
            }
        }
        let allowance = self.len() as f64 * crate::numeric::UNIT_ROUNDOFF;
        let lower_excess = sum_minus_one(self.lower);
        if lower_excess > allowance {
            return Err(RowError::LowerSum { sum: 1.0 + lower_excess });
        }
        let upper_excess = sum_minus_one(self.upper);
        if upper_excess < -allowance {
            return Err(RowError::UpperSum { sum: 1.0 + upper_excess });
        }
        // So close to 1 the checker's exact sums decide: what it does not take for a row is none.
        let is_close = lower_excess > -allowance || upper_excess < allowance;
        if is_close && ExactRow::new(*self).is_none() {
            let lower = lower_excess > -upper_excess;
            return Err(match lower {
                true => RowError::LowerSum { sum: 1.0 + lower_excess },
                false => RowError::UpperSum { sum: 1.0 + upper_excess },
            });
        }
        Ok(())
    }
}

/// `Σ values − 1` by compensated summation, accurate to far below an ulp of 1.
fn sum_minus_one(values: &[f64]) -> f64 {
    let (mut sum, mut compensation) = (-1.0, 0.0);
    for &value in values {
        let next: f64 = sum + value;
        let virtual_value = next - sum;
        compensation += (sum - (next - virtual_value)) + (value - virtual_value);
        sum = next;
    }
    sum + compensation
}

#[cfg(test)]
mod tests {
    use super::super::Rows;
    use super::*;

    fn check(entries: &[(StateId, f64, f64)]) -> Result<(), RowError> {
        let mut rows = Rows::new();
        for &(successor, lower, upper) in entries {
            rows.push_entry(successor, lower, upper);
        }
        let id = rows.finish_row();
        rows.row(id).validate()
    }

    #[test]
    fn rows_must_admit_a_distribution() {
        assert_eq!(check(&[(StateId(0), 0.0, 0.5), (StateId(3), 0.5, 1.0)]), Ok(()));
        assert_eq!(check(&[]), Err(RowError::Empty));
        assert_eq!(
            check(&[(StateId(3), 0.5, 1.0), (StateId(3), 0.0, 0.5)]),
            Err(RowError::Order { successor: StateId(3) })
        );
        assert!(matches!(
            check(&[(StateId(0), 0.6, 0.5), (StateId(1), 0.0, 1.0)]),
            Err(RowError::Interval { .. })
        ));
        assert!(matches!(check(&[(StateId(0), 0.0, f64::NAN)]), Err(RowError::Interval { .. })));
        assert!(matches!(
            check(&[(StateId(0), 0.6, 1.0), (StateId(1), 0.5, 1.0)]),
            Err(RowError::LowerSum { .. })
        ));
        assert!(matches!(
            check(&[(StateId(0), 0.0, 0.6), (StateId(1), 0.0, 0.3)]),
            Err(RowError::UpperSum { .. })
        ));
    }

    #[test]
    fn sums_are_those_of_the_decimals() {
        // Ten times the double nearest to 0.1 is above 1, ten times the decimal is not.
        let tenths: Vec<_> = (0..10).map(|s| (StateId(s), 0.1, 0.1)).collect();
        assert_eq!(check(&tenths), Ok(()));
        let more: Vec<_> = (0..10).map(|s| (StateId(s), 0.1 + 1e-15, 0.2)).collect();
        assert!(matches!(check(&more), Err(RowError::LowerSum { .. })));
    }
}
