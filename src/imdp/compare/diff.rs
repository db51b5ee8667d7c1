//! The order in which things are compared.

use super::diff_digests::diff_digests;
use super::diff_labels::diff_labels;
use super::diff_models::diff_models;
use super::diff_policies::diff_policies;
use super::diff_values::{diff_results, diff_values};
use super::{CompareError, DiffOptions, Differences, Record, Section, Sizes};
use crate::property::parse_property;

/// Compares all that both sides have.
///
/// Results and values that one side lacks are computed if it has the model; if the models differ and
/// neither side has values, on both sides.
///
/// # Errors
/// [`CompareError`] if a property or policy does not fit its model, or the sides have nothing in common.
pub fn diff(mut left: Record, mut right: Record, options: &DiffOptions) -> Result<Differences, CompareError> {
    let mut out = Differences { sections: vec![], notes: vec![] };
    out.notes.extend(left.notes.iter().chain(&right.notes).cloned());
    if let (Some(left), Some(right)) = (&left.sizes, &right.sizes) {
        out.sections.push(diff_sizes(left, right, options));
    }
    one_sided("a model", has_model(&left), has_model(&right), (&left, &right), &mut out);
    match (&left.model, &right.model) {
        (Some(a), Some(b)) => {
            out.sections.push(diff_labels(a, b, options));
            diff_models(a, b, options, &mut out)?;
        }
        _ => diff_digests(&left, &right, options, &mut out),
    }
    let changed = !out.is_same();
    complete(&mut left, &right, changed, &mut out)?;
    complete(&mut right, &left, changed, &mut out)?;
    diff_results(&left, &right, options, &mut out);
    one_sided("values", left.values.is_some(), right.values.is_some(), (&left, &right), &mut out);
    diff_values(&left, &right, options, &mut out);
    one_sided("a policy", left.policy.is_some(), right.policy.is_some(), (&left, &right), &mut out);
    diff_policies(&left, &right, options, &mut out)?;
    if out.sections.is_empty() {
        let notes = out.notes.join("; ");
        return Err(CompareError::NothingInCommon { left: left.name, right: right.name, notes });
    }
    Ok(out)
}

fn has_model(record: &Record) -> bool {
    record.model.is_some() || record.digest.is_some()
}

fn one_sided(what: &str, left: bool, right: bool, sides: (&Record, &Record), out: &mut Differences) {
    if left != right {
        let owner = if left { &sides.0.name } else { &sides.1.name };
        out.notes.push(format!("only {owner} has {what}"));
    }
}

fn diff_sizes(left: &Sizes, right: &Sizes, options: &DiffOptions) -> Section {
    let mut section = Section::new("sizes", options.most);
    let list = |sizes: &Sizes| {
        let Sizes { states, choices, transitions, rows, entries } = *sizes;
        [
            ("states", Some(states)),
            ("choices", Some(choices)),
            ("transitions", Some(transitions)),
            ("distinct rows", rows),
            ("entries of distinct rows", entries),
        ]
    };
    for ((what, a), (_, b)) in list(left).into_iter().zip(list(right)) {
        let (Some(a), Some(b)) = (a, b) else { continue };
        section.compared += 1;
        if a != b {
            section.add(1, Some(a.abs_diff(b) as f64), || (what.to_owned(), a.to_string(), b.to_string()));
        }
    }
    section
}

/// Computes what the other side has and this one could have, or everything if the models changed.
fn complete(
    record: &mut Record,
    other: &Record,
    changed: bool,
    out: &mut Differences,
) -> Result<(), CompareError> {
    if record.model.is_none() {
        return Ok(());
    }
    if changed && has_model(other) {
        record.solve()?;
    }
    for result in &other.results {
        match parse_property(&result.property) {
            Ok(property) => match record.solve_property(&property) {
                Err(error @ CompareError::Property { .. }) => {
                    out.notes.push(format!("{}: {error}; it is not compared", record.name));
                }
                solved => solved?,
            },
            Err(error) => out.notes.push(format!("{}: {error}", other.name)),
        }
    }
    if other.values.is_some()
        && record.values.is_none()
        && let Some(first) = record.properties.first().cloned()
    {
        record.solve_property(&first)?;
    }
    Ok(())
}
