//! Reading back what an engine computed, trusting nothing.

use super::EngineFailure;
use crate::formats::StateValues;
use crate::property::Verdict;

/// How far rounding may carry an engine's sums beyond 0 and 1.
const OVERSHOOT: f64 = 1e-9;

/// What values have to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Range {
    /// Probabilities.
    Probability,
    /// Anything that an expression can come to; what holds is 1, and what does not 0.
    Expression,
}

/// One number per line, one line per state.
pub(super) fn parse_values(text: &str, states: usize, range: Range) -> Result<Vec<f64>, EngineFailure> {
    let not_a_number = |line, found: &str| EngineFailure::NotANumber { line, found: shortened(found) };
    let values = match StateValues::read(text).map_err(|error| not_a_number(error.line, &error.found))? {
        StateValues::Numbers(numbers) => numbers,
        StateValues::Verdicts(verdicts) => {
            let value = |(line, verdict): (usize, &Verdict)| match verdict.decided() {
                Some(holds) if range == Range::Expression => Ok(f64::from(u8::from(holds))),
                _ => Err(not_a_number(line, &verdict.to_string())),
            };
            (1..).zip(&verdicts).map(value).collect::<Result<_, _>>()?
        }
    };
    checked(values, states, range)
}

/// Eight bytes per state, little-endian.
pub(super) fn decode_values(bytes: &[u8], states: usize) -> Result<Vec<f64>, EngineFailure> {
    let (numbers, rest) = bytes.as_chunks::<8>();
    if !rest.is_empty() {
        return Err(EngineFailure::Length { found: numbers.len(), expected: states });
    }
    checked(numbers.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect(), states, Range::Probability)
}

/// Refuses what cannot be the values of a model with this many states.
fn checked(values: Vec<f64>, expected: usize, range: Range) -> Result<Vec<f64>, EngineFailure> {
    if values.len() != expected {
        return Err(EngineFailure::Length { found: values.len(), expected });
    }
    // Written so that NaN is refused.
    let fits = |value: f64| match range {
        Range::Probability => (-OVERSHOOT..=1.0 + OVERSHOOT).contains(&value),
        Range::Expression => !value.is_nan(),
    };
    match values.iter().position(|&value| !fits(value)) {
        Some(state) => Err(EngineFailure::NotAProbability { state, value: values[state] }),
        None => Ok(values),
    }
}

/// The beginning of a text that may be anything.
pub(super) fn shortened(text: &str) -> String {
    text.chars().take(60).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_probabilities_of_all_states_are_values() {
        assert_eq!(
            parse_values("0.5\n1.0000000000000013\n", 2, Range::Probability).unwrap(),
            [0.5, 1.0000000000000013]
        );
        assert!(matches!(
            parse_values("0.5\n", 2, Range::Probability),
            Err(EngineFailure::Length { found: 1, expected: 2 })
        ));
        assert!(matches!(
            parse_values("0.5\nx\n", 2, Range::Probability),
            Err(EngineFailure::NotANumber { line: 2, .. })
        ));
        for value in ["NaN", "Infinity", "-inf", "1.1", "-0.1"] {
            let refused = parse_values(&format!("0.5\n{value}\n"), 2, Range::Probability);
            assert!(refused.is_err(), "{value}");
        }
        let expression = |text| parse_values(text, 2, Range::Expression);
        assert_eq!(expression("7.5\nInfinity\n").unwrap(), [7.5, f64::INFINITY]);
        assert_eq!(expression("true\nfalse\n").unwrap(), [1.0, 0.0]);
        assert!(expression("0.5\nNaN\n").is_err() && expression("0.5\ntrue\n").is_err());
        assert!(parse_values("true\nfalse\n", 2, Range::Probability).is_err());
        let bytes: Vec<u8> = [0.25f64, f64::NAN].iter().flat_map(|value| value.to_le_bytes()).collect();
        assert!(matches!(decode_values(&bytes, 2), Err(EngineFailure::NotAProbability { state: 1, .. })));
        assert!(matches!(decode_values(&bytes[..9], 1), Err(EngineFailure::Length { .. })));
        assert_eq!(decode_values(&bytes[..8], 1).unwrap(), [0.25]);
    }
}
