//! Decimals that are not the shortest of their doubles: what is written counts, everywhere.

use super::{data, model};
use crate::common::certified::certified;
use assert_cmd::Command;
use imdp::formats::{Warning, drn, prism, umb};
use imdp::model::IntervalMdp;
use imdp::property::{Property, Resolution};
use imdp::solver::SolverOptions;
use std::fs;
use std::path::Path;
use std::process::Output;
use tempfile::TempDir;

/// The exact minimum and maximum of `F goal` over nature, rounded outwards.
///
/// | model | why |
/// |---|---|
/// | a, c | mass 1e-20 goes to the goal or to the sink: 0 or 1 |
/// | b, f, g | mass 1e-20 or 1e-17 must go to the goal, so all of it goes there in the end |
/// | d | mass 1e-20 may go to the sink at once |
/// | e | nothing but the loop and the sink, or nothing but the loop and the goal |
/// | h | sums exceed 1 by 1e-17: widened, the goal keeps a positive lower bound |
/// | k | the loop can have 1 − 1e-17 at most |
/// | s | the loops can have 0.69999999999999996 + 0.29999999999999999 < 1 |
/// | t, w | the loops can have exactly 1 |
const VALUES: [(&str, &str, (f64, f64), f64); 12] = [
    ("a", "g", (0.0, 0.0), 1.0),
    ("b", "g", (1.0, 1.0), 1.0),
    ("c", "g", (0.0, 0.0), 1.0),
    ("d", "g", (0.9999999999999999, 1.0), 1.0),
    ("e", "g", (0.0, 0.0), 1.0),
    ("f", "g", (1.0, 1.0), 1.0),
    ("g", "g", (1.0, 1.0), 1.0),
    ("h", "g", (1.0, 1.0), 1.0),
    ("k", "deadlock", (1.0, 1.0), 1.0),
    ("s", "g", (1.0, 1.0), 1.0),
    ("t", "g", (0.0, 0.0), 1.0),
    ("w", "g", (0.0, 0.0), 1.0),
];

fn assert_values(model: &IntervalMdp, name: &str) {
    let (_, goal, minimum, maximum) = VALUES.into_iter().find(|case| case.0 == name).unwrap();
    for resolution in Resolution::ALL {
        let expected = if resolution.nature_maximises() { (maximum, maximum) } else { minimum };
        let property: Property = format!("{resolution}=? [ F \"{goal}\" ]").parse().unwrap();
        let (answer, _) = certified(model, &property, &SolverOptions::default());
        // d: within epsilon, rounding included.
        let (lower, upper) = (answer.lower, answer.upper);
        assert!(
            (expected.0 - 1e-13..=expected.0).contains(&lower) && upper == expected.1,
            "{name} {property}: [{lower:?}, {upper:?}]"
        );
    }
}

#[test]
fn the_decimal_as_written_decides() {
    for (name, ..) in VALUES {
        let imported = model(&format!("long/{name}.tra"));
        let widened = imported.warnings.iter().any(|warning| matches!(warning, Warning::Widened { .. }));
        assert_eq!(widened, name == "h", "{name}: {:?}", imported.warnings);
        assert_values(&imported.model, name);
    }
}

#[test]
fn archives_of_doubles_mean_shortest_decimals() {
    // 0.3333333333333333 twice and 0.33333333333333337 are less than 1: the loop must be left.
    let shortest = umb::import(&data("long/w.umb")).unwrap().model;
    // 1 and 1e-20 exceed 1, so both are lowered.
    let widened = umb::import(&data("long/b.umb")).unwrap();
    assert!(matches!(widened.warnings[..], [Warning::Widened { .. }, ..]), "{:?}", widened.warnings);
    for (model, resolution) in [(&shortest, Resolution::Pmaxmin), (&widened.model, Resolution::Pminmin)] {
        let property: Property = format!("{resolution}=? [ F \"g\" ]").parse().unwrap();
        let (answer, _) = certified(model, &property, &SolverOptions::default());
        assert_eq!((answer.lower, answer.upper), (1.0, 1.0));
    }
}

fn convert(input: &Path, output: &Path) -> Output {
    let arguments = ["convert", input.to_str().unwrap(), output.to_str().unwrap()];
    Command::cargo_bin("dynabs-check").unwrap().args(arguments).output().unwrap()
}

#[test]
fn conversions_keep_the_number_or_refuse() {
    let scratch = TempDir::new().unwrap();
    for (name, ..) in VALUES {
        let original = data(&format!("long/{name}.tra"));
        let path = |extension: &str| scratch.path().join(name).with_extension(extension);
        for extension in ["drn", "tra"] {
            let output = convert(&original, &path(extension));
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        }
        assert_values(&drn::import(&path("drn")).unwrap().model, name);
        let (first, again) =
            (model(&format!("long/{name}.tra")).model, prism::import(&path("tra"), None, None));
        let exact = |model: &IntervalMdp| -> Vec<_> {
            let rows = model.rows().to_stored();
            rows.iter().flat_map(|row| row.exact.iter().map(|bound| bound.value.to_string())).collect()
        };
        assert_eq!(exact(&first), exact(&again.unwrap().model), "{name}");
        for extension in ["umb", "dynabs"] {
            let output = convert(&original, &path(extension));
            // h has been widened to short decimals already.
            assert_eq!(output.status.success(), name == "h", "{name}");
            assert_eq!(path(extension).exists(), name == "h");
            let message = String::from_utf8(output.stderr).unwrap();
            let number = fs::read_to_string(&original).unwrap();
            assert!(
                name == "h" || (message.contains("shortest decimal") && message.contains(".tra or .drn")),
                "{number}: {message}"
            );
        }
    }
}
