//! How far two numbers may be apart.

/// Two numbers differ if they are further apart than both of these.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// The distance allowed.
    pub absolute: f64,
    /// The distance allowed, as a fraction of the larger magnitude.
    pub relative: f64,
}

impl Default for Tolerance {
    fn default() -> Self {
        Self { absolute: 1e-9, relative: 1e-9 }
    }
}

impl Tolerance {
    /// `|a − b|` if `|a − b| > absolute` and `|a − b| > relative · max(|a|, |b|)`.
    ///
    /// NaN differs from everything, infinitely.
    pub fn excess(self, a: f64, b: f64) -> Option<f64> {
        let by = (a - b).abs();
        if a == b {
            None
        } else if by.is_nan() {
            Some(f64::INFINITY)
        } else {
            (by > self.absolute && by > self.relative * a.abs().max(b.abs())).then_some(by)
        }
    }

    /// The larger of the distances by which the ends of two intervals differ, if any does.
    pub(super) fn interval_excess(self, a: (f64, f64), b: (f64, f64)) -> Option<f64> {
        let ends = [self.excess(a.0, b.0), self.excess(a.1, b.1)];
        ends.into_iter().flatten().reduce(f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::Tolerance;

    #[test]
    fn a_number_differs_if_it_exceeds_both_tolerances() {
        let tolerance = Tolerance { absolute: 0.5, relative: 0.25 };
        assert_eq!(tolerance.excess(1.0, 1.4), None);
        assert_eq!(tolerance.excess(10.0, 12.0), None);
        assert_eq!(tolerance.excess(1.0, 2.0), Some(1.0));
        assert_eq!(tolerance.excess(1.0, f64::NAN), Some(f64::INFINITY));
        let exact = Tolerance { absolute: 0.0, relative: 0.0 };
        assert_eq!(exact.excess(f64::INFINITY, f64::INFINITY), None);
        assert_eq!(exact.interval_excess((0.25, 0.5), (0.0, 1.0)), Some(0.5));
    }
}
