//! Thresholds of probabilities, compared exactly.

use std::fmt;

use num_bigint::BigInt;
use num_traits::{One, Pow, Zero};

use super::Relation;
use crate::numeric::{Rational, from_decimal, from_dyadic, shortest_decimal, to_f64};

/// More digits or a larger exponent than this say nothing about a probability, but could fill the memory.
const MAX_DIGITS: usize = 1000;

/// A probability as it was written: the decimal, not the double nearest to it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Probability {
    text: String,
    exact: Rational,
}

/// What makes a text not a [`Probability`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ProbabilityError {
    /// The text is not an unsigned decimal.
    #[error("a decimal such as 0.95")]
    NotDecimal,
    /// The number is negative or above 1.
    #[error("a probability between 0 and 1")]
    Range,
    /// The number has too many digits or too large an exponent.
    #[error("a threshold of at most {MAX_DIGITS} digits, with an exponent of at most {MAX_DIGITS}")]
    TooLong,
}

/// A bound that a probability is compared with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Threshold {
    /// How.
    pub comparison: ThresholdComparison,
    /// With what.
    pub probability: Probability,
}

/// How a probability is compared with a threshold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ThresholdComparison {
    /// `>=`
    AtLeast,
    /// `>`
    Above,
    /// `<=`
    AtMost,
    /// `<`
    Below,
}

/// What is known about a comparison of a value that is only known to lie between two bounds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Every value between the bounds satisfies the comparison.
    Holds,
    /// No value between the bounds does.
    Fails,
    /// The threshold lies between the bounds.
    Unknown,
}

impl Verdict {
    /// What a word means that [`Display`](fmt::Display) writes.
    pub fn of_word(word: &str) -> Option<Self> {
        [Self::Holds, Self::Fails, Self::Unknown].into_iter().find(|verdict| verdict.word() == word)
    }

    fn word(self) -> &'static str {
        match self {
            Self::Holds => "true",
            Self::Fails => "false",
            Self::Unknown => "undecided",
        }
    }

    /// Whether it holds; none if that is not known.
    pub fn decided(self) -> Option<bool> {
        match self {
            Self::Holds => Some(true),
            Self::Fails => Some(false),
            Self::Unknown => None,
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

impl Probability {
    /// Reads `0.95`, `.95`, `1` or `95e-2`.
    ///
    /// # Errors
    /// [`ProbabilityError`] if the text is not an unsigned decimal between 0 and 1.
    pub fn parse(text: &str) -> Result<Self, ProbabilityError> {
        let exact = exact_decimal(text)?;
        if exact > Rational::one() {
            return Err(ProbabilityError::Range);
        }
        Ok(Self { text: text.to_owned(), exact })
    }

    /// The shortest decimal that reads back as `x`.
    ///
    /// # Errors
    /// [`ProbabilityError::Range`] unless `0 ≤ x ≤ 1`.
    pub fn from_f64(x: f64) -> Result<Self, ProbabilityError> {
        if !(0.0..=1.0).contains(&x) {
            return Err(ProbabilityError::Range);
        }
        // The absolute value turns −0 into 0.
        let exact = from_decimal(x.abs()).ok_or(ProbabilityError::Range)?;
        Ok(Self { text: shortest_decimal(x.abs()), exact })
    }

    /// This number, written as a decimal if there is one for it, else as a fraction.
    ///
    /// # Errors
    /// [`ProbabilityError::Range`] unless it is between 0 and 1.
    pub fn of_rational(exact: Rational) -> Result<Self, ProbabilityError> {
        if exact < Rational::zero() || exact > Rational::one() {
            return Err(ProbabilityError::Range);
        }
        Ok(Self { text: written(&exact), exact })
    }

    /// The exact number that was written.
    pub fn exact(&self) -> &Rational {
        &self.exact
    }

    /// The double nearest to it: for display, not for verdicts.
    pub fn to_f64(&self) -> f64 {
        to_f64(&self.exact)
    }
}

impl Threshold {
    /// Whether the bound is 0 or 1: all probabilities in between compare with it in the same way.
    pub fn is_extreme(&self) -> bool {
        let exact = &self.probability.exact;
        exact.is_zero() || exact.is_one()
    }

    /// Whether a value `v` with `lower ≤ v ≤ upper` satisfies the comparison.
    ///
    /// The doubles are compared with the decimal itself: the double nearest to 0.1 is above 0.1, so it
    /// satisfies `>0.1` and not `<=0.1`. Bounds that are NaN or outside `[0, 1]` count as 0 and 1.
    pub fn decide(&self, lower: f64, upper: f64) -> Verdict {
        // `max` and `min` prefer the number to NaN.
        let (lower, upper) = (lower.max(0.0), upper.min(1.0));
        let (Some(lower), Some(upper)) = (from_dyadic(lower), from_dyadic(upper)) else {
            return Verdict::Unknown;
        };
        self.decide_exactly(&lower, &upper)
    }

    /// The same for bounds that are given exactly.
    pub fn decide_exactly(&self, lower: &Rational, upper: &Rational) -> Verdict {
        let comparison = self.comparison;
        let satisfies = |value: &Rational| comparison.compares(value, &self.probability.exact);
        match (satisfies(lower), satisfies(upper)) {
            (true, true) => Verdict::Holds,
            (false, false) => Verdict::Fails,
            _ => Verdict::Unknown,
        }
    }
}

impl Verdict {
    /// What is known about a comparison in all of several states.
    pub fn in_all(verdicts: impl IntoIterator<Item = Self>) -> Self {
        verdicts.into_iter().fold(Self::Holds, |all, one| match (all, one) {
            (Self::Fails, _) | (_, Self::Fails) => Self::Fails,
            (Self::Unknown, _) | (_, Self::Unknown) => Self::Unknown,
            (Self::Holds, Self::Holds) => Self::Holds,
        })
    }
}

impl ThresholdComparison {
    /// Whether a large value satisfies the comparison: `>=` and `>`.
    pub fn is_lower_bound(self) -> bool {
        matches!(self, Self::AtLeast | Self::Above)
    }

    pub(super) fn from_comparison(comparison: Relation) -> Option<Self> {
        Some(match comparison {
            Relation::GreaterEqual => Self::AtLeast,
            Relation::Greater => Self::Above,
            Relation::LessEqual => Self::AtMost,
            Relation::Less => Self::Below,
            Relation::Equal | Relation::NotEqual => return None,
        })
    }

    fn compares(self, value: &Rational, threshold: &Rational) -> bool {
        match self {
            Self::AtLeast => value >= threshold,
            Self::Above => value > threshold,
            Self::AtMost => value <= threshold,
            Self::Below => value < threshold,
        }
    }
}

impl fmt::Display for Probability {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl fmt::Display for ThresholdComparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::AtLeast => ">=",
            Self::Above => ">",
            Self::AtMost => "<=",
            Self::Below => "<",
        })
    }
}

impl fmt::Display for Threshold {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.comparison, self.probability)
    }
}

/// `whole.fraction e exponent` as a rational.
fn exact_decimal(text: &str) -> Result<Rational, ProbabilityError> {
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, Some(exponent)),
        None => (text, None),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, "0"));
    let sign_free = exponent.map(|exponent| exponent.strip_prefix(['+', '-']).unwrap_or(exponent));
    let all_digits = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit());
    let malformed = fraction.is_empty()
        || mantissa.is_empty()
        || sign_free.is_some_and(str::is_empty)
        || ![whole, fraction, sign_free.unwrap_or("")].into_iter().all(all_digits);
    if malformed {
        return Err(ProbabilityError::NotDecimal);
    }
    let exponent: i32 = exponent.unwrap_or("0").parse().map_err(|_| ProbabilityError::TooLong)?;
    if mantissa.len() > MAX_DIGITS || exponent.unsigned_abs() as usize > MAX_DIGITS {
        return Err(ProbabilityError::TooLong);
    }
    let digits: BigInt = format!("0{whole}{fraction}").parse().unwrap_or_else(|_| BigInt::zero());
    let power = exponent - fraction.len() as i32;
    let scale = BigInt::from(10).pow(power.unsigned_abs());
    Ok(if power >= 0 { Rational::from_integer(digits * scale) } else { Rational::new(digits, scale) })
}

/// A number of at least 0 as a decimal if there is one, else as a fraction.
fn written(exact: &Rational) -> String {
    let (mut rest, mut places) = (exact.denom().clone(), 0);
    while rest > BigInt::one() && places < MAX_DIGITS {
        let common = common_divisor(&rest, &BigInt::from(10));
        if common.is_one() {
            // Integers are limited, decimals are not.
            let part =
                |n: &BigInt| if *n > BigInt::from(i32::MAX) { format!("{n}.0") } else { n.to_string() };
            return format!("{}/{}", part(exact.numer()), part(exact.denom()));
        }
        rest /= common;
        places += 1;
    }
    let scaled = (exact * Rational::from_integer(BigInt::from(10).pow(places as u32))).to_integer();
    let digits = format!("{scaled:0>width$}", width = places + 1);
    let (whole, fraction) = digits.split_at(digits.len() - places);
    if fraction.is_empty() { whole.to_owned() } else { format!("{whole}.{fraction}") }
}

/// The greatest common divisor of two positive numbers.
fn common_divisor(a: &BigInt, b: &BigInt) -> BigInt {
    let (mut a, mut b) = (a.clone(), b.clone());
    while !b.is_zero() {
        (a, b) = (b.clone(), a % b);
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_exact() {
        for (text, numerator, denominator) in
            [("0.95", 19, 20), (".5", 1, 2), ("1", 1, 1), ("0", 0, 1), ("95e-2", 19, 20), ("0.0001E+4", 1, 1)]
        {
            let exact = Rational::new(numerator.into(), denominator.into());
            assert_eq!(*Probability::parse(text).unwrap().exact(), exact, "{text}");
        }
        assert_eq!(Probability::from_f64(0.1).unwrap(), Probability::parse("0.1").unwrap());
        assert_eq!(Probability::from_f64(-0.0).unwrap().to_string(), "0");
    }

    #[test]
    fn what_is_not_a_probability_is_refused() {
        for (text, error) in [
            ("1.0000000000000000000001", ProbabilityError::Range),
            ("2", ProbabilityError::Range),
            ("", ProbabilityError::NotDecimal),
            (".", ProbabilityError::NotDecimal),
            ("1.", ProbabilityError::NotDecimal),
            ("1e", ProbabilityError::NotDecimal),
            ("-0.5", ProbabilityError::NotDecimal),
            ("NaN", ProbabilityError::NotDecimal),
            ("1e-999999999", ProbabilityError::TooLong),
            ("1e-99999999999999999999", ProbabilityError::TooLong),
        ] {
            assert_eq!(Probability::parse(text), Err(error), "{text}");
        }
        for x in [f64::NAN, -0.1, 1.1, f64::INFINITY] {
            assert_eq!(Probability::from_f64(x), Err(ProbabilityError::Range));
        }
    }

    #[test]
    fn verdicts_compare_doubles_with_the_decimal() {
        use ThresholdComparison::{Above, AtLeast, AtMost, Below};
        let decide = |comparison, text: &str, lower, upper| {
            let probability = Probability::parse(text).unwrap();
            Threshold { comparison, probability }.decide(lower, upper)
        };
        // The double 0.1 is above 1/10, the double 0.3 is below 3/10.
        for (comparison, text, lower, upper, verdict) in [
            (AtLeast, "0.1", 0.1, 0.1, Verdict::Holds),
            (Above, "0.1", 0.1, 0.1, Verdict::Holds),
            (AtMost, "0.1", 0.1, 0.1, Verdict::Fails),
            (AtLeast, "0.3", 0.3, 0.3, Verdict::Fails),
            (Below, "0.3", 0.3, 0.3, Verdict::Holds),
            (AtLeast, "0.5", 0.5, 0.75, Verdict::Holds),
            (Above, "0.5", 0.5, 0.75, Verdict::Unknown),
            (AtMost, "0.5", 0.25, 0.5, Verdict::Holds),
            (Below, "0.5", 0.5, 0.75, Verdict::Fails),
            (AtLeast, "0.5", f64::NAN, f64::NAN, Verdict::Unknown),
            (AtLeast, "0", f64::NAN, f64::NAN, Verdict::Holds),
            (Above, "1", 0.5, f64::INFINITY, Verdict::Fails),
        ] {
            assert_eq!(decide(comparison, text, lower, upper), verdict, "{comparison}{text} {lower} {upper}");
        }
    }
}
