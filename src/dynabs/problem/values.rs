//! Shapes and numbers: from lists to exact matrices and vectors.

use super::shape_example::{list_example, rows_example};
use crate::Diagnostic;
use crate::linear_algebra::ExactMatrix;
use imdp::numeric::{Rational, from_decimal};

/// The exact decimals of a list that must have `length` entries.
pub(super) fn vector(
    place: &str,
    values: &[f64],
    length: usize,
    what: &str,
) -> Result<Vec<Rational>, Diagnostic> {
    if values.len() != length {
        let expected = format!("{length}, {what}{}", list_example(values, length));
        return Err(Diagnostic::at(place, count(values.len(), "number"), expected));
    }
    let exact = |(i, &x): (usize, &f64)| {
        from_decimal(x)
            .ok_or_else(|| Diagnostic::at(format!("{place}/{i}"), x.to_string(), "a finite number"))
    };
    values.iter().enumerate().map(exact).collect()
}

/// The exact decimals of a list of rows, which must be `rows × columns`.
///
/// `None` for a dimension takes it from the value (at least 1).
pub(super) fn matrix(
    place: &str,
    values: &[Vec<f64>],
    rows: Option<usize>,
    columns: Option<usize>,
    what: &str,
) -> Result<ExactMatrix, Diagnostic> {
    let width = columns.unwrap_or_else(|| values.first().map_or(0, Vec::len));
    let height = rows.unwrap_or(values.len());
    if values.len() != height || height == 0 {
        // A row where a column is meant has the right number of numbers.
        let numbers: usize = values.iter().map(Vec::len).sum();
        let fits = numbers.is_multiple_of(height.max(1)).then_some(numbers / height.max(1));
        let columns = columns.or(fits).unwrap_or(width);
        let expected =
            format!("{}, {what}{}", count(height.max(1), "row"), rows_example(values, height, columns));
        return Err(Diagnostic::at(place, count(values.len(), "row"), expected));
    }
    let mut entries = Vec::with_capacity(height * width);
    for (i, row) in values.iter().enumerate() {
        if row.len() != width || width == 0 {
            let place = format!("{place}/{i}");
            let example = rows_example(values, height, width);
            let expected = format!("{} in every row, {what}{example}", count(width.max(1), "number"));
            return Err(Diagnostic::at(place, count(row.len(), "number"), expected));
        }
        entries.extend(vector(&format!("{place}/{i}"), row, width, what)?);
    }
    let mut entries = entries.into_iter();
    Ok(ExactMatrix::from_fn(height, width, |_, _| entries.next().unwrap_or_default()))
}

/// `1 row`, `2 rows`.
pub(super) fn count(n: usize, noun: &str) -> String {
    format!("{n} {noun}{}", if n == 1 { "" } else { "s" })
}

/// A symmetric matrix `n×n`.
pub(super) fn symmetric(
    place: &str,
    values: &[Vec<f64>],
    n: usize,
    what: &str,
) -> Result<ExactMatrix, Diagnostic> {
    let exact = matrix(place, values, Some(n), Some(n), what)?;
    match exact.asymmetry() {
        None => Ok(exact),
        Some((i, j)) => {
            let found = format!("entry ({i},{j}) = {} but entry ({j},{i}) = {}", values[i][j], values[j][i]);
            Err(Diagnostic::at(place, found, "a symmetric matrix"))
        }
    }
}

/// A name, which is shown in summaries: one line.
pub(super) fn name(name: String) -> Result<String, Diagnostic> {
    match name.contains(['\n', '\u{2028}', '\u{2029}']) {
        true => Err(Diagnostic::at("/name", format!("{name:?}, more than one line"), "a name on one line")),
        false => Ok(name),
    }
}
