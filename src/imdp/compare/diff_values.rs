//! Results of properties, and values of states.

use super::{DiffOptions, Differences, Record, RecordedResult, Section};
use crate::formats::StateValues;

/// Compares the answers to properties that both sides have, paired by their text.
pub(super) fn diff_results(left: &Record, right: &Record, options: &DiffOptions, out: &mut Differences) {
    let mut section = Section::new("results", options.most);
    let find = |record: &'_ Record, property: &str| -> Option<RecordedResult> {
        record.results.iter().find(|result| result.property == property).cloned()
    };
    for a in &left.results {
        match find(right, &a.property) {
            Some(b) => diff_result(a, &b, options, &mut section),
            None => out.notes.push(format!("only {} has a result for {}", left.name, a.property)),
        }
    }
    for b in right.results.iter().filter(|b| find(left, &b.property).is_none()) {
        out.notes.push(format!("only {} has a result for {}", right.name, b.property));
    }
    if section.compared > 0 {
        out.sections.push(section);
    }
}

fn diff_result(a: &RecordedResult, b: &RecordedResult, options: &DiffOptions, section: &mut Section) {
    section.compared += 4;
    let numbers = [("lower", a.lower, b.lower), ("upper", a.upper, b.upper)];
    for (what, x, y) in numbers {
        let (Some(x), Some(y)) = (x, y) else { continue };
        if let Some(by) = options.tolerance.excess(x, y) {
            section.add(1, Some(by), || {
                (format!("{what} bound of {}", a.property), x.to_string(), y.to_string())
            });
        }
    }
    let satisfied = |result: &RecordedResult| result.satisfied.map(|satisfied| satisfied.to_string());
    let texts = [("verdict", satisfied(a), satisfied(b)), ("status", a.status.clone(), b.status.clone())];
    for (what, x, y) in texts {
        if x != y && (what == "verdict" || (x.is_some() && y.is_some())) {
            let text = |x: Option<String>| x.unwrap_or_else(|| "undecided".into());
            section.add(1, None, || (format!("{what} of {}", a.property), text(x), text(y)));
        }
    }
}

/// Compares the values of all states.
pub(super) fn diff_values(left: &Record, right: &Record, options: &DiffOptions, out: &mut Differences) {
    let (Some(a), Some(b)) = (&left.values, &right.values) else { return };
    let mut section = Section::new("values", options.most);
    let lengths = match (a, b) {
        (StateValues::Numbers(a), StateValues::Numbers(b)) => {
            for (state, (&x, &y)) in a.iter().zip(b).enumerate().take(comparable(a.len(), b.len())) {
                if let Some(by) = options.tolerance.excess(x, y) {
                    section.add(1, Some(by), || (format!("state {state}"), x.to_string(), y.to_string()));
                }
            }
            (a.len(), b.len())
        }
        (StateValues::Verdicts(a), StateValues::Verdicts(b)) => {
            for (state, (x, y)) in
                a.iter().zip(b).enumerate().take(comparable(a.len(), b.len())).filter(|(_, (x, y))| x != y)
            {
                section.add(1, None, || (format!("state {state}"), x.to_string(), y.to_string()));
            }
            (a.len(), b.len())
        }
        _ => {
            out.notes.push("values were not compared: one side has numbers, the other verdicts".into());
            return;
        }
    };
    section.compared = comparable(lengths.0, lengths.1).max(1) as u64;
    if lengths.0 != lengths.1 {
        let states = |n: usize| format!("{n} states");
        section.add(1, None, || ("the number of values".into(), states(lengths.0), states(lengths.1)));
    }
    out.sections.push(section);
}

/// How many states can be compared: those of different models do not correspond.
fn comparable(left: usize, right: usize) -> usize {
    if left == right { left } else { 0 }
}
