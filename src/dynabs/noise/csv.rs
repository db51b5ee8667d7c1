//! Noise samples from CSV text: numbers only, no header.

use super::NoiseSamples;

/// What is wrong with a file of samples; lines and columns count from 1.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CsvError {
    /// A line has too few or too many numbers.
    #[error("line {line}: found {found} columns; expected {expected}, one per dimension of the state")]
    Columns {
        /// The line.
        line: usize,
        /// The number of columns found.
        found: usize,
        /// The number of columns expected.
        expected: usize,
    },
    /// A field is not a finite number.
    #[error("line {line}, column {column}: found \"{found}\"; expected a finite number")]
    Number {
        /// The line.
        line: usize,
        /// The column.
        column: usize,
        /// The text of the field.
        found: String,
    },
    /// There is no sample.
    #[error("found no sample; expected one per line")]
    Empty,
}

/// Reads samples of dimension `dimension`: one per line, numbers separated by commas.
///
/// Blank lines are skipped; spaces around numbers are allowed.
///
/// # Errors
/// [`CsvError`] with the position of the first mistake.
pub fn parse_csv(text: &str, dimension: usize) -> Result<NoiseSamples, CsvError> {
    let mut values = Vec::with_capacity(text.len() / 16);
    for (line, content) in (1..).zip(text.lines()) {
        if content.trim().is_empty() {
            continue;
        }
        let found = content.split(',').count();
        if found != dimension {
            return Err(CsvError::Columns { line, found, expected: dimension });
        }
        for (column, field) in (1..).zip(content.split(',')) {
            let number = field.trim().parse::<f64>().ok().filter(|x| x.is_finite());
            let found = || field.trim().chars().take(40).collect();
            values.push(number.ok_or_else(|| CsvError::Number { line, column, found: found() })?);
        }
    }
    if values.is_empty() { Err(CsvError::Empty) } else { Ok(NoiseSamples::new(dimension, values)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mistakes_have_a_position() {
        assert_eq!(parse_csv("1, 2\n\n3,4e-1\n", 2).unwrap(), NoiseSamples::new(2, vec![1.0, 2.0, 3.0, 0.4]));
        let nan = CsvError::Number { line: 2, column: 1, found: "NaN".into() };
        assert_eq!(parse_csv("1,2\nNaN,4\n", 2), Err(nan));
        assert_eq!(parse_csv("1,2\n3\n", 2), Err(CsvError::Columns { line: 2, found: 1, expected: 2 }));
        assert_eq!(parse_csv("\n", 2), Err(CsvError::Empty));
        assert!(matches!(parse_csv("x,y\n1,2\n", 2), Err(CsvError::Number { line: 1, .. })));
    }
}
