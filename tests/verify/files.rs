//! The file: what is written is read, and nothing else is.

use crate::common::abstraction;
use crate::common::certified::certified;
use crate::solver::models::{labelled, model, set};
use imdp::certificate::{CertificateError, read, write};
use imdp::model::{Row, RowError, StateId};
use imdp::solver::{Answer, SolverOptions};
use imdp::verify::check;
use proptest::prelude::*;

fn room() -> Vec<u8> {
    let compiled = abstraction("room_temperature", &[]);
    let (_, certificate) = certified(&compiled.model, &compiled.property, &SolverOptions::default());
    let mut bytes = vec![];
    write(&certificate, &mut bytes).unwrap();
    bytes
}

/// The text with its digest made right again.
fn sealed(text: &str) -> Vec<u8> {
    let content = &text[..text.rfind("end ").unwrap()];
    format!("{content}end {}\n", imdp::formats::sha256_hex(content.as_bytes())).into_bytes()
}

#[test]
fn damage_is_noticed() {
    let bytes = room();
    let config = ProptestConfig { failure_persistence: None, ..ProptestConfig::default() };
    let mut runner = proptest::test_runner::TestRunner::new(config);
    let damage = (any::<prop::sample::Index>(), prop::option::of(1u8..=255));
    runner
        .run(&damage, |(at, flip)| {
            let (at, mut bytes) = (at.index(bytes.len()), bytes.clone());
            match flip {
                Some(flip) => bytes[at] ^= flip,
                None => bytes.truncate(at),
            }
            prop_assert!(read(&bytes).is_err());
            Ok(())
        })
        .unwrap();
}

#[test]
fn broken_lines_are_named() {
    let text = String::from_utf8(room()).unwrap();
    assert_eq!(read(&sealed(&text)).unwrap(), read(text.as_bytes()).unwrap());
    for (from, to, line, expected) in [
        ("property (Pmaxmin", "property (Pmaxmix", 2, "`property`"),
        ("states 34", "states many", 4, "`states`"),
        ("claim 0", "claim 2", 5, "`claim`"),
        ("claim 0", "claim -0", 5, "`claim`"),
        ("step 1\n", "step 2\n", 6, "`step` and 1"),
        ("lower ", "lower x ", 8, "`lower`"),
        ("lower ", "lower 4294967296 1 ", 8, "`lower`"),
        ("lower ", "nothing ", 8, "the end"),
        ("lower ", "lower 3 NaN ", 8, "`lower`"),
        ("upper ", "upper 3 ", 9, "`upper`"),
    ] {
        assert!(text.contains(from), "{from}");
        let error = read(&sealed(&text.replacen(from, to, 1))).unwrap_err();
        let CertificateError::Line { line: at, expected: said, .. } = &error else { panic!("{error}") };
        assert!(*at == line && said.contains(expected), "{from} → {to}: {error}");
    }
    assert!(matches!(read(b""), Err(CertificateError::Truncated)));
    assert!(matches!(read(b"# a readme\n"), Err(CertificateError::NotACertificate { .. })));
    assert!(matches!(read(b"dynabs certificate 2\n"), Err(CertificateError::NotACertificate { .. })));
}

#[test]
fn rows_that_rounding_left_without_a_distribution() {
    let (third, above) = (0.3333333333333333, 0.3333333333333334);
    let row: Vec<_> = (0..3).map(|s| (s, third, third)).collect();
    let m = model(&[row], &[Some(vec![(0, 0)]), None, None]);
    let m = labelled(&m, &set(3, &[0, 1, 2]), &set(3, &[1]));
    for property in ["Pmaxmin=? [ F<=3 \"goal\" ]", "Pminmax=? [ F \"goal\" ]", "Pmaxmin=? [ F \"goal\" ]"] {
        let property = property.parse().unwrap();
        let options = SolverOptions { evidence: true, ..Default::default() };
        let certificate =
            Answer::new(&m, &property, &options).unwrap().certificate(&property, vec![]).unwrap();
        check(&certificate, &m, &[]).unwrap();
    }
    // What the checker would not take for a row is refused beforehand.
    let (lower, upper) = ([above; 3], [0.5; 3]);
    let row =
        Row { successors: &[StateId(0), StateId(1), StateId(2)], lower: &lower, upper: &upper, exact: &[] };
    assert!(matches!(row.validate(), Err(RowError::LowerSum { .. })));
}
