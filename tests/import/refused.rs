//! What is refused, at which place and in which words.

use std::path::Path;

use imdp::formats::ImportError;
use imdp::formats::prism::import;

use super::{Files, LAB, STA, TRA, assert_refused, import_texts};

#[test]
fn transitions_are_strict() {
    let cases: &[(&str, &str, &[&str])] = &[
        // Counts.
        ("", "m.tra:1:1", &["header", "end of the file"]),
        ("3\n", "m.tra:1:2", &["header"]),
        ("0 0 0\n", "m.tra:1:1", &["states"]),
        ("9999999999 1 1\n", "m.tra:1:1", &["4294967295"]),
        ("99999999999999999999999 1 1\n", "m.tra:1:1", &["header"]),
        ("3 1 2 4\n0 0 1 1\n", "m.tra:1:6", &["header"]),
        ("3 1 999999999999\n0 0 1 1\n", "m.tra:1:1", &["file of 25 bytes", "999999999999"]),
        ("3 2 1\n0 0 1 1\n", "m.tra:1:3", &["2 choices", "found 1"]),
        ("3 1 2\n0 0 1 1\n", "m.tra:1:5", &["2 transitions", "found 1"]),
        ("3 1 1\n0 0 1 [0,1]\n0 0 2 [0,1]\n", "m.tra:1:5", &["1 transition ", "more"]),
        ("# a\n# b\n3 1 2\n0 0 1 1\n", "m.tra:3:5", &["2 transitions"]),
        // States, choices, destinations.
        ("3 1 1\n3 0 1 1\n", "m.tra:2:1", &["state below 3", "`3`"]),
        ("3 1 1\n0 0 3 1\n", "m.tra:2:5", &["destination below 3", "`3`"]),
        ("3 1 1\n0 0 -1 1\n", "m.tra:2:5", &["destination", "`-1`"]),
        ("3 1 1\n0 1 1 1\n", "m.tra:2:3", &["choice 0 of state 0", "found 1"]),
        ("3 2 2\n0 0 1 1\n0 2 1 1\n", "m.tra:3:3", &["choice 1 of state 0", "found 2"]),
        ("3 2 3\n0 0 1 1\n0 1 1 1\n0 0 2 1\n", "m.tra:4:3", &["choice 2", "found 0"]),
        ("3 1 2\n0 0 1 [0,1]\n0 0 1 [0,1]\n", "m.tra:3:5", &["once", "`1`"]),
        ("3 1 3\n0 0 2 [0,1]\n0 0 1 [0,1]\n0 0 2 [0,1]\n", "m.tra:4:5", &["once", "`2`"]),
        ("3 1 1\n00 0 1 1\n", "m.tra:2:1", &["state", "`00`"]),
        // Intervals.
        ("3 1 1\n0 0 1 [0.6,0.5]\n", "m.tra:2:12", &["at least 0.6", "`0.5`"]),
        ("3 1 1\n0 0 1 [0.30000000000000000001,0.3]\n", "m.tra:2:31", &["at least 0.3"]),
        ("3 1 1\n0 0 1 [0.5,1.5]\n", "m.tra:2:12", &["at most 1", "`1.5`"]),
        ("3 1 1\n0 0 1 [0.5,1.00000000000000000001]\n", "m.tra:2:12", &["at most 1"]),
        ("3 1 1\n0 0 1 [-0.5,1]\n", "m.tra:2:8", &["not negative", "`-0.5`"]),
        ("3 1 1\n0 0 1 [NaN,1]\n", "m.tra:2:8", &["probability", "`NaN`"]),
        ("3 1 1\n0 0 1 [0,inf]\n", "m.tra:2:10", &["probability", "`inf`"]),
        ("3 1 1\n0 0 1 [0;1]\n", "m.tra:2:9", &["`,`"]),
        ("3 1 1\n0 0 1 [0,1\n", "m.tra:2:11", &["`]`", "end of the line"]),
        ("3 1 1\n0 0 1\n", "m.tra:2:6", &["blank", "end of the line"]),
        ("3 1 1\n0 0 1 1e-400\n", "m.tra:2:7", &["tell from 0"]),
        // Sums, as written.
        ("3 1 2\n0 0 1 [0.5,1]\n0 0 2 [0.6,1]\n", "m.tra:2:1", &["lower", "at most 1", "found 1.1"]),
        ("3 1 2\n0 0 1 [0,0.5]\n0 0 2 [0,0.4]\n", "m.tra:2:1", &["upper", "at least 1", "found 0.9"]),
        ("3 1 2\n0 0 1 0.5\n0 0 2 0.500000001001\n", "m.tra:2:1", &["found 1.000000001001"]),
        ("3 1 1\n0 0 1 0.5\n", "m.tra:2:1", &["upper", "found 0.5"]),
        // Actions.
        ("3 1 1\n0 0 1 1 a b\n", "m.tra:2:10", &["end of the line", "blank"]),
        ("3 1 2\n0 0 1 [0,1] a\n0 0 2 [0,1] b\n", "m.tra:3:13", &["`a`", "`b`"]),
        ("3 1 2\n0 0 1 [0,1] a\n0 0 2 [0,1]\n", "m.tra:3:12", &["`a`", "end of the line"]),
        ("3 1 2\n0 0 1 [0,1]\n0 0 2 [0,1] b\n", "m.tra:3:12", &["no action"]),
        ("3 1 2\n0 0 1 [0,1] a\n0 0 2 [0,1] ab\n", "m.tra:3:13", &["`a`", "`ab`"]),
        ("3 1 1\n0 0 1 \u{fc}\n", "m.tra:2:7", &["\\xc3\\xbc"]),
        // Interval DTMCs.
        ("2 2\n0 1 1\n0 1 1\n", "m.tra:3:3", &["once"]),
    ];
    for (text, place, words) in cases {
        assert_refused(text, import_texts(text, None, LAB), place, words);
    }
}

#[test]
fn states_are_strict() {
    let cases: &[(&str, &str, &[&str])] = &[
        ("", "m.sta:1:1", &["header"]),
        ("x\n", "m.sta:1:1", &["`(`"]),
        ("()\n", "m.sta:1:2", &["variable"]),
        ("(x,x)\n", "m.sta:1:4", &["once"]),
        ("(x y)\n", "m.sta:1:4", &["`,` or `)`"]),
        ("(x)\n0:(1)\n2:(1)\n", "m.sta:3:1", &["state 1", "end of the file"]),
        ("(x)\n0:(1)\n0:(1)\n", "m.sta:3:1", &["every state once"]),
        ("(x)\n0:(1)\n1:(1)\n", "m.sta:3:1", &["state 2", "end of the file"]),
        ("(x)\n0:(1)\n1:(1)\n2:(1)\n3:(1)\n", "m.sta:5:1", &["no state after 2"]),
        ("(x)\n0:(1)\n1:(true)\n2:(1)\n", "m.sta:3:4", &["a number", "`true)`"]),
        ("(x)\n0:(true)\n1:(1)\n2:(1)\n", "m.sta:3:4", &["`true` or `false`"]),
        ("(x)\n0:(1)\n1:(x)\n2:(1)\n", "m.sta:3:4", &["a number", "`x)`"]),
        ("(x)\n0:(2147483648)\n", "m.sta:2:4", &["2147483647"]),
        ("(x,y)\n0:(1)\n", "m.sta:2:5", &["next variable"]),
        ("(x)\n0:(1,2)\n", "m.sta:2:6", &["`)`"]),
    ];
    for (text, place, words) in cases {
        assert_refused(text, import_texts(TRA, Some(text), LAB), place, words);
    }
}

#[test]
fn labels_are_strict() {
    let cases: &[(&str, &str, &[&str])] = &[
        ("", "m.lab:1:1", &["header"]),
        ("0=\"goal\"\n0: 0\n", "m.lab:1:1", &["init"]),
        ("0=\"init\"\n", "m.lab:1:1", &["init", "none"]),
        ("0=\"init\" 2=\"goal\"\n", "m.lab:1:10", &["label 1", "`2="]),
        ("0=\"init\" 1=\"init\"\n", "m.lab:1:13", &["once"]),
        ("0=init\n", "m.lab:1:3", &["quotes"]),
        ("0=\"init\"\n0: 1\n", "m.lab:2:4", &["below 1"]),
        ("0=\"init\"\n3: 0\n", "m.lab:2:1", &["below 3"]),
        ("0=\"init\"\n0 0\n", "m.lab:2:3", &["`:`"]),
    ];
    for (text, place, words) in cases {
        assert_refused(text, import_texts(TRA, Some(STA), text), place, words);
    }
}

#[test]
fn files_must_exist() {
    let missing = import(Path::new("nowhere/m.tra"), None, None).unwrap_err();
    assert!(matches!(missing, ImportError::Io { .. }), "{missing}");
    let files = Files::new(TRA.as_bytes(), None, LAB.as_bytes());
    let nowhere = files.tra().with_extension("nowhere");
    let missing = import(&files.tra(), Some(&nowhere), None).unwrap_err();
    assert!(matches!(missing, ImportError::Io { .. }), "{missing}");
}
