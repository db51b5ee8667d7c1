//! The answer in every state as text, one line each: the form of PRISM's `-exportvector`.

use super::LineError;
use crate::numeric::shortest_decimal;
use crate::property::Verdict;
use std::io::{self, Write};

/// The answer to a question in every state.
#[derive(Clone, Debug, PartialEq)]
pub enum StateValues {
    /// A number each, which may be infinite.
    Numbers(Vec<f64>),
    /// For thresholds and formulas: `true`, `false` or `undecided`.
    Verdicts(Vec<Verdict>),
}

impl StateValues {
    /// Reads one answer a line.
    ///
    /// # Errors
    /// [`LineError`] for the first line that is neither a number nor, like all others, a verdict.
    pub fn read(text: &str) -> Result<Self, LineError> {
        let lines = || text.lines().map(str::trim);
        let verdicts: Option<Vec<Verdict>> = lines().map(Verdict::of_word).collect();
        if let Some(verdicts) = verdicts.filter(|verdicts| !verdicts.is_empty()) {
            return Ok(Self::Verdicts(verdicts));
        }
        let numbers = (1..).zip(lines()).map(|(line, found)| {
            found.parse().map_err(|_| LineError {
                line,
                found: found.to_owned(),
                expected: "a number in every line, or true, false or undecided in every line",
            })
        });
        numbers.collect::<Result<_, _>>().map(Self::Numbers)
    }

    /// Writes one answer a line, numbers as their shortest decimals.
    ///
    /// # Errors
    /// What writing gives.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        match self {
            Self::Numbers(numbers) => numbers.iter().try_for_each(|&number| match number {
                f64::INFINITY => writeln!(out, "Infinity"),
                f64::NEG_INFINITY => writeln!(out, "-Infinity"),
                number => writeln!(out, "{}", shortest_decimal(number)),
            }),
            Self::Verdicts(verdicts) => verdicts.iter().try_for_each(|verdict| writeln!(out, "{verdict}")),
        }
    }

    /// The number of states.
    pub fn len(&self) -> usize {
        match self {
            Self::Numbers(numbers) => numbers.len(),
            Self::Verdicts(verdicts) => verdicts.len(),
        }
    }

    /// Whether there is no state.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        for values in [
            StateValues::Numbers(vec![0.1, 1.0, 5e-324, f64::INFINITY, f64::NEG_INFINITY]),
            StateValues::Verdicts(vec![Verdict::Holds, Verdict::Fails, Verdict::Unknown]),
        ] {
            let mut text = vec![];
            values.write(&mut text).unwrap();
            assert_eq!(StateValues::read(&String::from_utf8(text).unwrap()).unwrap(), values);
        }
    }

    #[test]
    fn numbers_and_verdicts_are_not_mixed() {
        let error = StateValues::read("0.5\n true \n").unwrap_err();
        assert_eq!((error.line, error.found.as_str()), (2, "true"));
        assert_eq!(StateValues::read("true\n0.5\n").unwrap_err().line, 1);
        assert_eq!(StateValues::read("0.5\n\n0.5\n").unwrap_err().line, 2);
        assert!(StateValues::read("").unwrap().is_empty());
    }
}
