//! Reading PRISM's explicit files: what is refused and where, what is accepted, and that nothing panics.
#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use dynabs::formats::prism::{ImportError, Imported, Warning, import, import_with_progress};
use dynabs::imdp::{ActionNames, IntervalMdp, ModelKind, RowRange, StateVariable, VariableValues};
use proptest::prelude::*;

const TRA: &str = "3 3 4\n0 0 1 [0.2,0.8] a\n0 0 2 [0.2,0.8] a\n1 0 1 [1,1] b\n2 0 2 [1,1]\n";
const STA: &str = "(x,b)\n0:(3,true)\n1:(-1,false)\n2:(0,true)\n";
const LAB: &str = "0=\"init\" 1=\"deadlock\" 2=\"goal\"\n0: 0\n1: 2\n";

struct Files {
    directory: tempfile::TempDir,
}

impl Files {
    fn new(tra: &[u8], sta: Option<&[u8]>, lab: &[u8]) -> Self {
        let files = Self { directory: tempfile::tempdir().unwrap() };
        std::fs::write(files.tra(), tra).unwrap();
        std::fs::write(files.tra().with_extension("lab"), lab).unwrap();
        if let Some(sta) = sta {
            std::fs::write(files.tra().with_extension("sta"), sta).unwrap();
        }
        files
    }

    fn tra(&self) -> PathBuf {
        self.directory.path().join("m.tra")
    }

    fn import(&self) -> Result<Imported, ImportError> {
        import(&self.tra(), None, None)
    }
}

fn import_texts(tra: &str, sta: Option<&str>, lab: &str) -> Result<Imported, ImportError> {
    Files::new(tra.as_bytes(), sta.map(str::as_bytes), lab.as_bytes()).import()
}

/// Checks the position and the words of a refusal.
fn assert_refused(what: &str, outcome: Result<Imported, ImportError>, place: &str, words: &[&str]) {
    let Err(error) = outcome else { panic!("{what:?} is accepted") };
    let message = error.to_string();
    assert!(message.contains(&format!("{place}: expected")), "{what:?}: {message}, not at {place}");
    for word in words {
        assert!(message.contains(word), "{what:?}: {message}, without {word}");
    }
}

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
        ("3 2 2\n0 1 1 1\n0 0 1 1\n", "m.tra:2:3", &["choice 0"]),
        ("3 2 2\n1 0 1 [0.5,1]\n0 0 1 1\n", "m.tra:3:1", &["state 1 or a later", "found 0"]),
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
        ("3 1 1\n0 0 1 [0, 1]\n", "m.tra:2:10", &["probability", "blank"]),
        ("3 1 1\n0 0 1 [0,1\n", "m.tra:2:11", &["`]`", "end of the line"]),
        ("3 1 1\n0 0 1\n", "m.tra:2:6", &["blank", "end of the line"]),
        ("3 1 1\n0 0 1 1e-400\n", "m.tra:2:7", &["tell from 0"]),
        // Sums, as written.
        ("3 1 2\n0 0 1 [0.5,1]\n0 0 2 [0.6,1]\n", "m.tra:2:1", &["lower", "at most 1", "found 1.1"]),
        ("3 1 2\n0 0 1 [0,0.5]\n0 0 2 [0,0.4]\n", "m.tra:2:1", &["upper", "at least 1", "found 0.9"]),
        ("3 1 2\n0 0 1 0.5\n0 0 2 0.500000001001\n", "m.tra:2:1", &["found 1.000000001001"]),
        ("3 1 1\n0 0 1 0.5\n", "m.tra:2:1", &["upper", "found 0.5"]),
        // Actions.
        ("3 1 1\n0 0 1 1 7\n", "m.tra:2:9", &["identifier", "`7`"]),
        ("3 1 1\n0 0 1 1 a b\n", "m.tra:2:10", &["end of the line", "blank"]),
        ("3 1 1\n0 0 1 1 \n", "m.tra:2:9", &["identifier"]),
        ("3 1 2\n0 0 1 [0,1] a\n0 0 2 [0,1] b\n", "m.tra:3:13", &["`a`", "`b`"]),
        ("3 1 2\n0 0 1 [0,1] a\n0 0 2 [0,1]\n", "m.tra:3:12", &["`a`", "end of the line"]),
        ("3 1 2\n0 0 1 [0,1]\n0 0 2 [0,1] b\n", "m.tra:3:12", &["no action"]),
        ("3 1 2\n0 0 1 [0,1] a\n0 0 2 [0,1] ab\n", "m.tra:3:13", &["`a`", "`ab`"]),
        // Layout.
        ("3 1 1\n\n0 0 1 1\n", "m.tra:2:1", &["state", "end of the line"]),
        ("3 1 1\n# x\n0 0 1 1\n", "m.tra:2:1", &["state", "`#`"]),
        ("3 1 1\n0  0 1 1\n", "m.tra:2:3", &["choice", "blank"]),
        ("3 1 1\n0\t0 1 1\n", "m.tra:2:2", &["one blank"]),
        ("3 1 1\n0 0 1 \u{fc}\n", "m.tra:2:7", &["\\xc3\\xbc"]),
        // Interval DTMCs.
        ("2 2\n0 1 1\n0 1 1\n", "m.tra:3:3", &["once"]),
        ("2 2\n1 1 [0.5,1]\n0 1 1\n", "m.tra:3:1", &["state 1"]),
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
        ("(x y)\n", "m.sta:1:3", &["`,` or `)`"]),
        ("(x)\n0:(1)\n2:(1)\n", "m.sta:3:1", &["state 1", "`2:(1)`"]),
        ("(x)\n0:(1)\n0:(1)\n", "m.sta:3:1", &["state 1"]),
        ("(x)\n0:(1)\n1:(1)\n", "m.sta:3:1", &["state 2", "end of the file"]),
        ("(x)\n0:(1)\n1:(1)\n2:(1)\n3:(1)\n", "m.sta:5:1", &["no state after 2"]),
        ("(x)\n0:(1)\n1:(true)\n2:(1)\n", "m.sta:3:4", &["integer", "`true)`"]),
        ("(x)\n0:(true)\n1:(1)\n2:(1)\n", "m.sta:3:4", &["`true` or `false`"]),
        ("(x)\n0:(2147483648)\n", "m.sta:2:4", &["2147483647"]),
        ("(x,y)\n0:(1)\n", "m.sta:2:5", &["next variable"]),
        ("(x)\n0:(1,2)\n", "m.sta:2:5", &["`)`"]),
        ("(x)\n\n0:(1)\n", "m.sta:2:1", &["empty line"]),
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
        ("0=\"init\" 1=\"my goal\"\n", "m.lab:1:15", &["after the name"]),
        ("0=init\n", "m.lab:1:3", &["quotes"]),
        ("0=\"init\"\n0:\n", "m.lab:2:3", &["label"]),
        ("0=\"init\"\n0: 1\n", "m.lab:2:4", &["below 1"]),
        ("0=\"init\"\n3: 0\n", "m.lab:2:1", &["below 3"]),
        ("0=\"init\"\n0: 0 0\n", "m.lab:2:6", &["once"]),
        ("0=\"init\"\n0: 0\n0: 0\n", "m.lab:3:1", &["one line only"]),
        ("0=\"init\"\n0 0\n", "m.lab:2:2", &["`:`"]),
    ];
    for (text, place, words) in cases {
        assert_refused(text, import_texts(TRA, Some(STA), text), place, words);
    }
}

#[test]
fn files_must_exist() {
    let missing = import(Path::new("nowhere/m.tra"), None, None).unwrap_err();
    assert!(matches!(missing, ImportError::NoLabelFile { .. }), "{missing}");
    let files = Files::new(TRA.as_bytes(), None, LAB.as_bytes());
    let nowhere = files.tra().with_extension("nowhere");
    let missing = import(&files.tra(), Some(&nowhere), None).unwrap_err();
    assert!(matches!(missing, ImportError::Io { .. }), "{missing}");
}

#[test]
fn a_model_is_read() {
    let Imported { model, warnings } = import_texts(TRA, Some(STA), LAB).unwrap();
    assert_eq!(warnings, []);
    assert_eq!(model.kind(), ModelKind::Imdp);
    assert_eq!((model.size().choices, model.size().transitions, model.size().rows), (3, 4, 1));
    assert_eq!(model.rows().row(0).successors, [1, 2]);
    assert_eq!(model.rows().row(0).lower, [0.2, 0.2]);
    assert!(model.choices().is_absorbing(1) && model.choices().is_absorbing(2));
    let expected = ActionNames::OfChoice {
        names: vec!["a".to_owned(), "b".to_owned()],
        ids: vec![0, 1, ActionNames::UNNAMED],
    };
    assert_eq!(*model.actions(), expected);
    assert_eq!(model.initial().ones().collect::<Vec<_>>(), [0]);
    let labels: Vec<_> = model.labels().iter().map(|(name, set)| (name, set.ones().collect())).collect();
    assert_eq!(labels, [("deadlock", vec![]), ("goal", vec![1])]);
    assert_eq!(model.variables().get("x").unwrap().values, VariableValues::Int(vec![3, -1, 0]));
    let VariableValues::Bool(b) = &model.variables().get("b").unwrap().values else { panic!() };
    assert_eq!(b.ones().collect::<Vec<_>>(), [0, 2]);
}

#[test]
fn oddities_are_accepted() {
    let plain = import_texts(TRA, Some(STA), LAB).unwrap().model;
    let crlf = |text: &str| text.replace('\n', "\r\n");
    let same = [
        (crlf(TRA), crlf(STA), crlf(LAB)),
        (TRA.trim_end().to_owned(), STA.trim_end().to_owned(), LAB.trim_end().to_owned()),
        (crlf(TRA).trim_end().to_owned(), crlf(STA).trim_end().to_owned(), crlf(LAB).trim_end().to_owned()),
        (format!("{TRA}\n\n"), format!("{STA}\n"), format!("{LAB}\r\n")),
        (format!("# Transitions (IMDP)\n#\n{TRA}"), STA.to_owned(), LAB.to_owned()),
        (TRA.replace("[1,1]", "1"), STA.to_owned(), LAB.to_owned()),
        (TRA.replace("[1,1]", "[1.0,1e0]"), STA.to_owned(), LAB.to_owned()),
        (TRA.to_owned(), STA.to_owned(), LAB.replace("0: 0\n1: 2\n", "1: 2\n0: 0\n")),
        (TRA.replace("0 0 1 [0.2,0.8] a\n0 0 2", "0 0 2 [0.2,0.8] a\n0 0 1"), STA.to_owned(), LAB.to_owned()),
    ];
    for (tra, sta, lab) in same {
        let read = import_texts(&tra, Some(&sta), &lab).unwrap_or_else(|error| panic!("{tra:?}: {error}"));
        assert_eq!(read.model, plain, "{tra:?}");
        assert_eq!(read.warnings, []);
    }
    let several = import_texts(TRA, None, "0=\"init\" 1=\"deadlock\"\n0: 0 1\n2: 0\n").unwrap().model;
    assert_eq!(several.initial().ones().collect::<Vec<_>>(), [0, 2]);
    let zero = import_texts("2 1 2\n0 0 0 [0,1]\n0 0 1 [0.0,1]\n", None, "0=\"init\"\n0: 0\n").unwrap();
    assert_eq!(zero.model.rows().row(0).lower, [0.0, 0.0]);
}

#[test]
fn decimals_decide_sums() {
    let tenths: String = (0..10).map(|state| format!("0 0 {state} 0.1\n")).collect();
    let read = import_texts(&format!("10 1 10\n{tenths}"), None, "0=\"init\"\n0: 0\n").unwrap();
    assert!(matches!(read.warnings[..], [Warning::Deadlocks { count: 9, first: 1 }]));

    let tra = "3 3 5\n0 0 0 [0,1]\n0 0 1 [0,1]\n1 0 0 0.5\n1 0 1 0.4999999995\n2 0 2 [1,1]\n";
    let read = import_texts(tra, None, "0=\"init\"\n0: 0\n").unwrap();
    let [warning @ Warning::Widened { count: 1, first }] = &read.warnings[..] else { panic!() };
    assert_eq!((first.line, first.column), (4, 1));
    assert!(warning.to_string().contains("m.tra:4:1"));
    let row = read.model.rows().row(1);
    assert_eq!(row.lower, [0.5, 0.4999999995]);
    assert!(row.upper[0] > 0.5 && row.upper[0] + row.upper[1] >= 1.0 && row.upper[1] < 0.500000001);
}

#[test]
fn rows_are_shared() {
    let row =
        |state: u32, choice: u32, p: &str| format!("{state} {choice} 0 [{p},1]\n{state} {choice} 1 [0,1]\n");
    let mut tra = "4 9 17\n".to_owned();
    for state in 0..2 {
        for (choice, p) in (0..).zip(["0.1", "0.2", "0.3"]) {
            tra += &row(state, choice, p);
        }
    }
    // State 2 stays in one of two choices, so it is no absorbing state. State 3 has no choice.
    tra += &format!("2 0 2 1\n{}2 2 0 [0.10,1]\n2 2 1 [0,1]\n", row(2, 1, "0.3"));
    let Imported { model, warnings } = import_texts(&tra, None, "0=\"init\"\n0: 0\n").unwrap();
    assert_eq!(warnings, [Warning::Deadlocks { count: 1, first: 3 }]);
    assert_eq!(model.rows().len(), 4);
    assert_eq!(model.choices().ranges(0), [RowRange { first: 0, last: 2 }]);
    assert_eq!(model.choices().ranges(0), model.choices().ranges(1));
    assert_eq!(model.choices().rows(2).collect::<Vec<_>>(), [3, 2, 0]);
    assert!(model.choices().is_deadlock(3) && !model.choices().is_absorbing(2));
    assert_eq!(*model.actions(), ActionNames::None);
}

#[test]
fn interval_chains_are_read() {
    let tra = "3 4\n0 1 [0.1,0.9]\n0 2 [0.1,0.9]\n1 1 1\n2 0 1\n";
    let model = import_texts(tra, None, "0=\"init\"\n0: 0\n").unwrap().model;
    assert_eq!(model.kind(), ModelKind::Idtmc);
    assert_eq!((model.size().choices, model.size().transitions), (3, 4));
    assert!(model.choices().is_absorbing(1));
}

#[test]
fn long_files_are_read_like_short_ones() {
    // Long enough for many chunks; every state has its own rows, except for the last.
    let (states, width) = (20_000, 8);
    let mut tra = format!("{states} {} {}\n", 2 * states, 2 * width * states);
    for line in 0..2 * states * width {
        let (state, choice) = (line / width / 2, line / width % 2);
        let lower = 1 + (state * 7 + choice * 3) % 1000;
        tra += &format!("{state} {choice} {} [0.0{lower:04},1] act{choice}\n", line % width + state % 100);
    }
    let lab = "0=\"init\"\n0: 0\n";
    let model = import_texts(&tra, None, lab).unwrap().model;
    assert_eq!(model.size().transitions, 2 * states * width);
    assert_eq!(model.rows().row(*model.choices().rows(19_999).collect::<Vec<_>>().last().unwrap()).len(), 8);
    let wrong = tra.replacen("\n19000 1 0 ", "\n19000 1 x ", 1);
    assert_refused("long", import_texts(&wrong, None, lab), "m.tra:304010:9", &["`x`"]);
}

#[test]
fn progress_ends_with_the_file() {
    let files = Files::new(TRA.as_bytes(), None, LAB.as_bytes());
    let mut seen = 0;
    import_with_progress(&files.tra(), None, None, &mut |bytes| seen = bytes).unwrap();
    assert_eq!(seen, TRA.len() as u64);
}

#[test]
fn a_choice_may_be_longer_than_a_chunk() {
    let width = 100_000;
    let mut tra = format!("{width} 2 {}\n", width + 1);
    (0..width).rev().for_each(|to| tra += &format!("0 0 {to} [0.0,0.00002]\n"));
    tra += "7 0 7 1\n";
    let model = import_texts(&tra, None, "0=\"init\"\n0: 0\n").unwrap().model;
    assert_eq!(model.rows().row(0).len(), width);
    assert!(model.choices().is_absorbing(7) && model.choices().is_deadlock(8));
}

type Transitions = BTreeMap<(u32, u64, u32), (f64, f64)>;

/// Reads transitions the obvious way, without checks.
fn slow_transitions(text: &str) -> Transitions {
    let lines = text.lines().filter(|line| !line.is_empty() && !line.starts_with('#')).skip(1);
    let parse = |line: &str| {
        let mut fields = line.split(' ');
        let mut field = || fields.next().unwrap();
        let (source, choice, destination) = (field(), field(), field());
        let interval = field().trim_matches(['[', ']']);
        let (lower, upper) = interval.split_once(',').unwrap_or((interval, interval));
        let key = (source.parse().unwrap(), choice.parse().unwrap(), destination.parse().unwrap());
        (key, (lower.parse().unwrap(), upper.parse().unwrap()))
    };
    lines.map(parse).collect()
}

fn transitions_of(model: &IntervalMdp) -> Transitions {
    let mut transitions = Transitions::new();
    for state in 0..model.num_states() as u32 {
        if model.choices().is_absorbing(state) {
            transitions.insert((state, 0, state), (1.0, 1.0));
        }
        for (choice, row) in (0..).zip(model.choices().rows(state)) {
            let row = model.rows().row(row);
            for (i, &successor) in row.successors.iter().enumerate() {
                transitions.insert((state, choice, successor), (row.lower[i], row.upper[i]));
            }
        }
    }
    transitions
}

/// Reads the labels of every state the obvious way, `init` among them.
fn slow_labels(text: &str) -> BTreeMap<usize, Vec<String>> {
    let mut lines = text.lines();
    let header = lines.next().unwrap().split(' ');
    let names: Vec<&str> = header.map(|entry| entry.split('"').nth(1).unwrap()).collect();
    let parse = |line: &str| {
        let (state, labels) = line.split_once(": ").unwrap();
        let mut labels: Vec<String> =
            labels.split(' ').map(|label| names[label.parse::<usize>().unwrap()].to_owned()).collect();
        labels.sort();
        (state.parse().unwrap(), labels)
    };
    lines.filter(|line| !line.is_empty()).map(parse).collect()
}

fn labels_of(model: &IntervalMdp) -> BTreeMap<usize, Vec<String>> {
    let mut labels: BTreeMap<usize, Vec<String>> = BTreeMap::new();
    let initial = model.initial();
    for (name, set) in model.labels().iter().chain([("init", initial)]) {
        set.ones().for_each(|state| labels.entry(state).or_default().push(name.to_owned()));
    }
    labels.values_mut().for_each(|names| names.sort());
    labels
}

/// Writes the variables back as a state file.
fn states_of(model: &IntervalMdp) -> String {
    let variables = model.variables();
    let names: Vec<&str> = variables.iter().map(|variable| variable.name.as_str()).collect();
    let mut text = format!("({})\n", names.join(","));
    for state in 0..model.num_states() as u32 {
        let value = |variable: &StateVariable| {
            let mut text = String::new();
            variable.write_value(state, &mut text).unwrap();
            text
        };
        text += &format!("{state}:({})\n", variables.iter().map(value).collect::<Vec<_>>().join(","));
    }
    text
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn damage_is_refused_or_harmless(
        file in 0usize..3,
        at in any::<prop::sample::Index>(),
        damage in prop_oneof![
            any::<u8>().prop_map(Some),
            "[-0-9 .,\\[\\]e\n\r:()a#\"=]".prop_map(|text: String| Some(text.as_bytes()[0])),
            Just(None),
        ],
    ) {
        let mut texts = [TRA, STA, LAB].map(|text| text.as_bytes().to_vec());
        let at = at.index(texts[file].len());
        match damage {
            Some(byte) => texts[file][at] = byte,
            None => texts[file].truncate(at),
        }
        let outcome = Files::new(&texts[0], Some(&texts[1]), &texts[2]).import();
        if let Ok(Imported { model, warnings }) = outcome
            && !warnings.iter().any(|warning| matches!(warning, Warning::Widened { .. }))
        {
            let [tra, sta, lab] = texts.map(|text| String::from_utf8(text).unwrap().replace('\r', ""));
            prop_assert_eq!(transitions_of(&model), slow_transitions(&tra));
            let states = states_of(&model);
            prop_assert_eq!(states.trim_end(), sta.trim_end().replace("-0", "0"));
            prop_assert_eq!(labels_of(&model), slow_labels(&lab));
        }
    }
}
