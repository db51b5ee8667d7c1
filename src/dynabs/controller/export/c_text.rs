//! Names, comments and tables as text of C.

use std::fmt::Display;

/// The width of a line of C.
const WIDTH: usize = 110;

/// C has no empty arrays; nothing refers to the one entry that they get.
pub(super) fn filled<T>(mut table: Vec<T>, entry: T) -> Vec<T> {
    if table.is_empty() {
        table.push(entry);
    }
    table
}

/// The shortest literal that a C compiler reads as this double.
pub(super) fn double(x: &f64) -> String {
    format!("{x:?}")
}

/// Items separated by commas, on lines of readable width.
pub(super) fn list(items: impl Iterator<Item = impl Display>) -> String {
    let mut text = String::from("   ");
    let mut column = text.len();
    for (i, item) in items.enumerate() {
        let item = item.to_string();
        if i > 0 {
            text.push(',');
            if column + item.len() + 2 > WIDTH {
                text.push_str("\n   ");
                column = 3;
            }
        }
        text.push(' ');
        text.push_str(&item);
        column += item.len() + 2;
    }
    text
}

/// A table with rows of `n` doubles.
pub(super) fn rows(table: &[f64], n: usize) -> String {
    let row = |row: &[f64]| format!("    {{{}}}", row.iter().map(double).collect::<Vec<_>>().join(", "));
    table.chunks_exact(n).map(row).collect::<Vec<_>>().join(",\n")
}

/// A C identifier made of a name.
pub(super) fn identifier(name: &str) -> String {
    let mut text: String =
        name.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' }).collect();
    if !text.starts_with(|c: char| c.is_ascii_alphabetic()) {
        // Names that start with a digit are none, those with an underscore are reserved.
        text.insert(0, 'c');
    }
    text
}

/// Text that neither ends a comment nor means anything else to a C compiler.
pub(super) fn comment(text: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || " _.,:;()=<>+-".contains(c);
    text.chars().map(|c| if plain(c) { c } else { '_' }).collect()
}

/// Sentences as lines of a comment.
pub(super) fn promise(sentences: &[String]) -> String {
    let mut lines = vec![];
    let mut line = String::from(" *");
    for word in sentences.iter().flat_map(|sentence| sentence.split(' ')) {
        if line.len() + word.len() + 1 > WIDTH {
            lines.push(std::mem::replace(&mut line, String::from(" *")));
        }
        line.push(' ');
        line.push_str(word);
    }
    lines.push(line);
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_harmless() {
        assert_eq!(identifier("Räume 2*/"), "r_ume_2__");
        assert_eq!(
            (identifier("2-D"), identifier("_x"), identifier("")),
            ("c2_d".into(), "c_x".into(), "c".into())
        );
        assert_eq!(comment("a*/ b??/\n\"é\""), "a__ b_______");
    }

    #[test]
    fn doubles_are_double_literals() {
        for (x, text) in
            [(1.0, "1.0"), (0.1, "0.1"), (1e300, "1e300"), (-5e-324, "-5e-324"), (1e15, "1000000000000000.0")]
        {
            assert_eq!(double(&x), text);
        }
    }
}
