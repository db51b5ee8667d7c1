//! Sums of decimals as they are written, without rounding.

use std::cmp::Ordering;

/// Digits per limb; leaves room for 10²⁰ summands before a limb of 128 bits overflows.
const DIGITS: usize = 18;
const LIMB: u128 = 10u128.pow(DIGITS as u32);

/// The exact sum of non-negative decimals, each of them a little above 1 at most.
///
/// `limbs[j]` counts units of `10^(−18 (j + 1))`; carries are settled once, at the end.
#[derive(Clone, Debug, Default)]
pub(crate) struct ExactSum {
    whole: u128,
    limbs: Vec<u128>,
}

impl ExactSum {
    /// The sum of decimals that [`super::decimal::read_decimal`] has accepted.
    pub(super) fn of<'a>(decimals: impl IntoIterator<Item = &'a [u8]>) -> Self {
        let mut sum = Self::default();
        for decimal in decimals {
            sum.add(decimal);
        }
        sum.settle_carries();
        sum
    }

    fn add(&mut self, decimal: &[u8]) {
        if let Some((whole, fraction)) = read_short(decimal) {
            self.whole += whole;
            if self.limbs.is_empty() {
                self.limbs.push(0);
            }
            self.limbs[0] += fraction;
            return;
        }
        let exponent_at = decimal.iter().position(|byte| matches!(byte, b'e' | b'E'));
        let (mantissa, exponent) = decimal.split_at(exponent_at.unwrap_or(decimal.len()));
        let exponent = exponent.get(1..).map_or(0, read_exponent);
        let whole_digits = mantissa.iter().position(|&byte| byte == b'.').unwrap_or(mantissa.len());
        let digits = mantissa.iter().filter(|&&byte| byte != b'.');
        // Position 0 is the first digit after the point, −1 the last one before it.
        for (position, digit) in (0i64..).map(|i| i - whole_digits as i64 - exponent).zip(digits) {
            match (u128::from(digit - b'0'), usize::try_from(position)) {
                // Zeros are skipped first: theirs may be the only absurd positions, as in `0e-999999`.
                (0, _) => {}
                (digit, Err(_)) => self.whole += digit,
                (digit, Ok(position)) => self.add_digit(digit, position),
            }
        }
    }

    fn add_digit(&mut self, digit: u128, position: usize) {
        let limb = position / DIGITS;
        if self.limbs.len() <= limb {
            self.limbs.resize(limb + 1, 0);
        }
        self.limbs[limb] += digit * 10u128.pow((DIGITS - 1 - position % DIGITS) as u32);
    }

    fn settle_carries(&mut self) {
        let mut carry = 0;
        for limb in self.limbs.iter_mut().rev() {
            *limb += carry;
            carry = *limb / LIMB;
            *limb %= LIMB;
        }
        self.whole += carry;
        while self.limbs.last() == Some(&0) {
            self.limbs.pop();
        }
    }

    /// Compares the sum with 1.
    pub(super) fn cmp_one(&self) -> Ordering {
        self.whole.cmp(&1).then(if self.limbs.is_empty() { Ordering::Equal } else { Ordering::Greater })
    }

    /// Compares two sums.
    pub(super) fn compare(&self, other: &Self) -> Ordering {
        self.whole.cmp(&other.whole).then_with(|| self.limbs.cmp(&other.limbs))
    }

    /// Whether the sum differs from 1 by at most 10⁻⁹.
    pub(super) fn is_nearly_one(&self) -> bool {
        let first = self.limbs.first().copied().unwrap_or(0);
        let rest = self.limbs.len() > 1;
        let billionth = LIMB / 1_000_000_000;
        match self.whole {
            0 => first >= LIMB - billionth,
            1 => first < billionth || (first == billionth && !rest),
            _ => false,
        }
    }

    /// The distance from 1, to double precision.
    pub(super) fn distance_from_one(&self) -> f64 {
        let fraction: f64 = (0i32..)
            .zip(&self.limbs)
            .map(|(j, &limb)| {
                // Below 1, subtract limb by limb: 1 − 0.999… is taken from the complement.
                let digits = if self.whole == 0 { LIMB - 1 - limb } else { limb };
                digits as f64 * 10f64.powi(-(DIGITS as i32) * (j + 1))
            })
            .sum();
        match self.whole {
            // The complement of the last limb lacks one unit.
            0 => fraction + 10f64.powi(-((DIGITS * self.limbs.len()) as i32)),
            whole => (whole - 1) as f64 + fraction,
        }
    }

    /// The sum for a message.
    pub(super) fn to_text(&self) -> String {
        let digits: String = self.limbs.iter().map(|limb| format!("{limb:018}")).collect();
        let digits = digits.trim_end_matches('0');
        match (digits.len(), self.whole) {
            (0, whole) => whole.to_string(),
            (1..=40, whole) => format!("{whole}.{digits}"),
            (_, whole) => format!("{whole}.{}…", &digits[..40]),
        }
    }
}

/// Reads a decimal like `0.25` whose fraction fits into one limb: the digit before the point and the limb.
fn read_short(decimal: &[u8]) -> Option<(u128, u128)> {
    let (whole, fraction) = match *decimal {
        [whole] => (whole, &[] as &[u8]),
        [whole, b'.', ref fraction @ ..] if fraction.len() <= DIGITS => (whole, fraction),
        _ => return None,
    };
    let mut limb = 0u64;
    for digit in fraction {
        // Most likely an exponent.
        if !digit.is_ascii_digit() {
            return None;
        }
        limb = limb * 10 + u64::from(digit - b'0');
    }
    let unit = 10u64.pow((DIGITS - fraction.len()) as u32);
    Some((u128::from(whole - b'0'), u128::from(limb * unit)))
}

/// Reads the digits of an exponent and its sign, saturating.
fn read_exponent(text: &[u8]) -> i64 {
    let magnitude = text
        .iter()
        .filter(|byte| byte.is_ascii_digit())
        .fold(0i64, |value, digit| (value * 10 + i64::from(digit - b'0')).min(1 << 40));
    if text.first() == Some(&b'-') { -magnitude } else { magnitude }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::{Rational, from_decimal};
    use proptest::prelude::*;

    fn sum(decimals: &[&str]) -> ExactSum {
        ExactSum::of(decimals.iter().map(|text| text.as_bytes()))
    }

    #[test]
    fn sums_are_exact() {
        assert_eq!(sum(&["0.1"; 10]).cmp_one(), Ordering::Equal);
        assert_eq!(sum(&["1e-1", "0.9", "0e-999999999999999999999"]).cmp_one(), Ordering::Equal);
        assert_eq!(sum(&["10e-1", "5e-324"]).cmp_one(), Ordering::Greater);
        assert_eq!(sum(&["0.99999999999999999999999999"]).cmp_one(), Ordering::Less);
        assert_eq!(sum(&["0.0001e4"]).to_text(), "1");
        assert_eq!(sum(&["0.999999999999999999", "0.000000000000000001"]).cmp_one(), Ordering::Equal);
        assert_eq!(sum(&["0.999999999999999999", "0.0000000000000000010"]).cmp_one(), Ordering::Equal);
        assert_eq!(sum(&["0.25", "0.0000000000000000000000001"]).to_text(), "0.2500000000000000000000001");
    }

    #[test]
    fn nearness_is_exact_too() {
        assert!(sum(&["1", "1e-9"]).is_nearly_one());
        assert!(!sum(&["1", "1e-9", "1e-40"]).is_nearly_one());
        assert!(sum(&["0.999999999"]).is_nearly_one());
        assert!(!sum(&["0.99999999899999999999999999"]).is_nearly_one());
        assert_eq!(sum(&["0.999999999"]).distance_from_one(), 1e-9);
        assert_eq!(sum(&["1.000000000000000000000001"]).distance_from_one(), 1e-24);
        assert_eq!(sum(&["0.6"]).distance_from_one(), 0.4);
    }

    proptest! {
        #[test]
        fn sums_agree_with_rationals(values in prop::collection::vec(0.0f64..0.1, 1..30)) {
            let exact: Rational = values.iter().map(|&x| from_decimal(x).unwrap()).sum();
            let one = from_decimal(1.0).unwrap();
            for texts in [
                values.iter().map(|x| format!("{x}")).collect::<Vec<_>>(),
                values.iter().map(|x| format!("{x:e}")).collect(),
            ] {
                let sum = ExactSum::of(texts.iter().map(|text| text.as_bytes()));
                prop_assert_eq!(sum.cmp_one(), exact.cmp(&one));
                let distance = crate::numeric::to_f64(&(&exact - &one)).abs();
                prop_assert!((sum.distance_from_one() - distance).abs() <= 1e-15 * distance);
            }
        }
    }

    #[test]
    fn order_is_that_of_the_decimals() {
        assert_eq!(sum(&["0.50"]).compare(&sum(&["5e-1"])), Ordering::Equal);
        assert_eq!(sum(&["0.30000000000000000001"]).compare(&sum(&["0.3"])), Ordering::Greater);
    }
}
