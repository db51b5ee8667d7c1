//! Arithmetic against exact rationals; the functions are compared with mpmath in tests/intervals.rs.

use super::Interval;
use imdp::numeric::{Rational, from_dyadic, to_f64_down, to_f64_up};
use num_traits::{Pow, Zero};
use proptest::prelude::*;

/// Doubles of all sizes, many of them short so that results are often exact.
fn double() -> impl Strategy<Value = f64> {
    prop_oneof![
        (-64i32..64).prop_map(|x| f64::from(x) / 8.0),
        -10f64..10.0,
        (any::<i64>(), -1074i32..970)
            .prop_map(|(m, e)| m as f64 / 9.3e18 * 2f64.powi(e / 2) * 2f64.powi(e - e / 2)),
    ]
}

fn exact(x: f64) -> Rational {
    from_dyadic(x).unwrap()
}

fn interval(a: f64, b: f64) -> Interval {
    Interval::new(a.min(b), a.max(b))
}

/// The tightest enclosure of a rational.
fn tightest(x: &Rational) -> Interval {
    Interval::new(to_f64_down(x), to_f64_up(x))
}

fn holds(enclosure: Interval, x: &Rational) -> bool {
    let below = !enclosure.lower().is_finite() || exact(enclosure.lower()) <= *x;
    below && (!enclosure.upper().is_finite() || *x <= exact(enclosure.upper()))
}

type Arithmetic = (fn(Interval, Interval) -> Interval, fn(&Rational, &Rational) -> Rational);

const OPERATIONS: [Arithmetic; 4] = [
    (|a, b| a + b, |a, b| a + b),
    (|a, b| a - b, |a, b| a - b),
    (|a, b| a * b, |a, b| a * b),
    (|a, b| a / b, |a, b| a / b),
];

proptest! {
    #[test]
    fn operations_on_numbers_are_the_tightest(a in double(), b in double()) {
        for (i, (of_intervals, of_rationals)) in OPERATIONS.iter().enumerate() {
            if i == 3 && b == 0.0 {
                continue;
            }
            let result = of_intervals(Interval::point(a), Interval::point(b));
            let value = of_rationals(&exact(a), &exact(b));
            prop_assert!(holds(result, &value), "operation {} on {} and {}: {:?}", i, a, b, result);
            let tight = tightest(&value);
            // Where errors of products get lost, one step more is allowed.
            if tight.lower().abs() > 1e-290 && a.abs() > 1e-290 && tight.is_bounded() {
                prop_assert_eq!(result, tight, "operation {} on {} and {}", i, a, b);
            }
        }
    }

    #[test]
    fn operations_enclose_all_elements(
        ends in (double(), double(), double(), double()),
        inside in (0f64..=1.0, 0f64..=1.0),
    ) {
        let (x, y) = (interval(ends.0, ends.1), interval(ends.2, ends.3));
        let within = |x: Interval, t: f64| (x.lower() + t * (x.upper() - x.lower())).clamp(x.lower(), x.upper());
        let elements = |x: Interval, t| [x.lower(), x.upper(), within(x, t)];
        for (i, (of_intervals, of_rationals)) in OPERATIONS.iter().enumerate() {
            let result = of_intervals(x, y);
            for a in elements(x, inside.0) {
                for b in elements(y, inside.1).into_iter().filter(|b| i != 3 || *b != 0.0) {
                    prop_assert!(holds(result, &of_rationals(&exact(a), &exact(b))));
                }
            }
        }
    }

    #[test]
    fn powers_enclose_all_elements(a in -30f64..30.0, b in -30f64..30.0, t in 0f64..=1.0, n in -6i32..20) {
        let x = interval(a, b);
        let element = (x.lower() + t * (x.upper() - x.lower())).clamp(x.lower(), x.upper());
        for element in [x.lower(), x.upper(), element].into_iter().filter(|x| *x != 0.0) {
            prop_assert!(holds(x.power(n), &Pow::pow(exact(element), n)));
        }
        // Even powers are never negative, which a product of the interval with itself does not know.
        prop_assert!(x.power(2).lower() >= 0.0);
    }

    #[test]
    fn roots_are_tight(x in 0f64..1e9) {
        let root = Interval::point(x).sqrt();
        prop_assert!(exact(root.lower()).pow(2) <= exact(x) && exact(x) <= exact(root.upper()).pow(2));
        prop_assert!(root.lower() == root.upper() || root.lower().next_up() == root.upper());
    }
}

#[test]
fn undefined_means_everything() {
    let around_zero = Interval::new(-1.0, 2.0);
    for undefined in [
        Interval::point(1.0) / around_zero,
        Interval::point(1.0) / Interval::new(0.0, 1.0),
        around_zero.power(-1),
        around_zero.sqrt(),
        around_zero.ln(),
        Interval::new(0.0, 1.0).ln(),
        around_zero.asin(),
        around_zero.acos(),
        Interval::new(1.5, 1.6).tan(),
        Interval::point(1e300).tan(),
        around_zero.power_real(Interval::point(0.3)),
        Interval::point(f64::NAN),
        Interval::new(f64::NAN, 1.0),
        Interval::new(2.0, 1.0),
        Interval::new(f64::INFINITY, f64::INFINITY),
    ] {
        assert_eq!(undefined, Interval::EVERYTHING);
    }
}

#[test]
fn overflow_is_unbounded_on_one_side_only() {
    let huge = Interval::point(f64::MAX);
    for overflow in [huge + huge, huge * huge, huge.power(3), Interval::point(1000.0).exp()] {
        assert_eq!(overflow, Interval::new(f64::MAX, f64::INFINITY));
    }
    let everything = Interval::EVERYTHING;
    assert_eq!(everything * Interval::ZERO, Interval::ZERO);
    assert_eq!(everything - everything, everything);
    assert_eq!(everything.sin(), Interval::new(-1.0, 1.0));
    assert!(!everything.abs().is_bounded() && everything.abs().lower() == 0.0);
}

#[test]
fn kept_exact_where_it_is() {
    let quarter = Interval::point(0.25);
    assert!((quarter + quarter).is_point() && (quarter * quarter).is_point() && quarter.sqrt().is_point());
    for exact in [Interval::ZERO.sin(), Interval::ZERO.cos(), Interval::ZERO.exp(), Interval::point(1.0).ln()]
    {
        assert!(exact.is_point());
    }
    assert!(
        !Interval::point(0.1).sin().is_point() && Rational::zero() == exact(Interval::ZERO.sin().lower())
    );
}
