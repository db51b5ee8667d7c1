//! Sets of states, compared state by state.

use super::{DiffOptions, Section};
use crate::model::{IntervalMdp, StateId, StateSet, VariableValues};

/// Labels, initial states, deadlocks and variables of two models.
pub(super) fn diff_labels(left: &IntervalMdp, right: &IntervalMdp, options: &DiffOptions) -> Section {
    let mut section = Section::new("labels", options.most);
    let all = |model: &IntervalMdp| -> Vec<(String, StateSet)> {
        let labels = model.labels().iter().map(|(name, set)| (format!("label \"{name}\""), set.clone()));
        let flags = model.variables().iter().filter_map(|variable| match &variable.values {
            VariableValues::Bool(set) => Some((format!("variable {}", variable.name), set.clone())),
            VariableValues::Int(_) => None,
        });
        let initial = ("label \"init\"".to_owned(), model.initial().clone());
        // A label that no state has says nothing, whether it is declared or not; states without choices are deadlocks.
        let said = labels.filter(|(name, set)| !set.is_clear() && name != "label \"init\"");
        let deadlock = model.labels().get("deadlock").is_none().then(|| {
            let without = |s: &usize| model.choices().is_deadlock(StateId::from_index(*s));
            let mut set = StateSet::with_capacity(model.num_states());
            set.extend((0..model.num_states()).filter(without));
            ("label \"deadlock\"".to_owned(), set)
        });
        let deadlock = deadlock.filter(|(_, set)| !set.is_clear());
        said.chain([initial]).chain(deadlock).chain(flags).collect()
    };
    let (left_sets, right_sets) = (all(left), all(right));
    for (name, a) in &left_sets {
        section.compared += 1;
        match right_sets.iter().find(|(other, _)| other == name) {
            Some((_, b)) => diff_sets(name, a, b, &mut section),
            None => section.add(1, None, || (name.clone(), states(a), "no such label".into())),
        }
    }
    for (name, b) in right_sets.iter().filter(|(name, _)| left_sets.iter().all(|(other, _)| other != name)) {
        section.compared += 1;
        section.add(1, None, || (name.clone(), "no such label".into(), states(b)));
    }
    diff_integers(left, right, &mut section);
    section
}

fn diff_sets(name: &str, a: &StateSet, b: &StateSet, section: &mut Section) {
    if a.len() != b.len() {
        // States of different models do not correspond; how many there are can still be told.
        let by = a.count_ones(..).abs_diff(b.count_ones(..));
        if by > 0 {
            section.add(1, Some(by as f64), || (name.to_owned(), states(a), states(b)));
        }
        return;
    }
    let mut different = a.symmetric_difference(b).peekable();
    let Some(&first) = different.peek() else { return };
    let count = different.count();
    let says = |set: &StateSet| if set.contains(first) { "has it" } else { "does not" };
    section.add(1, Some(count as f64), || {
        let place = format!("{name} of {count} state(s), the first is {first}");
        (place, format!("{} ({})", says(a), states(a)), format!("{} ({})", says(b), states(b)))
    });
}

fn diff_integers(left: &IntervalMdp, right: &IntervalMdp, section: &mut Section) {
    for variable in left.variables().iter() {
        let other = right.variables().get(&variable.name).map(|other| &other.values);
        let (VariableValues::Int(a), Some(VariableValues::Int(b))) = (&variable.values, other) else {
            continue;
        };
        if a.len() != b.len() {
            continue;
        }
        section.compared += 1;
        let count = a.iter().zip(b).filter(|(a, b)| a != b).count();
        if let Some(first) = a.iter().zip(b).position(|(a, b)| a != b) {
            section.add(1, Some(count as f64), || {
                let place = format!("variable {} in {count} state(s), the first is {first}", variable.name);
                (place, a[first].to_string(), b[first].to_string())
            });
        }
    }
}

fn states(set: &StateSet) -> String {
    format!("{} states", set.count_ones(..))
}
