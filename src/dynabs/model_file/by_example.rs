//! What serde expects, in the words of JSON and by example.

/// Fields that are lists of rows.
const MATRICES: [&str; 8] = ["A", "B", "G", "Q", "R", "gain", "covariance", "list"];
/// Fields that are lists of numbers.
const VECTORS: [&str; 8] = ["q", "g", "lower", "upper", "cells", "mean", "initial_state", "resolution"];

/// What is expected at a JSON pointer, if serde calls it `expected`.
pub(super) fn by_example(place: &str, expected: String) -> String {
    let field = place.rsplit('/').next().unwrap_or_default();
    let text = match expected.as_str() {
        "a sequence" if MATRICES.contains(&field) => "a list of rows, such as [[1, 0], [0, 1]]",
        "a sequence" if VECTORS.contains(&field) || field.parse::<usize>().is_ok() => {
            "a list of numbers, such as [1, 0]"
        }
        "a sequence" => "a list, in [ and ]",
        "f64" => "a number, such as 0.5",
        "u32" | "u64" | "usize" => "a whole number, such as 8",
        "a map" => "an object, in { and }",
        text if text.starts_with("struct ") => "an object, in { and }",
        _ => return expected,
    };
    text.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_are_shown() {
        for (place, expected, text) in [
            ("/dynamics/A", "a sequence", "a list of rows, such as [[1, 0], [0, 1]]"),
            ("/dynamics/A/0", "a sequence", "a list of numbers, such as [1, 0]"),
            ("/partition/lower", "a sequence", "a list of numbers, such as [1, 0]"),
            ("/dynamics/next", "a sequence", "a list, in [ and ]"),
            ("/dynamics/A/0/0", "f64", "a number, such as 0.5"),
            ("/dynamics", "struct DynamicsSpec", "an object, in { and }"),
            ("/name", "a string", "a string"),
        ] {
            assert_eq!(by_example(place, expected.to_owned()), text, "{place}");
        }
    }
}
