//! Every shipped model is what its reference in `tests/references` says.
//!
//! After an intended change: `scripts/update-references.sh`, which prints what changed.
use crate::common::{abstraction, reference_mode, root, shipped_models};
use imdp::compare::{DiffOptions, Differences, Record, Tolerance, diff, open};
use imdp::model::{RowId, Rows, StateId};
use std::fs;

const MODES: [&str; 2] = ["pac", "reference"];

fn compiled(model: &str, mode: &str) -> Record {
    let set = match mode {
        "pac" => r#"/probabilities={"mode":"pac","confidence":0.99}"#.to_owned(),
        _ => reference_mode(),
    };
    let abstraction = abstraction(model, &[set]);
    Record::of_model(format!("{model} ({mode})"), abstraction.model, vec![abstraction.property])
}

fn reference(model: &str, mode: &str) -> Record {
    open(&root().join(format!("tests/references/{model}.{mode}.json"))).unwrap()
}

fn compare(reference: Record, now: Record) -> Differences {
    let tolerance = Tolerance { absolute: 1e-9, relative: 1e-9 };
    diff(reference, now, &DiffOptions { tolerance, ..DiffOptions::default() }).unwrap()
}

#[test]
fn shipped_models_are_what_their_references_say() {
    for model in shipped_models() {
        for mode in MODES {
            let comparison = compare(reference(&model, mode), compiled(&model, mode));
            assert!(
                comparison.is_same(),
                "{model} ({mode}); if this is intended, run scripts/update-references.sh\n{comparison:#?}"
            );
            let parts: Vec<_> = comparison.sections.iter().map(|section| section.part).collect();
            assert_eq!(parts, ["sizes", "labels", "intervals", "rows", "choices", "results", "values"]);
        }
    }
}

#[test]
fn every_reference_is_of_a_shipped_model_and_small() {
    let mut expected: Vec<String> =
        shipped_models().iter().flat_map(|model| MODES.map(|mode| format!("{model}.{mode}.json"))).collect();
    expected.sort();
    let files = fs::read_dir(root().join("tests/references")).unwrap().map(Result::unwrap);
    let mut found: Vec<String> = files
        .inspect(|file| assert!(file.metadata().unwrap().len() < 200_000))
        .map(|file| file.file_name().into_string().unwrap())
        .collect();
    found.sort();
    assert_eq!(found, expected);
}

/// The same model but for one upper bound of the row of one choice.
fn with_wider_interval(record: &Record, state: StateId, choice: usize, by: f64) -> (Record, StateId) {
    let model = record.model.as_ref().unwrap();
    let changed = model.choices().rows(state).nth(choice).unwrap();
    let mut rows = Rows::new();
    let mut successor = None;
    for (id, row) in RowId::first(model.rows().len()).zip(model.rows().to_stored().iter()) {
        for ((&s, &lower), &upper) in row.successors.iter().zip(row.lower).zip(row.upper) {
            let widen = id == changed && successor.is_none() && upper < 0.5;
            successor = if widen { Some(s) } else { successor };
            rows.push_entry(s, lower, if widen { upper + by } else { upper });
        }
        rows.finish_row();
    }
    let changed = Record::of_model("changed", model.with_rows(rows).unwrap(), record.properties.clone());
    (changed, successor.unwrap())
}

/// One bound in tens of millions of transitions.
#[test]
fn one_interval_of_the_double_integrator_is_found() {
    let original = compiled("double_integrator", "pac");
    let state =
        (0..1681).find(|&s| original.model.as_ref().unwrap().choices().rows(StateId(s)).count() > 3).unwrap();
    let (changed, successor) = with_wider_interval(&original, StateId(state), 2, 1e-6);

    let comparison = compare(original, changed.clone());
    let intervals = comparison.section("intervals").unwrap();
    assert!(intervals.compared > 10_000_000, "{intervals:?}");
    assert_eq!(intervals.worst.len(), 1, "a row is reported once: {intervals:?}");
    let worst = &intervals.worst[0];
    assert!((worst.by.unwrap() - 1e-6).abs() < 1e-12, "{worst:?}");
    assert!(worst.place.contains(&format!("state {state}, choice 2 a_")), "{worst:?}");
    assert!(worst.place.contains(&format!("successor {successor} (and")), "{worst:?}");

    let comparison = compare(reference("double_integrator", "pac"), changed);
    let intervals = comparison.section("intervals").unwrap();
    assert_eq!(intervals.differences, 1);
    assert!((intervals.worst[0].by.unwrap() - 1e-6).abs() < 1e-8, "{intervals:?}");
    assert_eq!(intervals.worst[0].place, format!("state {state}, choice 2, successor {successor}"));
}
