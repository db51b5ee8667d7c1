//! Random and hand-made models.

use imdp::model::*;
use proptest::prelude::*;

pub type Entries = Vec<(u32, f64, f64)>;

/// `states[s]` are ranges of rows; `None` is absorbing, an empty list a deadlock.
pub fn model(rows: &[Entries], states: &[Option<Vec<(u32, u32)>>]) -> IntervalMdp {
    let mut list = Rows::new();
    for row in rows {
        row.iter().for_each(|&(s, l, u)| list.push_entry(StateId(s), l, u));
        list.finish_row();
    }
    let mut builder = ChoicesBuilder::with_capacity(states.len());
    for state in states {
        match state {
            None => builder.push_absorbing(),
            Some(ranges) => {
                ranges.iter().for_each(|&(first, last)| {
                    builder.push_range(RowRange { first: RowId(first), last: RowId(last) })
                });
                builder.finish_state();
            }
        }
    }
    IntervalMdp::new(Parts {
        kind: ModelKind::Imdp,
        rows: list,
        choices: builder.finish(),
        actions: ActionNames::None,
        initial: set(states.len(), &[0]),
        labels: Labels::default(),
        variables: StateVariables::default(),
    })
    .unwrap()
}

/// The same model with the sets as its labels `safe` and `goal`.
pub fn labelled(model: &IntervalMdp, safe: &StateSet, goal: &StateSet) -> IntervalMdp {
    let mut labels = Labels::default();
    labels.insert("safe", safe.clone());
    labels.insert("goal", goal.clone());
    IntervalMdp::new(Parts {
        kind: model.kind(),
        rows: model.rows().clone(),
        choices: model.choices().clone(),
        actions: model.actions().clone(),
        initial: model.initial().clone(),
        labels,
        variables: model.variables().clone(),
    })
    .unwrap()
}

pub fn set(states: usize, members: &[usize]) -> StateSet {
    let mut set = StateSet::with_capacity(states);
    members.iter().for_each(|&s| set.insert(s));
    set
}

/// A row over at most `width` of `states` states, bounds in multiples of 1/20 (or nearly 0 or 1).
fn row(states: u32, width: usize) -> impl Strategy<Value = Entries> {
    let entry = (0..states, 0u32..=20, 0u32..=20, any::<bool>());
    (prop::collection::vec(entry, 1..=width), 0..8u8).prop_map(|(mut entries, kind)| {
        entries.sort_by_key(|entry| entry.0);
        entries.dedup_by_key(|entry| entry.0);
        if kind == 0 && entries.len() > 1 {
            // A slow one: nearly all the mass in one place.
            let last = entries.len() - 1;
            let slow = |(i, e): (usize, &(u32, u32, u32, bool))| {
                if i == last { (e.0, 0.999, 0.9999) } else { (e.0, 0.0, if e.3 { 0.001 } else { 0.002 }) }
            };
            return entries
                .iter()
                .enumerate()
                .map(slow)
                .map(|(s, l, u)| (s, l, if u < 0.01 { 0.002 } else { u }))
                .collect();
        }
        let mut lower: Vec<u32> = entries.iter().map(|e| if e.3 { 0 } else { e.1.min(e.2) }).collect();
        let mut upper: Vec<u32> = entries.iter().map(|e| e.1.max(e.2)).collect();
        while lower.iter().sum::<u32>() > 20 {
            let i = (0..lower.len()).max_by_key(|&i| lower[i]).unwrap_or(0);
            lower[i] -= 1;
        }
        while upper.iter().sum::<u32>() < 20 {
            let i = (0..upper.len()).min_by_key(|&i| upper[i]).unwrap_or(0);
            upper[i] += 1;
        }
        if kind == 1 {
            // A point: the lower bounds filled up.
            for i in 0..lower.len() {
                let missing = 20 - lower.iter().sum::<u32>();
                lower[i] += missing.min(upper[i] - lower[i]);
            }
            upper = lower.clone();
        }
        let twentieth = |x: u32| format!("{}e-2", 5 * x).parse::<f64>().unwrap();
        entries.iter().enumerate().map(|(i, e)| (e.0, twentieth(lower[i]), twentieth(upper[i]))).collect()
    })
}

/// A model with its safe and goal sets.
pub fn any_model(moving: usize, width: usize) -> impl Strategy<Value = (IntervalMdp, StateSet, StateSet)> {
    let states = moving + 3;
    let rows = prop::collection::vec(row(states as u32, width), 2..=5);
    let picks = prop::collection::vec((any::<u32>(), 0u32..2, any::<u8>()), moving);
    (rows, picks, any::<u8>()).prop_map(move |(rows, picks, flags)| {
        let count = rows.len() as u32;
        let mut choices: Vec<Option<Vec<(u32, u32)>>> = picks
            .iter()
            .map(|&(first, more, kind)| {
                let first = first % count;
                match kind % 16 {
                    0 => None,
                    1 => Some(vec![]),
                    2 | 3 => Some(vec![(first, first), (0, 0)]),
                    _ => Some(vec![(first, (first + more).min(count - 1))]),
                }
            })
            .collect();
        choices.extend([None, None, Some(vec![])]);
        let mut safe = StateSet::with_capacity(states);
        safe.insert_range(..);
        if flags % 4 == 0 {
            safe.set(moving - 1, false);
        }
        (model(&rows, &choices), safe, set(states, &[moving]))
    })
}
