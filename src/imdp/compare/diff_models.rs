//! Choices and intervals of two models, compared through their shared rows.

use super::actions::{Actions, Name};
use super::paired_choices::PairedChoices;
use super::{DiffOptions, Differences, Section};
use crate::model::{GrowingMemory, IntervalMdp, MemoryError, Row, RowId, StateId};
use std::collections::HashMap;

/// Where a pair of rows meets first, and how often.
struct Use<'a> {
    state: StateId,
    choice: usize,
    name: Name<'a>,
    count: u64,
}

/// What a pair of rows takes, in the list of pairs and where it is looked up, while both grow.
const PAIR_BYTES: u64 = 2 * (size_of::<((RowId, RowId), Use<'_>)>() + 32) as u64;

/// Compares the choices and every transition of two models.
///
/// # Errors
/// [`MemoryError`] if there are too many pairs of rows.
pub(super) fn diff_models(
    left: &IntervalMdp,
    right: &IntervalMdp,
    options: &DiffOptions,
    out: &mut Differences,
) -> Result<(), MemoryError> {
    if left.num_states() != right.num_states() {
        out.notes.push("choices and intervals were not compared: the numbers of states differ".into());
        return Ok(());
    }
    let (left_actions, right_actions) = (Actions::new(left), Actions::new(right));
    let mut choices = Section::new("choices", options.most);
    let mut intervals = Section::new("intervals", options.most);
    let mut order: Vec<((RowId, RowId), Use<'_>)> = vec![];
    let mut known: HashMap<(RowId, RowId), usize> = HashMap::new();
    let mut memory = GrowingMemory::new("the pairs of rows to compare");
    for state in StateId::first(left.num_states()) {
        let paired = PairedChoices::new(&left_actions, &right_actions, state);
        choices.compared += 1;
        diff_choices(state, (left, right), &paired, &mut choices);
        memory.make_room(PAIR_BYTES * order.len() as u64, PAIR_BYTES * paired.pairs.len() as u64)?;
        // The names borrow from the actions, not from `paired`.
        for (choice, (name, a, b)) in paired.pairs.into_iter().enumerate() {
            let at = *known.entry((a, b)).or_insert_with(|| {
                order.push(((a, b), Use { state, choice, name, count: 0 }));
                order.len() - 1
            });
            order[at].1.count += 1;
        }
    }
    for ((a, b), used) in order {
        diff_rows((left.rows().row(a), right.rows().row(b)), &used, options, &mut intervals);
    }
    out.sections.extend([choices, intervals]);
    Ok(())
}

fn diff_choices(
    state: StateId,
    (left, right): (&IntervalMdp, &IntervalMdp),
    paired: &PairedChoices<'_>,
    section: &mut Section,
) {
    let stays = |model: &IntervalMdp| model.choices().is_absorbing(state);
    let unpaired = paired.left_only.len() + paired.right_only.len();
    if unpaired == 0 && stays(left) == stays(right) {
        return;
    }
    let describe = |model: &IntervalMdp, only: &[String]| match only {
        [] if stays(model) => "it only stays".to_owned(),
        [] => format!("{} choices", model.choices().rows(state).count()),
        [first, ..] => {
            format!("{} choices, {} of its own: {first}", model.choices().rows(state).count(), only.len())
        }
    };
    section.add(1, Some(unpaired.max(1) as f64), || {
        (format!("state {state}"), describe(left, &paired.left_only), describe(right, &paired.right_only))
    });
}

/// Compares two rows successor by successor; one that is not listed has probability 0.
fn diff_rows((a, b): (Row<'_>, Row<'_>), used: &Use<'_>, options: &DiffOptions, section: &mut Section) {
    let (mut i, mut j) = (0, 0);
    while i < a.len() || j < b.len() {
        let (s, t) = (a.successors.get(i), b.successors.get(j));
        let Some(&successor) = (match (s, t) {
            (Some(s), Some(t)) => Some(s.min(t)),
            _ => s.or(t),
        }) else {
            return;
        };
        let x = (s == Some(&successor)).then(|| (a.lower[i], a.upper[i]));
        let y = (t == Some(&successor)).then(|| (b.lower[j], b.upper[j]));
        i += usize::from(x.is_some());
        j += usize::from(y.is_some());
        section.compared += used.count;
        let absent = (0.0, 0.0);
        if let Some(by) = options.tolerance.interval_excess(x.unwrap_or(absent), y.unwrap_or(absent)) {
            let Use { state, choice, name, count } = used;
            section.add(*count, Some(by), || {
                let more = match count - 1 {
                    0 => String::new(),
                    more => format!(" (and {more} more choices with this row)"),
                };
                let name = if *name == Name::Unnamed { String::new() } else { format!(" {name}") };
                let place = format!("state {state}, choice {choice}{name}, successor {successor}{more}");
                (place, interval(x), interval(y))
            });
        }
    }
}

fn interval(bounds: Option<(f64, f64)>) -> String {
    bounds.map_or_else(|| "not listed".to_owned(), |(lower, upper)| format!("[{lower}, {upper}]"))
}
