//! A model against a digest, or two digests.

use super::digest::{distinct_intervals, hashes, labels};
use super::used_rows::UsedRows;
use super::{DiffOptions, Differences, ModelDigest, Record, Section, Tolerance};
use crate::model::{IntervalMdp, RowBuffer};
use std::collections::HashMap;

/// Where a model uses a row or an interval first: `state 3, choice 0, successor 7`.
type Place = Box<dyn Fn(usize) -> String>;

/// Compares what digests tell, if both sides have a model or a digest and not both a model.
///
/// A model is hashed with the intervals of the digest that are nearest to its own: an interval that moved
/// is found in the list, and hashes differ only where something else changed.
pub(super) fn diff_digests(left: &Record, right: &Record, options: &DiffOptions, out: &mut Differences) {
    let (reference, other, swapped) = match (&left.digest, &right.digest) {
        (Some(digest), _) => (digest, right, false),
        (None, Some(digest)) => (digest, left, true),
        (None, None) => return,
    };
    let sections = match (&other.model, &other.digest) {
        (Some(model), _) => against_model(reference, model, options),
        (None, Some(digest)) => against_digest(reference, digest, options, &mut out.notes),
        (None, None) => return,
    };
    out.sections.extend(sections);
    let added = out.sections.iter_mut().filter(|_| swapped);
    for difference in added.filter(|section| section.part != "sizes").flat_map(|section| &mut section.worst) {
        std::mem::swap(&mut difference.left, &mut difference.right);
    }
}

fn against_model(reference: &ModelDigest, model: &IntervalMdp, options: &DiffOptions) -> Vec<Section> {
    let used = UsedRows::new(model);
    let own = distinct_intervals(model, &used);
    let nearest: Vec<u32> = own.iter().map(|&(l, u, _)| nearest(&reference.intervals, l, u)).collect();
    let position: HashMap<_, _> =
        own.iter().zip(&nearest).map(|(&(l, u, _), &at)| (super::digest::bits(l, u), at)).collect();
    let (rows, choices, sha256) =
        hashes(model, &used, |l, u| position.get(&super::digest::bits(l, u)).copied().unwrap_or(u32::MAX));
    let now = ModelDigest { labels: labels(model), intervals: own, rows, choices, sha256 };
    let first_use = used.first_use.clone();
    let row_place: Place = Box::new(move |at| {
        first_use
            .get(at)
            .map_or_else(String::new, |(state, choice)| format!(", first in state {state}, choice {choice}"))
    });
    let intervals =
        diff_intervals(reference, &now, options, &|at| interval_place(model, &used, now.intervals[at]));
    let mut sections = vec![diff_labels(reference, &now, options), intervals];
    sections.extend(diff_hashes(reference, &now, options, &row_place));
    sections
}

fn against_digest(
    reference: &ModelDigest,
    now: &ModelDigest,
    options: &DiffOptions,
    notes: &mut Vec<String>,
) -> Vec<Section> {
    let mut sections = vec![diff_labels(reference, now, options)];
    sections.push(diff_intervals(reference, now, options, &|_| String::new()));
    let in_place = |(at, &(l, u, _)): (u32, &_)| nearest(&reference.intervals, l, u) == at;
    if reference.intervals.len() == now.intervals.len() && (0..).zip(&now.intervals).all(in_place) {
        sections.extend(diff_hashes(reference, now, options, &(Box::new(|_| String::new()) as Place)));
    } else {
        notes.push("rows and choices were not compared: two digests with different intervals".into());
    }
    sections
}

/// The position of the interval whose ends are nearest.
fn nearest(intervals: &[(f64, f64, u64)], lower: f64, upper: f64) -> u32 {
    let distance = |&(l, u, _): &(f64, f64, u64)| (l - lower).abs().max((u - upper).abs());
    let best = (0..).zip(intervals).min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)));
    best.map_or(u32::MAX, |(at, _)| at)
}

fn diff_labels(reference: &ModelDigest, now: &ModelDigest, options: &DiffOptions) -> Section {
    let mut section = Section::new("labels", options.most);
    let mut names: Vec<_> = reference.labels.keys().chain(now.labels.keys()).collect();
    names.sort();
    names.dedup();
    for name in names {
        section.compared += 1;
        let (a, b) = (reference.labels.get(name), now.labels.get(name));
        if a.map(|label| &label.sha256) == b.map(|label| &label.sha256) {
            continue;
        }
        let by = a.zip(b).map(|(a, b)| a.count.abs_diff(b.count).max(1) as f64);
        let lists = a.and_then(|a| a.states.as_ref()).zip(b.and_then(|b| b.states.as_ref()));
        let first = lists.and_then(|(a, b)| {
            let lost = a.iter().filter(|state| !b.contains(state));
            lost.chain(b.iter().filter(|state| !a.contains(state))).min()
        });
        section.add(1, by, || {
            let place = first.map_or_else(String::new, |state| format!(", first in state {state}"));
            let says = |label: Option<&super::LabelDigest>| {
                label.map_or_else(|| "no such label".to_owned(), |label| format!("{} states", label.count))
            };
            (format!("label \"{name}\"{place}"), says(a), says(b))
        });
    }
    section
}

fn diff_intervals(
    reference: &ModelDigest,
    now: &ModelDigest,
    options: &DiffOptions,
    place: &dyn Fn(usize) -> String,
) -> Section {
    let mut section = Section::new("intervals", options.most);
    let text = |(lower, upper, count): (f64, f64, u64)| format!("[{lower}, {upper}] in {count} entries");
    let matched = |list: &[(f64, f64, u64)], (l, u, _): (f64, f64, u64), tolerance: Tolerance| {
        let other = list.get(nearest(list, l, u) as usize).copied();
        let excess = |(a, b, _): (f64, f64, u64)| tolerance.interval_excess((a, b), (l, u));
        (other, other.map_or(Some(f64::INFINITY), excess))
    };
    for (at, &own) in now.intervals.iter().enumerate() {
        section.compared += own.2;
        if let (other, Some(by)) = matched(&reference.intervals, own, options.tolerance) {
            section.add(own.2, Some(by), || {
                let nearest =
                    other.map_or_else(|| "none".into(), |other| format!("nearest: {}", text(other)));
                (place(at), nearest, text(own))
            });
        }
    }
    for &gone in &reference.intervals {
        if let (other, Some(by)) = matched(&now.intervals, gone, options.tolerance) {
            section.add(0, Some(by), || {
                let nearest =
                    other.map_or_else(|| "none".into(), |other| format!("nearest: {}", text(other)));
                ("an interval that is gone".into(), text(gone), nearest)
            });
            // Counted once, as the entries that have another interval now, unless there are none.
            section.differences += u64::from(section.differences == 0);
        }
    }
    section
}

/// Where a model has an interval first.
fn interval_place(model: &IntervalMdp, used: &UsedRows, (lower, upper, _): (f64, f64, u64)) -> String {
    let mut buffer = RowBuffer::default();
    for (&row, (state, choice)) in used.rows.iter().zip(&used.first_use) {
        let row = model.rows().row(row, &mut buffer);
        let at = row.lower.iter().zip(row.upper).position(|(&l, &u)| l == lower && u == upper);
        if let Some(at) = at {
            return format!("state {state}, choice {choice}, successor {}", row.successors[at]);
        }
    }
    String::new()
}

fn diff_hashes(
    reference: &ModelDigest,
    now: &ModelDigest,
    options: &DiffOptions,
    place: &Place,
) -> [Section; 2] {
    let mut rows = Section::new("rows", options.most);
    let count = |hashes: &[String]| {
        let mut counts: HashMap<String, usize> = HashMap::new();
        hashes.iter().for_each(|hash| *counts.entry(hash.clone()).or_default() += 1);
        counts
    };
    let (mut before, mut after) = (count(&reference.rows), count(&now.rows));
    let take = |known: &mut HashMap<String, usize>, hash: &String| match known.get_mut(hash) {
        Some(left) if *left > 0 => {
            *left -= 1;
            true
        }
        _ => false,
    };
    rows.compared = reference.rows.len().max(now.rows.len()) as u64;
    for (at, hash) in now.rows.iter().enumerate() {
        if !take(&mut before, hash) {
            rows.add(1, None, || (format!("row {at}{}", place(at)), "no such row".into(), hash.clone()));
        }
    }
    let added = rows.differences;
    let gone: Vec<_> =
        reference.rows.iter().enumerate().filter(|(_, hash)| !take(&mut after, hash)).collect();
    for (nth, (at, hash)) in gone.into_iter().enumerate() {
        // A row that changed is one that came and one that went.
        let items = u64::from(nth as u64 >= added);
        rows.add(items, None, || (format!("row {at} of the reference"), hash.clone(), "no such row".into()));
    }
    let mut choices = Section::new("choices", options.most);
    choices.compared = reference.choices.len().max(now.choices.len()) as u64;
    if reference.choices.len() == now.choices.len() {
        for (state, (a, b)) in reference.choices.iter().zip(&now.choices).enumerate() {
            if a != b {
                choices.add(1, None, || (format!("state {state}"), a.clone(), b.clone()));
            }
        }
    }
    if choices.differences == 0 && reference.sha256 != now.sha256 {
        choices.add(1, None, || ("all states".into(), reference.sha256.clone(), now.sha256.clone()));
    }
    [rows, choices]
}
