//! Shapes by example, for messages.

use imdp::numeric::shortest_decimal;

/// More rows or columns are not shown.
const SHOWN: usize = 5;

/// `, such as [[1, 0], [0, 1]]`: so many rows of so many of the numbers that were found, in their order, filled up with 0;
/// nothing for shapes that are too large to show.
pub(super) fn rows_example(found: &[Vec<f64>], rows: usize, columns: usize) -> String {
    if !(1..=SHOWN).contains(&rows) || !(1..=SHOWN).contains(&columns) {
        return String::new();
    }
    let mut numbers = found.iter().flatten().copied().filter(|x| x.is_finite());
    let rows: Vec<String> = (0..rows).map(|_| list(&mut numbers, columns)).collect();
    format!(", such as [{}]", rows.join(", "))
}

/// `, such as [1, 0]`: the same for a list.
pub(super) fn list_example(found: &[f64], length: usize) -> String {
    if !(1..=SHOWN).contains(&length) {
        return String::new();
    }
    format!(", such as {}", list(&mut found.iter().copied().filter(|x| x.is_finite()), length))
}

fn list(numbers: &mut impl Iterator<Item = f64>, length: usize) -> String {
    let texts: Vec<String> =
        (0..length).map(|_| shortest_decimal(numbers.next().unwrap_or_default())).collect();
    format!("[{}]", texts.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_found_is_put_in_shape() {
        let found = [vec![1.0, 0.5, 0.0], vec![1.0]];
        assert_eq!(rows_example(&found, 2, 2), ", such as [[1, 0.5], [0, 1]]");
        assert_eq!(rows_example(&[vec![f64::NAN, 2.0]], 1, 3), ", such as [[2, 0, 0]]");
        assert_eq!(rows_example(&found, 2, 6), "");
        assert_eq!(list_example(&[1.0, 2.0, 3.0], 2), ", such as [1, 2]");
    }
}
