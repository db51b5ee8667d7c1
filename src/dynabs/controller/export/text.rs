//! Names, comments and tables as text of programs.

use super::table::{Numbers, Table};
use std::fmt::Display;

/// The width of a line.
const WIDTH: usize = 110;

/// The shortest literal that a compiler reads as this double.
pub(super) fn double(x: &f64) -> String {
    format!("{x:?}")
}

/// Items separated by commas, on lines of readable width with `end` where they go on.
pub(super) fn list(items: impl Iterator<Item = impl Display>, end: &str) -> String {
    let mut text = String::from("   ");
    let mut column = text.len();
    for (i, item) in items.enumerate() {
        let item = item.to_string();
        if i > 0 {
            text.push(',');
            if column + item.len() + 2 > WIDTH {
                text.push_str(end);
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

/// The definition of a table in C, which has no empty arrays: nothing refers to the one entry that they get.
pub(super) fn c_table(table: &Table) -> String {
    let columns = table.columns.map(|columns| columns.max(1));
    let bracket = columns.map(|columns| format!("[{columns}]")).unwrap_or_default();
    let entries = match &table.numbers {
        Numbers::Doubles(all) if all.is_empty() => {
            if columns.is_some() { "    {0}" } else { "    0" }.to_owned()
        }
        Numbers::Whole(all) if all.is_empty() => "    0".to_owned(),
        Numbers::Whole(all) => list(all.iter(), ""),
        Numbers::Doubles(all) => match columns {
            None => list(all.iter().map(double), ""),
            Some(columns) => {
                let row = |row: &[f64]| {
                    format!("    {{{}}}", row.iter().map(double).collect::<Vec<_>>().join(", "))
                };
                all.chunks_exact(columns).map(row).collect::<Vec<_>>().join(",\n")
            }
        },
    };
    let (c_type, name, rows) = (table.width().c_type(), table.name, table.rows.max(1));
    format!("static const {c_type} {name}[{rows}]{bracket} = {{\n{entries}\n}};")
}

/// An identifier of C, Python and MATLAB made of a name.
pub(super) fn identifier(name: &str) -> String {
    let mut text: String =
        name.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' }).collect();
    if !text.starts_with(|c: char| c.is_ascii_alphabetic()) {
        // Names that start with a digit are none, those with an underscore are reserved.
        text.insert(0, 'c');
    }
    text
}

/// Text that neither ends a comment nor means anything else to a compiler.
pub(super) fn comment(text: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || " _.,:;()=<>+-".contains(c);
    text.chars().map(|c| if plain(c) { c } else { '_' }).collect()
}

/// Sentences as lines that begin with `start`, in a comment of C, MATLAB or Python: nothing in them ends it.
///
/// Formulas and names of files may have line breaks, which would leave a comment of one line, and `*/`.
pub(super) fn lines(sentences: &[String], start: &str) -> String {
    let mut lines = vec![];
    let mut line = String::from(start);
    let harmless = |sentence: &String| -> String {
        let apart = sentence.replace("*/", "* /").replace("/*", "/ *").replace("\"\"\"", "\"\" \"");
        apart.chars().filter(|c| c.is_whitespace() || !c.is_control()).collect()
    };
    let harmless: Vec<String> = sentences.iter().map(harmless).collect();
    for word in harmless.iter().flat_map(|sentence| sentence.split_whitespace()) {
        if line.len() + word.len() + 1 > WIDTH {
            lines.push(std::mem::replace(&mut line, String::from(start)));
        }
        if !line.is_empty() {
            line.push(' ');
        }
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
    fn comments_end_where_they_are_to_end() {
        let sentences = ["F a\n& G\r !b".to_owned(), "in dir*/*/a.hoa\u{7}\u{2028}end".to_owned()];
        assert_eq!(lines(&sentences, " *"), " * F a & G !b in dir* / * /a.hoa end");
        assert_eq!(lines(&["/*/".to_owned()], "%"), "% / * /");
        let long: Vec<String> = (0..60).map(|i| format!("word\n{i}")).collect();
        assert!(lines(&long, "%").lines().all(|line| line.starts_with("% ") && line.len() <= WIDTH));
    }

    #[test]
    fn doubles_are_double_literals() {
        for (x, text) in
            [(1.0, "1.0"), (0.1, "0.1"), (1e300, "1e300"), (-5e-324, "-5e-324"), (1e15, "1000000000000000.0")]
        {
            assert_eq!(double(&x), text);
        }
    }

    #[test]
    fn empty_tables_are_c() {
        assert_eq!(
            c_table(&Table::matrix("t", [0, 2], vec![])),
            "static const double t[1][2] = {\n    {0}\n};"
        );
        assert_eq!(
            c_table(&Table::matrix("t", [3, 0], vec![])),
            "static const double t[3][1] = {\n    {0}\n};"
        );
        assert_eq!(c_table(&Table::whole("t", vec![])), "static const uint8_t t[1] = {\n    0\n};");
    }
}
