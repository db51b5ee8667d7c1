//! Rewards as they are written.

use super::error::Fault;
use super::fields::Fields;
use super::written::read_written;

/// What stands where a reward should be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::formats) enum RewardValue {
    /// A number of at least 0.
    Number(f64),
    /// An interval that is more than a number.
    Interval,
}

impl RewardValue {
    /// Reads `0.5`, `1/3`, `[1, 1]` or `[0, 1]`; `None` for anything else, negative numbers in particular.
    pub(crate) fn read(text: &[u8]) -> Option<Self> {
        let text = text.trim_ascii();
        let Some(inside) = text.strip_prefix(b"[").and_then(|rest| rest.strip_suffix(b"]")) else {
            return number(text).map(Self::Number);
        };
        let comma = inside.iter().position(|byte| *byte == b',')?;
        let (lower, upper) = (number(&inside[..comma])?, number(&inside[comma + 1..])?);
        Some(if lower == upper { Self::Number(lower) } else { Self::Interval })
    }
}

fn number(text: &[u8]) -> Option<f64> {
    read_written(text)?.lower.parse().ok().filter(|value: &f64| value.is_finite())
}

/// Reads the next field as a reward.
pub(in crate::formats) fn read_reward(fields: &mut Fields<'_>) -> Result<f64, Box<Fault>> {
    const EXPECTED: &str = "a reward of at least 0, such as 0.5 or 1/3";
    match RewardValue::read(fields.next(EXPECTED)?) {
        Some(RewardValue::Number(value)) => Ok(value),
        _ => Err(fields.fault(EXPECTED)),
    }
}
