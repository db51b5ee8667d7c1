//! Reading back what an engine computed, trusting nothing.

use super::EngineFailure;

/// How far rounding may carry an engine's sums beyond 0 and 1.
const OVERSHOOT: f64 = 1e-9;

/// One number per line, one line per state.
pub(super) fn parse_values(text: &str, states: usize) -> Result<Vec<f64>, EngineFailure> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let number = |(line, text): (usize, &&str)| {
        text.parse().map_err(|_| EngineFailure::NotANumber { line, found: shortened(text) })
    };
    checked((1..).zip(&lines).map(number).collect::<Result<_, _>>()?, states)
}

/// Eight bytes per state, little-endian.
pub(super) fn decode_values(bytes: &[u8], states: usize) -> Result<Vec<f64>, EngineFailure> {
    let (numbers, rest) = bytes.as_chunks::<8>();
    if !rest.is_empty() {
        return Err(EngineFailure::Length { found: numbers.len(), expected: states });
    }
    checked(numbers.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect(), states)
}

/// Refuses what cannot be the values of a model with this many states.
fn checked(values: Vec<f64>, expected: usize) -> Result<Vec<f64>, EngineFailure> {
    if values.len() != expected {
        return Err(EngineFailure::Length { found: values.len(), expected });
    }
    // Written so that NaN is refused.
    let is_probability = |value: f64| (-OVERSHOOT..=1.0 + OVERSHOOT).contains(&value);
    match values.iter().position(|&value| !is_probability(value)) {
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
        assert_eq!(parse_values("0.5\n1.0000000000000013\n", 2).unwrap(), [0.5, 1.0000000000000013]);
        assert!(matches!(parse_values("0.5\n", 2), Err(EngineFailure::Length { found: 1, expected: 2 })));
        assert!(matches!(parse_values("0.5\nx\n", 2), Err(EngineFailure::NotANumber { line: 2, .. })));
        for value in ["NaN", "Infinity", "-inf", "1.1", "-0.1"] {
            let refused = parse_values(&format!("0.5\n{value}\n"), 2);
            assert!(refused.is_err(), "{value}");
        }
        let bytes: Vec<u8> = [0.25f64, f64::NAN].iter().flat_map(|value| value.to_le_bytes()).collect();
        assert!(matches!(decode_values(&bytes, 2), Err(EngineFailure::NotAProbability { state: 1, .. })));
        assert!(matches!(decode_values(&bytes[..9], 1), Err(EngineFailure::Length { .. })));
        assert_eq!(decode_values(&bytes[..8], 1).unwrap(), [0.25]);
    }
}
