//! DRN: what is written, what Storm's dialect means, what is refused and where.

use super::*;
use imdp::formats::drn::{DrnWriter, import};
use imdp::formats::{ImportError, Imported};

const TINY: &str = include_str!("data/tiny.drn");

fn import_text(text: &[u8]) -> Result<Imported, ImportError> {
    let scratch = tempfile::tempdir().unwrap();
    let path = scratch.path().join("m.drn");
    std::fs::write(&path, text).unwrap();
    import(&path)
}

#[test]
fn the_text_is_that_of_storm() {
    let model = tiny::model();
    let writer = DrnWriter::new(&model).unwrap();
    let mut text = Vec::new();
    writer.write(&mut text, &()).unwrap();
    assert_eq!(text.len() as u64, writer.bytes());
    assert_eq!(String::from_utf8(text).unwrap(), TINY);
}

#[test]
fn names_that_cannot_be_written_are_refused() {
    let mut parts = parts(&tiny::model());
    parts.labels.insert("two words", StateSet::with_capacity(5));
    let model = IntervalMdp::new(parts.clone()).unwrap();
    assert!(DrnWriter::new(&model).is_ok());
    parts.labels.insert("a \"quote\"", StateSet::with_capacity(5));
    let error = DrnWriter::new(&IntervalMdp::new(parts.clone()).unwrap()).unwrap_err();
    assert!(error.to_string().contains("label `a \\\"quote\\\"`"), "{error}");
    parts.labels = Labels::default();
    parts.actions = ActionNames::OfChoice { names: vec!["two words".into()], ids: vec![0; 6] };
    let error = DrnWriter::new(&IntervalMdp::new(parts).unwrap()).unwrap_err();
    assert!(error.to_string().contains("action `two words`"), "{error}");
}

/// Names of variables stand in one line, between blanks: with an empty one among them the file could not be read.
#[test]
fn variables_without_a_name_are_refused() {
    let mut parts = parts(&tiny::model());
    let states = IntervalMdp::new(parts.clone()).unwrap().num_states();
    for (name, is_fine) in [
        ("x", true),
        ("", false),
        ("x y", false),
        ("x\n", false),
        ("\"", false),
        ("\"x\"", false),
        ("x\"", true),
    ] {
        let mut variables = StateVariables::default();
        variables.push(name.to_owned(), VariableValues::Int(vec![1; states]));
        parts.variables = variables;
        let model = IntervalMdp::new(parts.clone()).unwrap();
        assert_eq!(DrnWriter::new(&model).is_ok(), is_fine, "{name:?}");
    }
}

#[test]
fn the_dialect_is_read() {
    // Windows line ends, plain numbers, quoted labels, blank lines and comments anywhere, no number of choices.
    let text = "// x\r\n@type: DTMC\r\n@value_type: double\r\n@parameters\r\n\r\n@reward_models\r\n\r\n@nr_states\r\n3\r\n\
                @model\r\nstate 0 init \"two words\"\r\n//[x=1]\r\n\taction 0\r\n\t\t1 : 0.25\r\n\r\n\t\t2 : 7.5e-1\r\n\
                state 1 \"goal\"\r\n\taction 0\r\n\t\t1 : [1, 1]\r\nstate 2\r\n\taction __NOLABEL__\r\n";
    let imported = import_text(text.as_bytes()).unwrap();
    let model = imported.model;
    assert_eq!(model.kind(), ModelKind::Idtmc);
    assert_eq!(model.labels().iter().map(|(name, _)| name).collect::<Vec<_>>(), ["two words", "goal"]);
    assert!(model.choices().is_absorbing(StateId(1)) && model.choices().is_deadlock(StateId(2)));
    let buffer = &mut RowBuffer::default();
    let row = model.rows().row(RowId(0), buffer);
    assert_eq!(
        (row.successors, row.lower, row.upper),
        (&[StateId(1), StateId(2)][..], &[0.25, 0.75][..], &[0.25, 0.75][..])
    );
    assert_eq!(imported.warnings.len(), 1);
}

#[test]
fn mistakes_are_refused_with_their_place() {
    // The replaced text, its replacement, line:column, words of the message.
    let cases: &[(&str, &str, &str, &[&str])] = &[
        ("@type: MDP", "@type: CTMC", "4:8", &["MDP or DTMC", "CTMC"]),
        ("@type: MDP\n", "@type: MDP\n@type: MDP\n", "5:1", &["@type once"]),
        ("double-interval", "parametric", "5:14", &["double-interval", "parametric"]),
        ("@parameters\n\n", "@parameters\np q\n", "7:1", &["parameters are not supported", "`p`"]),
        ("@reward_models\n\n", "@reward_models\ncost cost\n", "9:1", &["every reward model once"]),
        ("@nr_states\n5", "@placeholders\n$x : 1\n@nr_states\n5", "10:1", &["@nr_states", "`@placeholders`"]),
        ("@nr_states\n5", "@nr_states\n0", "11:1", &["between 1 and"]),
        ("@nr_states\n5", "@nr_states\n6", "42:1", &["6 states", "found 5"]),
        ("@nr_states\n5", "@nr_states\n4", "32:3", &["destination below 4"]),
        ("\t\t4 : [1, 1]\n", "\t\t4 : [1, 1]\nstate 5\n", "43:7", &["no state after 4"]),
        ("@nr_choices\n7", "@nr_choices\n8", "42:1", &["8 choices", "found 7"]),
        ("@model", "@modal", "14:1", &["@model"]),
        ("state 1 goal", "state 3 goal", "22:7", &["state 1", "`3`"]),
        ("state 1 goal", "state 1 goal goal", "22:14", &["every label of a state once"]),
        ("state 1 goal", "state 1 [3] goal", "22:9", &["0 rewards, as the header says"]),
        ("action b\n", "action b [3]\n", "20:11", &["0 rewards, as the header says"]),
        ("1 : [0.2, 0.5]", "5 : [0.2, 0.5]", "18:3", &["destination below 5"]),
        ("1 : [0.2, 0.5]", "2 : [0.2, 0.5]", "19:1", &["every destination of a choice once", "`2`"]),
        ("1 : [0.2, 0.5]", "1 : [0.6, 0.5]", "18:13", &["at least 0.6", "`0.5`"]),
        ("1 : [0.2, 0.5]", "1 : [0.2, 1.5]", "18:13", &["at most 1"]),
        ("1 : [0.2, 0.5]", "1 : [-0.2, 0.5]", "18:8", &["not negative"]),
        ("1 : [0.2, 0.5]", "1 : (0.2, 0.5]", "18:7", &["probability"]),
        ("1 : [0.2, 0.5]", "1 : [0.2, 0.1999]", "18:13", &["at least 0.2"]),
        ("1 : [0.2, 0.5]", "1 : [0.1, 0.1]", "17:1", &["sum to at least 1", "0.9"]),
        ("state 0 init", "state 0 unit", "42:1", &["label init"]),
        ("//! values 3 true\n", "", "33:1", &["every state"]),
        ("//! values 3 true", "//! values 3 yes", "27:14", &["`true` or `false`"]),
        ("\taction a_0\n", "", "17:3", &["an action before its transitions"]),
    ];
    for (old, new, place, words) in cases {
        assert!(TINY.contains(old), "{old}");
        let mut text = TINY.replacen(old, new, 1);
        if old.contains("init") {
            // There are two initial states.
            text = text.replace(" init", "");
        }
        let Err(error) = import_text(text.as_bytes()) else { panic!("{new:?} is accepted") };
        let message = error.to_string();
        assert!(message.contains(&format!("m.drn:{place}: found")), "{new:?}: {message}, not at {place}");
        for word in *words {
            assert!(message.contains(word), "{new:?}: {message}, without {word}");
        }
    }
}

#[test]
fn other_peoples_files_are_read() {
    // PRISM's types, rewards of two models (one of intervals), Storm's values of variables, fractions, blanks.
    let text = "@type: IDTMC\n@parameters\n\n@reward_models\ncost  steps \n@nr_states\n3\n@nr_choices\n3\n@model\n\
                state 0 [1/2, [0, 1]] init\n//[x=-1\t& !b]\n  action 0 [2, [1,1]]\n 1: [1/3,2/3] \n\t2 : [1/3 , 2/3]\n\
                state 1 [0, 0] goal \n//[x=2\t& b]\n\t1 : 1\nstate 2 [.5, 1] \n//[x=0\t& b]\n\t\t2 :1\n";
    let Imported { model, warnings, .. } = import_text(text.as_bytes()).unwrap();
    assert_eq!(model.kind(), ModelKind::Idtmc);
    let cost = model.rewards().get("cost").unwrap();
    assert_eq!(
        (cost.of_state(0), cost.of_state(2), cost.of_choice(0), cost.of_choice(1)),
        (0.5, 0.5, 2.0, 0.0)
    );
    assert!(model.rewards().get("steps").is_none());
    assert!(warnings.iter().any(|warning| warning.to_string().contains("steps")), "{warnings:?}");
    assert_eq!(model.variables().get("x").unwrap().values, VariableValues::Int(vec![-1, 2, 0]));
    assert!(
        matches!(&model.variables().get("b").unwrap().values, VariableValues::Bool(set) if !set.contains(0))
    );
    assert_eq!(model.rows().to_stored().row(RowId(0)).lower, [1.0 / 3.0; 2]);
}

#[test]
fn rewards_without_a_name_are_read() {
    // As PRISM writes them: the line with the names is empty.
    let text = "@type: IMDP\n@parameters\n\n@reward_models\n\n@nr_states\n2\n@nr_choices\n2\n@model\n\
                state 0 [1] init\n\taction a [0.5]\n\t\t1 : [1,1]\nstate 1 [0]\n\taction b [0]\n\t\t1 : [1,1]\n";
    let model = import_text(text.as_bytes()).unwrap().model;
    let rewards = model.rewards().nth(0).unwrap();
    assert_eq!((rewards.name.as_str(), rewards.of_state(0), rewards.of_choice(0)), ("", 1.0, 0.5));
    assert_eq!((rewards.of_state(1), rewards.of_choice(1), model.rewards().iter().len()), (0.0, 0.0, 1));
}

#[test]
fn sums_are_those_of_the_decimals() {
    let tenths: String = (0..10).map(|state| format!("\t\t{state} : 0.1\n")).collect();
    let states: String =
        (1..10).map(|state| format!("state {state}\n\taction 0\n\t\t{state} : 1\n")).collect();
    let text = format!(
        "@type: MDP\n@value_type: double\n@parameters\n\n@reward_models\n\n@nr_states\n10\n@nr_choices\n10\n@model\n\
         state 0 init\n\taction 0\n{tenths}{states}"
    );
    let imported = import_text(text.as_bytes()).unwrap();
    assert!(imported.warnings.is_empty());
    assert!(imported.model.rows().to_stored().row(RowId(0)).lower.iter().all(|&lower| lower == 0.1));
}

#[test]
fn damaged_text_never_panics() {
    let original = TINY.as_bytes();
    // One place for thousands of files.
    let scratch = tempfile::tempdir().unwrap();
    let path = scratch.path().join("m.drn");
    let import_text = |text: &[u8]| {
        std::fs::write(&path, text).unwrap();
        import(&path)
    };
    for cut in 0..original.len() {
        // Cut short it is refused, unless all states are there: a state may have no choices.
        if let Ok(imported) = import_text(&original[..cut]) {
            assert!(cut > TINY.find("state 4").unwrap(), "{cut}");
            assert_eq!(imported.model.num_states(), 5);
        }
    }
    for at in 0..original.len() {
        for byte in [b'0', b'9', b' ', b'\n', b'-', b'"', 0xff] {
            let mut text = original.to_vec();
            text[at] = byte;
            // Whatever is accepted is a valid model by construction.
            let _ = import_text(&text);
        }
    }
}
