//! A round trip through any two formats returns the same model.

use super::*;
use crate::common::{abstraction, data, shipped_models, table_one_row};
use crate::solver::models::{any_model, set};
use imdp::formats::prism::RAISED_LOWER_BOUND;
use proptest::prelude::*;

const ALL: [Format; 4] = Format::ALL;

/// What a format makes of a model that was read before: only PRISM's files have no zeros and always variables.
fn expected(model: &IntervalMdp, format: Format) -> IntervalMdp {
    if format != Format::Prism {
        return model.clone();
    }
    let mut parts = parts(model);
    let mut rows = Rows::new();
    for row in model.rows().to_stored().iter() {
        for ((&successor, &lower), &upper) in row.successors.iter().zip(row.lower).zip(row.upper) {
            let lower = if lower == 0.0 { RAISED_LOWER_BOUND } else { lower };
            rows.push_entry(successor, lower, upper.max(lower));
        }
        rows.finish_row();
    }
    parts.rows = rows.into();
    if parts.variables.is_empty() {
        let values = (0..model.num_states() as i32).collect();
        parts.variables.push("s", VariableValues::Int(values));
    }
    IntervalMdp::new(parts).unwrap()
}

/// Lower bounds that sum to 1 sum to more with the zeros raised for PRISM: reading widens them.
fn raising_exceeds_one(model: &IntervalMdp) -> bool {
    let exceeds = |row: Row<'_>| row.lower.contains(&0.0) && row.lower.iter().sum::<f64>() > 1.0 - 1e-9;
    model.rows().to_stored().iter().any(exceeds)
}

/// A choice: its name and its transitions.
type Choice = (Option<String>, Vec<(StateId, f64, f64)>);

/// All choices of all states, written out, with their names.
fn expanded(model: &IntervalMdp) -> Vec<Vec<Choice>> {
    let mut choice = 0;
    let of_state = |state: StateId| {
        let mut of_state = vec![];
        let mut push = |row: Option<RowId>, entries| {
            of_state.push((model.actions().name(choice, row).map(|name| name.into_owned()), entries));
            choice += 1;
        };
        if model.choices().is_absorbing(StateId(state.0)) {
            push(None, vec![(state, 1.0, 1.0)]);
        }
        for id in model.choices().rows(StateId(state.0)) {
            let buffer = &mut RowBuffer::default();
            let row = model.rows().row(id, buffer);
            let bounds = row.lower.iter().zip(row.upper);
            push(
                Some(RowId(id.0)),
                row.successors.iter().zip(bounds).map(|(&s, (&l, &u))| (s, l, u)).collect(),
            );
        }
        of_state
    };
    StateId::first(model.num_states()).map(of_state).collect()
}

/// The model once it has been read from a file: rows are numbered by their first use.
fn imported(model: &IntervalMdp, directory: &Path) -> IntervalMdp {
    let first = read(&write(model, Format::Umb, directory));
    assert_eq!(expanded(&first), expanded(model));
    assert_eq!(first.labels(), model.labels());
    assert_eq!(first.initial(), model.initial());
    assert_eq!(first.variables(), model.variables());
    assert_eq!(first.kind(), model.kind());
    first
}

/// Takes a model from format to format; each one must return what it was given.
fn travel(model: &IntervalMdp, itinerary: &[Format], directory: &Path) {
    let mut now = imported(model, directory);
    for &format in itinerary {
        let before = now;
        now = read(&write(&before, format, directory));
        if format == Format::Prism && raising_exceeds_one(&before) {
            continue;
        }
        let expected = expected(&before, format);
        assert!(now == expected, "{format}: {:?} instead of {:?}", now.size(), expected.size());
    }
}

/// Every format after every other.
const EVERYWHERE: [Format; 17] = {
    let [p, d, u, n] = ALL;
    [p, p, d, d, u, u, n, n, p, u, d, n, d, p, n, u, p]
};

/// Bounds that PRISM's files change are changed at most once: zeros first, so that the others see them.
const ZEROS_FIRST: [Format; 4] = [Format::Drn, Format::Umb, Format::Native, Format::Prism];

#[test]
fn every_pair_occurs() {
    let pairs: std::collections::BTreeSet<_> = EVERYWHERE.windows(2).map(|pair| (pair[0], pair[1])).collect();
    assert_eq!(pairs.len(), 16);
}

#[test]
fn a_model_with_everything_comes_back() {
    let scratch = tempfile::tempdir().unwrap();
    let model = tiny::model();
    travel(&model, &ZEROS_FIRST, scratch.path());
    travel(&model, &EVERYWHERE, scratch.path());
}

/// Bounds below what lower bounds of 0 are raised to, and a zero with a sign.
#[test]
fn bounds_at_the_edge_of_doubles_come_back() {
    let model = crate::solver::models::model(
        &[vec![(0, -0.0, 1e-309), (1, 0.0, 1e-305), (2, 0.5, 1.0)], vec![(0, 0.0, 0.5), (2, 0.0, 1.0)]],
        &[Some(vec![(0, 1)]), None, None],
    );
    let scratch = tempfile::tempdir().unwrap();
    for format in ALL {
        let read = read(&write(&model, format, scratch.path()));
        for (written, row) in model.rows().to_stored().iter().zip(read.rows().to_stored().iter()) {
            assert_eq!(row.upper, written.upper, "{format}");
            let bounds = row.lower.iter().zip(row.upper).zip(written.lower);
            assert!(
                bounds
                    .into_iter()
                    .all(|((l, u), w)| l == w || (*w == 0.0 && *l <= RAISED_LOWER_BOUND.min(*u))),
                "{format}: {row:?}"
            );
        }
    }
}

#[test]
fn shipped_models_come_back() {
    let scratch = tempfile::tempdir().unwrap();
    for name in shipped_models().iter().filter(|name| !name.starts_with("double_integrator")) {
        let model = abstraction(name, &[]).model;
        let small = model.size().transitions < 300_000;
        travel(&model, if small { &EVERYWHERE } else { &ZEROS_FIRST }, scratch.path());
    }
}

#[test]
fn double_integrators_come_back() {
    let scratch = tempfile::tempdir().unwrap();
    let table = data("table1.json");
    let rows = table["rows"].as_array().unwrap();
    let of_model = |name: &str| {
        let rows = rows.iter().filter(|row| table_one_row(row).0 == name);
        rows.min_by_key(|row| row["transitions"].as_u64()).unwrap()
    };
    for name in shipped_models().iter().filter(|name| name.starts_with("double_integrator")) {
        let (model, sets) = table_one_row(of_model(name));
        assert_eq!(model, name);
        // Millions of transitions: not everywhere.
        travel(&abstraction(model, &sets).model, &[Format::Drn, Format::Prism], scratch.path());
    }
}

/// A random model with labels, variables and names, or without any of them.
fn any_decorated_model() -> impl Strategy<Value = IntervalMdp> {
    (any_model(6, 4), prop::collection::vec((any::<i32>(), any::<bool>()), 9), 0..4u8).prop_map(
        |((model, safe, goal), values, what)| {
            let mut parts = parts(&model);
            let states = model.num_states();
            if what > 0 {
                parts.labels.insert("safe", safe);
                parts.labels.insert("goal", goal);
                parts.labels.insert("never", set(states, &[]));
            }
            if what > 1 {
                parts.variables.push("x", VariableValues::Int(values.iter().map(|value| value.0).collect()));
                let mut odd = set(states, &[]);
                odd.extend((0..states).filter(|&state| values[state].1));
                parts.variables.push("b", VariableValues::Bool(odd));
            }
            parts.actions = match what {
                2 => ActionNames::OfRow,
                3 => ActionNames::OfChoice {
                    names: vec!["go".into(), "_7".into()],
                    ids: (0..model.size().choices)
                        .map(|choice| [0, 1, ActionNames::UNNAMED][(choice % 3) as usize])
                        .collect(),
                },
                _ => ActionNames::None,
            };
            IntervalMdp::new(parts).unwrap()
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn random_models_come_back(model in any_decorated_model()) {
        let scratch = tempfile::tempdir().unwrap();
        travel(&model, &ZEROS_FIRST, scratch.path());
        travel(&model, &EVERYWHERE, scratch.path());
    }
}
