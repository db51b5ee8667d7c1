//! Whether values agree with bounds.

use super::{Agreement, EngineQuestion};
use crate::compare::Tolerance;
use crate::model::IntervalMdp;
use crate::numeric::UNIT_ROUNDOFF;
use crate::solver::ValueBounds;

/// Values against bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Judgement {
    pub agreement: Agreement,
    /// No value is further from one within the bounds than this.
    pub difference: f64,
    /// The state where it is.
    pub state: usize,
}

/// What an engine may differ by, and why.
///
/// With a bound on the steps there is rounding only: a step over rows of `m` entries adds at most `(m + 2) 2⁻⁵³`,
/// for the engine to nearest and for us outwards. Without one it depends on when the engine stops.
pub(super) fn tolerance(
    question: &EngineQuestion,
    model: &IntervalMdp,
    stopping: &str,
) -> (Tolerance, String) {
    let longest = model.rows().iter().map(|row| row.len()).max().unwrap_or(0) as f64;
    match question.steps() {
        Some(steps) => {
            let absolute = BOUNDED.max(4.0 * steps as f64 * (longest + 2.0) * UNIT_ROUNDOFF);
            let why = format!("{absolute:.0e} with a bound on the steps: rounding only");
            (Tolerance { absolute, relative: 0.0 }, why)
        }
        None => {
            let why = format!(
                "{UNBOUNDED:.0e} of the value without a bound on the steps: it {stopping}, which bounds no error"
            );
            (Tolerance { absolute: NEGLIGIBLE, relative: UNBOUNDED }, why)
        }
    }
}

const BOUNDED: f64 = 1e-12;
const UNBOUNDED: f64 = 1e-6;
/// Differences of values next to 0 that are not looked at relatively.
const NEGLIGIBLE: f64 = 1e-9;

/// Compares every state's value with its bounds.
///
/// A value outside its bounds by more than the tolerance disagrees. Bounds wider than the tolerance
/// cannot confirm anything.
pub(super) fn judge(values: &[f64], bounds: &ValueBounds, tolerance: Tolerance) -> Judgement {
    let mut judgement = Judgement { agreement: Agreement::Agrees, difference: 0.0, state: 0 };
    for (state, &value) in values.iter().enumerate() {
        let (lower, upper) = (bounds.lower[state], bounds.upper[state]);
        // What is equal does not differ, not even if it is infinite.
        let above = |a: f64, b: f64| if a == b { 0.0 } else { a - b };
        let difference = above(value, lower).max(above(upper, value));
        if difference > judgement.difference {
            judgement = Judgement { difference, state, ..judgement };
        }
        let far = |end| tolerance.excess(value, end).is_some();
        if (value < lower && far(lower)) || (value > upper && far(upper)) {
            judgement.agreement = Agreement::Disagrees;
        } else if (far(lower) || far(upper)) && judgement.agreement == Agreement::Agrees {
            judgement.agreement = Agreement::Undecided;
        }
    }
    judgement
}

/// Bounds that hold for both.
pub(super) fn hull(a: &ValueBounds, b: &ValueBounds) -> ValueBounds {
    let with = |a: &[f64], b: &[f64], pick: fn(f64, f64) -> f64| {
        a.iter().zip(b).map(|(&a, &b)| pick(a, b)).collect()
    };
    ValueBounds { lower: with(&a.lower, &b.lower, f64::min), upper: with(&a.upper, &b.upper, f64::max) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOLERANCE: Tolerance = Tolerance { absolute: 1e-6, relative: 0.0 };

    fn judged(value: f64, lower: f64, upper: f64) -> Agreement {
        let bounds = ValueBounds { lower: vec![0.0, lower], upper: vec![0.0, upper] };
        judge(&[0.0, value], &bounds, TOLERANCE).agreement
    }

    #[test]
    fn wide_bounds_confirm_nothing_and_refute_what_is_outside() {
        assert_eq!(judged(0.5, 0.5, 0.5 + 1e-7), Agreement::Agrees);
        assert_eq!(judged(0.5, 0.5 - 2e-6, 0.5 + 1e-7), Agreement::Undecided);
        assert_eq!(judged(0.5, 0.0, 1.0), Agreement::Undecided);
        assert_eq!(judged(0.5, 0.6, 1.0), Agreement::Disagrees);
        assert_eq!(judged(0.5, 0.5 + 2e-6, 0.5 + 2e-6), Agreement::Disagrees);
        assert_eq!(judged(0.5 + 1e-7, 0.5, 0.5), Agreement::Agrees);
    }

    #[test]
    fn one_bad_state_is_enough() {
        let bounds = ValueBounds { lower: vec![0.2, 0.0, 0.4], upper: vec![0.2, 1.0, 0.4] };
        let judgement = judge(&[0.25, 0.5, 0.4], &bounds, TOLERANCE);
        assert_eq!((judgement.agreement, judgement.state), (Agreement::Disagrees, 1));
        assert_eq!(judgement.difference, 0.5);
    }
}
