//! Numbers as they were written, where no double stands for them.

use super::{Rational, from_decimal, to_f64};
use num_bigint::BigUint;
use num_traits::{One, Pow, ToPrimitive, Zero};
use std::fmt;

/// Beyond this many places after the point a decimal is written with an exponent.
const PLAIN_PLACES: u32 = 60;

/// A non-negative number that is not the shortest decimal of the double nearest to it.
///
/// Everywhere else in this crate a double stands for the shortest decimal that gives it. Equal numbers are equal
/// values of this type, however they were written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exact(Repr);

/// Files with 17 digits per number are common, so the usual case is small.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Repr {
    /// `digits · 10^−places`, `digits` not a multiple of 10 unless `places` is 0.
    Decimal { digits: u64, places: u32 },
    /// Anything else, in lowest terms.
    Ratio(Box<Rational>),
}

impl Exact {
    /// The number of a text like `0.30000000000000004`, `1e-20` or `1/3`, of which `nearest` is the nearest double;
    /// `None` if it is the shortest decimal of that double, or if the text is no such number.
    pub fn of(text: &[u8], nearest: f64) -> Option<Self> {
        let mut buffer = zmij::Buffer::new();
        if nearest.is_finite() && buffer.format_finite(nearest).as_bytes() == text {
            return None;
        }
        let exact = parse(text)?;
        (from_decimal(nearest)? != exact.to_rational()).then_some(exact)
    }

    /// The number itself.
    pub fn to_rational(&self) -> Rational {
        match &self.0 {
            Repr::Decimal { digits, places } => {
                Rational::new((*digits).into(), BigUint::from(10u8).pow(*places).into())
            }
            Repr::Ratio(ratio) => (**ratio).clone(),
        }
    }

    /// The double nearest to it.
    pub fn to_f64(&self) -> f64 {
        to_f64(&self.to_rational())
    }

    /// Whether it can be written as a decimal.
    pub fn is_decimal(&self) -> bool {
        self.decimal().is_some()
    }

    /// `(digits, places)` of the decimal that it is.
    fn decimal(&self) -> Option<(BigUint, u32)> {
        match &self.0 {
            Repr::Decimal { digits, places } => Some(((*digits).into(), *places)),
            Repr::Ratio(ratio) => decimal_of(ratio),
        }
    }
}

impl From<Rational> for Exact {
    fn from(number: Rational) -> Self {
        if let Some((digits, places)) = decimal_of(&number)
            && let Some(digits) = digits.to_u64()
        {
            return Self(Repr::Decimal { digits, places });
        }
        Self(Repr::Ratio(Box::new(number)))
    }
}

/// `numerator / denominator`, or a decimal where the number is one.
impl fmt::Display for Exact {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.decimal(), &self.0) {
            (Some((digits, 0)), _) => write!(f, "{digits}"),
            (Some((digits, places)), _) if places > PLAIN_PLACES => write!(f, "{digits}e-{places}"),
            (Some((digits, places)), _) => {
                let text = format!("{:0>width$}", digits.to_string(), width = places as usize + 1);
                let (whole, fraction) = text.split_at(text.len() - places as usize);
                write!(f, "{whole}.{fraction}")
            }
            (None, Repr::Ratio(ratio)) => write!(f, "{}/{}", ratio.numer(), ratio.denom()),
            (None, Repr::Decimal { .. }) => Ok(()),
        }
    }
}

/// `(digits, places)` with as few places as possible, if the denominator divides a power of ten.
fn decimal_of(number: &Rational) -> Option<(BigUint, u32)> {
    let (mut rest, mut twos, mut fives) = (number.denom().to_biguint()?, 0u32, 0u32);
    for (factor, count) in [(2u8, &mut twos), (5, &mut fives)] {
        while (&rest % factor).is_zero() {
            rest /= factor;
            *count += 1;
        }
    }
    if !rest.is_one() {
        return None;
    }
    let places = twos.max(fives);
    let missing = BigUint::from(2u8).pow(places - twos) * BigUint::from(5u8).pow(places - fives);
    Some((number.numer().to_biguint()? * missing, places))
}

/// A decimal or a fraction of two natural numbers.
fn parse(text: &[u8]) -> Option<Exact> {
    if let Some(slash) = text.iter().position(|&byte| byte == b'/') {
        let (over, under) = (natural(&text[..slash])?, natural(&text[slash + 1..])?);
        return (!under.is_zero()).then(|| Rational::new(over.into(), under.into()).into());
    }
    let exponent_at = text.iter().position(|byte| matches!(byte, b'e' | b'E')).unwrap_or(text.len());
    let exponent: i64 = match std::str::from_utf8(text.get(exponent_at + 1..).unwrap_or_default()).ok()? {
        "" => 0,
        digits => digits.parse().ok()?,
    };
    let point = text[..exponent_at].iter().position(|&byte| byte == b'.').unwrap_or(exponent_at);
    let fraction = text.get(point + 1..exponent_at).unwrap_or_default();
    let mut digits = [&text[..point], fraction].concat();
    let mut places = fraction.len() as i64 - exponent;
    while digits.last() == Some(&b'0') {
        digits.pop();
        places -= 1;
    }
    let digits = if digits.is_empty() { BigUint::zero() } else { natural(&digits)? };
    if digits.is_zero() {
        return Some(Exact(Repr::Decimal { digits: 0, places: 0 }));
    }
    match (digits.to_u64(), u32::try_from(places)) {
        (Some(digits), Ok(places)) => Some(Exact(Repr::Decimal { digits, places })),
        (_, Ok(places)) => Some(Rational::new(digits.into(), BigUint::from(10u8).pow(places).into()).into()),
        (_, Err(_)) => {
            let zeros = u32::try_from(-places).ok()?;
            Some(Rational::from_integer((digits * BigUint::from(10u8).pow(zeros)).into()).into())
        }
    }
}

fn natural(digits: &[u8]) -> Option<BigUint> {
    BigUint::parse_bytes(digits, 10)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn exact(text: &str) -> Option<Exact> {
        Exact::of(text.as_bytes(), parse(text.as_bytes()).unwrap().to_f64())
    }

    #[test]
    fn shortest_decimals_need_no_exact_value() {
        for text in
            ["0.1", "0.10", "1e-1", "1", "0", "0.000", "0.30000000000000004", "2/5", "5e-324", "10e-1"]
        {
            assert_eq!(exact(text), None, "{text}");
        }
    }

    #[test]
    fn other_numbers_keep_their_value() {
        for (text, shown) in [
            ("0.69999999999999996", "0.69999999999999996"),
            ("69999999999999996e-17", "0.69999999999999996"),
            ("0.99999999999999999999", "0.99999999999999999999"),
            ("0.1000000000000000055511151231257827", "0.1000000000000000055511151231257827"),
            ("1/3", "1/3"),
            ("2/6", "1/3"),
            ("12345678901234567891e-100", "12345678901234567891e-100"),
        ] {
            let number = exact(text).unwrap();
            assert_eq!(number.to_string(), shown);
            assert_eq!(exact(shown), Some(number), "{text}");
        }
        assert_eq!(exact("0.5000000000000000000001").unwrap(), exact("0.50000000000000000000010").unwrap());
        assert!(exact("1/3").is_some_and(|third| !third.is_decimal()));
    }

    proptest! {
        #[test]
        fn the_shortest_decimal_is_recognised(x in 0.0f64..1.0, digits in 1usize..25) {
            for text in [format!("{x}"), format!("{x:e}"), format!("{x:.digits$}")] {
                let nearest: f64 = text.parse().unwrap();
                let exact = Exact::of(text.as_bytes(), nearest);
                let shortest = parse(text.as_bytes()).unwrap().to_rational() == from_decimal(nearest).unwrap();
                prop_assert_eq!(exact.is_none(), shortest, "{}", text);
            }
        }
    }
}
