//! Noise samples from CSV text, as programs and spreadsheets write it.

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
    /// A number has a comma where decimals begin, which was not said.
    #[error("line {line}, column {column}: found \"{found}\"; expected a number with a decimal point")]
    DecimalComma {
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

/// What separates whole numbers from decimals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DecimalMark {
    /// `1.5`
    #[default]
    Point,
    /// `1,5`, which spreadsheets write in many countries.
    Comma,
}

/// Reads samples of dimension `dimension`: one per line, numbers separated by commas or, where a line has one, semicolons.
///
/// Blank lines are skipped, and a first line that has names only; spaces around numbers are allowed, and a mark of the order of
/// bytes before everything. Commas inside of numbers are an error unless `decimal` says what they are.
///
/// # Errors
/// [`CsvError`] with the position of the first mistake.
pub fn parse_csv(text: &str, dimension: usize, decimal: DecimalMark) -> Result<NoiseSamples, CsvError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut values = Vec::with_capacity(text.len() / 16);
    let lines = (1..).zip(text.lines()).filter(|(_, content)| !content.trim().is_empty());
    for (i, (line, content)) in lines.enumerate() {
        let separator = if decimal == DecimalMark::Comma || content.contains(';') { ';' } else { ',' };
        if i == 0 && content.split(separator).all(is_name) {
            continue;
        }
        let found = content.split(separator).count();
        if found != dimension {
            return Err(CsvError::Columns { line, found, expected: dimension });
        }
        for (column, field) in (1..).zip(content.split(separator)) {
            let number = number(field.trim(), decimal);
            let found = || field.trim().chars().take(40).collect();
            values.push(number.ok_or_else(|| match number_with_comma(field) {
                true => CsvError::DecimalComma { line, column, found: found() },
                false => CsvError::Number { line, column, found: found() },
            })?);
        }
    }
    if values.is_empty() { Err(CsvError::Empty) } else { Ok(NoiseSamples::new(dimension, values)) }
}

/// Whether a field is the name of a column: it begins with a letter, and stands neither for a number nor for one that is missing.
fn is_name(field: &str) -> bool {
    let name = field.trim().trim_matches('"').trim();
    let is_missing = ["na", "n/a", "null", "none", "missing"].contains(&name.to_lowercase().as_str());
    name.starts_with(|c: char| c.is_alphabetic() || c == '_') && name.parse::<f64>().is_err() && !is_missing
}

fn number(field: &str, decimal: DecimalMark) -> Option<f64> {
    let number = match decimal {
        DecimalMark::Point => field.parse::<f64>().ok(),
        // A point would separate thousands, or decimals after all: who knows.
        DecimalMark::Comma if field.contains('.') => None,
        DecimalMark::Comma => field.replacen(',', ".", 1).parse::<f64>().ok(),
    };
    number.filter(|x| x.is_finite())
}

fn number_with_comma(field: &str) -> bool {
    field.contains(',') && number(field.trim(), DecimalMark::Comma).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mistakes_have_a_position() {
        assert_eq!(
            parse_csv("1, 2\n\n3,4e-1\n", 2, DecimalMark::Point).unwrap(),
            NoiseSamples::new(2, vec![1.0, 2.0, 3.0, 0.4])
        );
        let nan = CsvError::Number { line: 2, column: 1, found: "NaN".into() };
        assert_eq!(parse_csv("1,2\nNaN,4\n", 2, DecimalMark::Point), Err(nan));
        assert_eq!(
            parse_csv("1,2\n3\n", 2, DecimalMark::Point),
            Err(CsvError::Columns { line: 2, found: 1, expected: 2 })
        );
        assert_eq!(parse_csv("\n", 2, DecimalMark::Point), Err(CsvError::Empty));
        for first in ["1,x", "NA,NA", "NaN,inf", "-,-", "1x,2y"] {
            let read = parse_csv(&format!("{first}\n1,2\n"), 2, DecimalMark::Point);
            assert!(matches!(read, Err(CsvError::Number { line: 1, .. })), "{first}: {read:?}");
        }
        let later = parse_csv("1,2\nx,y\n", 2, DecimalMark::Point);
        assert!(matches!(later, Err(CsvError::Number { line: 2, .. })), "{later:?}");
    }

    #[test]
    fn files_of_spreadsheets_are_read() {
        let expected = NoiseSamples::new(2, vec![1.5, 2.0, -0.25, 300.0]);
        let read = |text, decimal| parse_csv(text, 2, decimal);
        assert_eq!(read("\u{feff}x1,x2\r\n1.5,2\r\n-0.25,3e2\r\n", DecimalMark::Point).unwrap(), expected);
        assert_eq!(read("\"x 1\";\"x 2\"\n1.5; 2\n-.25;300\n", DecimalMark::Point).unwrap(), expected);
        assert_eq!(read("1,5;2\n-0,25;3e2\n", DecimalMark::Comma).unwrap(), expected);
        let comma = CsvError::DecimalComma { line: 1, column: 1, found: "1,5".into() };
        assert_eq!(read("1,5;2\n", DecimalMark::Point), Err(comma));
        // Thousands, or decimals: nobody knows.
        for text in ["1.234,5;2\n", "1,234,5;2\n", "1.5;2\n"] {
            let read = read(text, DecimalMark::Comma);
            assert!(matches!(read, Err(CsvError::Number { .. })), "{text}: {read:?}");
        }
        assert_eq!(read("x;y\n", DecimalMark::Point), Err(CsvError::Empty));
    }
}
