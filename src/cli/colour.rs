//! Colour for verdicts, errors and warnings, where people look at a terminal.

use std::borrow::Cow;
use std::env;
use std::io::IsTerminal;

/// The words at the beginning of a line that have a colour, and which.
const WORDS: [(&str, &str); 6] = [
    ("error:", "1;31"),
    ("warning:", "1;33"),
    ("note:", "1;36"),
    ("true ", "1;32"),
    ("false ", "1;31"),
    ("undecided ", "1;33"),
];

/// The text as it is written to a stream: with colours on a terminal, unless `NO_COLOR` is set or the terminal has none.
pub(super) fn for_stream<'a>(text: Cow<'a, str>, stream: &impl IsTerminal) -> Cow<'a, str> {
    let is_set = |name| env::var_os(name).is_some_and(|value| !value.is_empty());
    let is_plain = is_set("NO_COLOR") || env::var_os("TERM").is_some_and(|term| term == "dumb");
    if is_plain || !stream.is_terminal() { text } else { coloured(&text).into() }
}

/// The text with the first word of lines coloured that say how something ended.
fn coloured(text: &str) -> String {
    let line = |line: &str| {
        let (indent, rest) = line.split_at(line.len() - line.trim_start_matches(' ').len());
        let found = WORDS.iter().find_map(|(word, colour)| {
            Some((word.trim_end(), colour, rest.strip_prefix(word.trim_end())?, rest.starts_with(word)))
        });
        match found {
            Some((word, colour, rest, true)) => format!("{indent}\u{1b}[{colour}m{word}\u{1b}[0m{rest}"),
            _ => line.to_owned(),
        }
    };
    text.split_inclusive('\n').map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_errors_and_warnings_have_a_colour() {
        assert_eq!(
            coloured("P>=0.9 [ F a ]\n  true   value 1\n"),
            "P>=0.9 [ F a ]\n  \u{1b}[1;32mtrue\u{1b}[0m   value 1\n"
        );
        assert_eq!(coloured("error: no\n  Do so."), "\u{1b}[1;31merror:\u{1b}[0m no\n  Do so.");
        // Names and JSON stay as they are.
        for plain in ["trueness 1\n", "  true,\n", "  \"a\": false \n", "an error: x", ""] {
            assert_eq!(coloured(plain), plain);
        }
    }

    /// What is not a terminal gets what was written before there were colours.
    #[test]
    fn files_have_no_colours() {
        let file = tempfile::tempfile().unwrap();
        assert_eq!(for_stream("error: no\n".into(), &file), "error: no\n");
    }
}
