//! Masses of intervals under known distributions against 40 digits from mpmath.

use dynabs::noise::known::Distribution;
use dynabs::problem::DistributionParts;
use imdp::numeric::{Rational, from_decimal, from_dyadic};
use num_bigint::BigInt;
use num_traits::Pow;
use serde::Deserialize;

#[derive(Deserialize)]
struct Case {
    distribution: DistributionParts,
    pitch: f64,
    masses: Vec<(i64, i64, String)>,
}

/// The exact value of a decimal, with or without exponent.
fn decimal(text: &str) -> Rational {
    let (digits, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let digits: BigInt = format!("{whole}{fraction}").parse().unwrap();
    let exponent = exponent.parse::<i32>().unwrap() - fraction.len() as i32;
    let power = Rational::from_integer(BigInt::from(10).pow(exponent.unsigned_abs()));
    if exponent < 0 { Rational::from_integer(digits) / power } else { Rational::from_integer(digits) * power }
}

#[test]
fn masses_enclose_the_exact_ones_tightly() {
    let text = std::fs::read_to_string(crate::common::root().join("tests/data/noise_masses.json")).unwrap();
    let cases: Vec<Case> = serde_json::from_str(&text).unwrap();
    let slack = decimal("1e-38");
    for Case { distribution: parts, pitch, masses } in cases {
        let distribution: Distribution = parts.distribution("").unwrap();
        let pitch = from_decimal(pitch).unwrap();
        let edge = |k: i64| &pitch * Rational::from_integer(k.into());
        for (a, b, exact) in masses {
            let mass = distribution.mass(Some(&edge(a)), Some(&edge(b)));
            let exact = decimal(&exact);
            let [low, high] = [mass.lower(), mass.upper()].map(|x| from_dyadic(x).unwrap());
            // The reference is rounded to 40 digits itself.
            assert!(
                low <= &exact + &slack && exact <= high + &slack,
                "{parts:?}, {a} to {b}: {mass:?} for {exact}"
            );
            assert!(
                mass.upper() - mass.lower() < 1e-13 + 1e-12 * mass.upper(),
                "{parts:?}, {a} to {b}: {mass:?}"
            );
        }
    }
}
