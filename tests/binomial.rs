//! Clopper–Pearson bounds against 20 digits from mpmath.
use dynabs::statistics::{lower_bound, upper_bound};
use imdp::numeric::{Rational, from_dyadic, to_f64};
use num_bigint::BigInt;
use num_traits::{One, Pow, Zero};

/// The exact value of a decimal without exponent.
fn decimal(text: &str) -> Rational {
    let (whole, fraction) = text.split_once('.').unwrap_or((text, ""));
    let digits: BigInt = format!("{whole}{fraction}").parse().unwrap();
    Rational::new(digits, BigInt::from(10).pow(fraction.len() as u32))
}

/// How far `bound` is from `exact`, relative to `min(p, 1−p)`, beyond what rounding it to a double costs.
fn excess(bound: f64, exact: &Rational) -> f64 {
    let smaller = exact.min(&(Rational::one() - exact)).clone();
    let distance = from_dyadic(bound).unwrap() - exact;
    let distance = if distance < Rational::zero() { -distance } else { distance };
    let spacing = from_dyadic(bound.next_up() - bound.next_down()).unwrap();
    let beyond = (distance - spacing).max(Rational::zero());
    to_f64(&(beyond / smaller))
}

#[test]
fn bounds_enclose_the_exact_ones_tightly() {
    let text = std::fs::read_to_string(crate::common::root().join("tests/data/binomial.csv")).unwrap();
    let mut excesses = Vec::new();
    for line in text.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let (n, k): (u64, u64) = (fields[0].parse().unwrap(), fields[1].parse().unwrap());
        let level: f64 = fields[2].parse().unwrap();
        let (lower, upper) = (lower_bound(k, n, level), upper_bound(k, n, level));
        let (exact_lower, exact_upper) = (decimal(fields[3]), decimal(fields[4]));
        assert!(from_dyadic(lower).unwrap() <= exact_lower, "{line}: lower bound {lower:e}");
        assert!(from_dyadic(upper).unwrap() >= exact_upper, "{line}: upper bound {upper:e}");
        for (bound, exact) in [(lower, exact_lower), (upper, exact_upper)] {
            if !exact.is_zero() && !exact.is_one() {
                excesses.push(excess(bound, &exact));
                assert!(excess(bound, &exact) < 1e-11, "{line}: {bound:e}");
            }
        }
    }
    assert!(excesses.len() > 800, "{} bounds", excesses.len());
    excesses.sort_by(f64::total_cmp);
    assert!(excesses[excesses.len() / 2] < 1e-13, "median {:e}", excesses[excesses.len() / 2]);
}
