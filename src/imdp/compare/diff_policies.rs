//! Policies, compared by what their actions are worth.

use super::actions::Actions;
use super::backup::Backup;
use super::record::answer;
use super::{CompareError, DiffOptions, Differences, PolicyFile, Record, Section, Tolerance};
use crate::model::{IntervalMdp, RowId, StateId};
use crate::property::{Property, parse_property};
use std::collections::BTreeMap;

/// Two actions that are not the same.
struct Disagreement<'a> {
    state: StateId,
    step: Option<u64>,
    actions: (&'a str, &'a str),
    rows: (RowId, RowId),
}

/// Compares two policies: where they differ, the values of both actions must agree.
///
/// The value of an action is that of its row under the optimal values with the remaining number of steps.
pub(super) fn diff_policies(
    left: &Record,
    right: &Record,
    options: &DiffOptions,
    out: &mut Differences,
) -> Result<(), CompareError> {
    let (Some(a), Some(b)) = (&left.policy, &right.policy) else { return Ok(()) };
    let mut section = Section::new("policies", options.most);
    let alone = |one: &PolicyFile, other: &PolicyFile| {
        one.actions.keys().filter(|key| !other.actions.contains_key(key)).count()
    };
    for (record, count) in [(left, alone(a, b)), (right, alone(b, a))] {
        if count > 0 {
            out.notes.push(format!("only the policy of {} decides {count} case(s)", record.name));
        }
    }
    let pairs =
        a.actions.iter().filter_map(|(&key, x)| b.actions.get(&key).map(|y| (key, x.as_str(), y.as_str())));
    let pairs: Vec<_> = pairs.collect();
    section.compared = pairs.len() as u64;
    let mut different = pairs.into_iter().filter(|(_, x, y)| x != y).peekable();
    if different.peek().is_some() {
        match (left.model.as_ref().or(right.model.as_ref()), property(left, right)) {
            (Some(model), Some(property)) => {
                let different = resolve(model, different, (&left.name, &right.name))?;
                weigh(model, &property, different, options.tolerance, &mut section)?;
            }
            _ => {
                out.notes
                    .push("there is no model and property to tell what different actions are worth".into());
                for ((state, step), x, y) in different {
                    section.add(1, None, || (place(state, step), x.to_owned(), y.to_owned()));
                }
            }
        }
    }
    out.sections.push(section);
    Ok(())
}

/// The property that the policies are for.
fn property(left: &Record, right: &Record) -> Option<Property> {
    let own = left.properties.first().or(right.properties.first()).cloned();
    let results = || left.results.first().or(right.results.first());
    own.or_else(|| results().and_then(|result| parse_property(&result.property).ok()))
}

fn resolve<'a>(
    model: &IntervalMdp,
    different: impl Iterator<Item = ((StateId, Option<u64>), &'a str, &'a str)>,
    (left, right): (&str, &str),
) -> Result<Vec<Disagreement<'a>>, CompareError> {
    let actions = Actions::new(model);
    let row = |side: &str, state: StateId, action: &str| {
        let known = (state.index() < model.num_states()).then(|| actions.row(state, action)).flatten();
        known.ok_or_else(|| CompareError::Action { side: side.into(), state: state.0, action: action.into() })
    };
    // In a state that only stays there is nothing to choose, whatever it is called.
    let chooses =
        |state: StateId| state.index() >= model.num_states() || !model.choices().ranges(state).is_empty();
    let resolved = different.filter(|((state, _), ..)| chooses(*state)).map(|((state, step), x, y)| {
        let rows = (row(left, state, x)?, row(right, state, y)?);
        Ok(Disagreement { state, step, actions: (x, y), rows })
    });
    resolved.collect()
}

fn weigh(
    model: &IntervalMdp,
    property: &Property,
    different: Vec<Disagreement<'_>>,
    tolerance: Tolerance,
    section: &mut Section,
) -> Result<(), CompareError> {
    let solved = answer(model, property)?;
    let backup = Backup::new(model, &solved.query);
    let different = different.into_iter().filter(|d| d.rows.0 != d.rows.1 && backup.matters(d.state));
    let Some(horizon) = backup.horizon() else {
        // Bounds that are apart cannot tell more closely what an action is worth.
        let gap = solved.solution.values.gap();
        let tolerance = Tolerance { absolute: tolerance.absolute.max(gap), ..tolerance };
        different.for_each(|d| compare(&backup, &d, &solved.solution.values.lower, tolerance, section));
        return Ok(());
    };
    let mut by_steps_left: BTreeMap<u64, Vec<Disagreement<'_>>> = BTreeMap::new();
    for disagreement in different {
        if let Some(left) = horizon.checked_sub(disagreement.step.unwrap_or(0)).filter(|left| *left > 0) {
            by_steps_left.entry(left).or_default().push(disagreement);
        }
    }
    let (mut values, mut taken, mut settled) = (backup.initial(), 0, false);
    for (left, group) in by_steps_left {
        while taken + 1 < left && !settled {
            let next = backup.step(&values);
            settled = next == values;
            values = next;
            taken += 1;
        }
        group.iter().for_each(|d| compare(&backup, d, &values, tolerance, section));
    }
    Ok(())
}

fn compare(
    backup: &Backup<'_>,
    disagreement: &Disagreement<'_>,
    values: &[f64],
    tolerance: Tolerance,
    section: &mut Section,
) {
    let Disagreement { state, step, actions, rows } = disagreement;
    let worth = (backup.row_value(rows.0, values), backup.row_value(rows.1, values));
    if let Some(by) = tolerance.excess(worth.0, worth.1) {
        let text = |action: &str, worth: f64| format!("{action}, worth {worth}");
        section
            .add(1, Some(by), || (place(*state, *step), text(actions.0, worth.0), text(actions.1, worth.1)));
    }
}

fn place(state: StateId, step: Option<u64>) -> String {
    step.map_or_else(|| format!("state {state}"), |step| format!("state {state} after {step} steps"))
}
