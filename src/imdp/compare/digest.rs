//! A model in a few kilobytes, with which a changed model can be told where it changed.

use super::used_rows::UsedRows;
use crate::formats::sha256_hex;
use crate::model::{IntervalMdp, RowBuffer, StateId, StateSet};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, HashMap};

/// Sets of at most this many states are listed.
const MAX_LISTED: usize = 100;

/// How large a model is; rows and their entries are the distinct ones that some state uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Sizes {
    /// The number of states.
    pub states: u64,
    /// The number of choices.
    pub choices: u64,
    /// The number of transitions.
    pub transitions: u64,
    /// The number of distinct rows, if known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rows: Option<u64>,
    /// The number of their entries, if known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub entries: Option<u64>,
}

/// A set of states.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LabelDigest {
    /// How many states it has.
    pub count: u64,
    /// The SHA-256 of the states, ascending, each followed by a blank.
    pub sha256: String,
    /// The states, if they are few.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub states: Option<Vec<StateId>>,
}

/// Labels, intervals and choices of a model.
///
/// Intervals are listed once; rows are hashed with positions in that list instead of bounds, so that the
/// bounds themselves can be compared with a tolerance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelDigest {
    /// The labels, `init` among them.
    pub labels: BTreeMap<String, LabelDigest>,
    /// The distinct intervals and how many entries of distinct rows have them, ascending.
    pub intervals: Vec<(f64, f64, u64)>,
    /// A hash of every distinct row, in the order of first use.
    pub rows: Vec<String>,
    /// A hash of the choices of every state; `stay` if it is absorbing, `none` if it has none.
    pub choices: Vec<String>,
    /// The SHA-256 of all choices of all states.
    pub sha256: String,
}

impl Sizes {
    /// The sizes of a model.
    pub fn new(model: &IntervalMdp) -> Self {
        let (size, used) = (model.size(), UsedRows::new(model));
        Self {
            states: size.states,
            choices: size.choices,
            transitions: size.transitions,
            rows: Some(used.rows.len() as u64),
            entries: Some(used.entries(model)),
        }
    }
}

impl LabelDigest {
    fn new(set: &StateSet) -> Self {
        let states: Vec<StateId> = set.ones().map(StateId::from_index).collect();
        let text: String = states.iter().map(|state| format!("{state} ")).collect();
        Self {
            count: states.len() as u64,
            sha256: sha256_hex(text.as_bytes()),
            states: (states.len() <= MAX_LISTED).then_some(states),
        }
    }
}

impl ModelDigest {
    /// The digest of a model.
    pub fn new(model: &IntervalMdp) -> Self {
        let used = UsedRows::new(model);
        let intervals = distinct_intervals(model, &used);
        let position: HashMap<_, _> =
            (0..).zip(&intervals).map(|(at, &(lower, upper, _))| (bits(lower, upper), at)).collect();
        // Every interval of a used row is in the list.
        let index = |lower, upper| position.get(&bits(lower, upper)).copied().unwrap_or(u32::MAX);
        let (rows, choices, sha256) = hashes(model, &used, index);
        Self { labels: labels(model), intervals, rows, choices, sha256 }
    }
}

pub(super) fn bits(lower: f64, upper: f64) -> (u64, u64) {
    // Adding 0 turns −0 into 0.
    ((lower + 0.0).to_bits(), (upper + 0.0).to_bits())
}

/// The distinct intervals and how many entries have them, ascending.
pub(super) fn distinct_intervals(model: &IntervalMdp, used: &UsedRows) -> Vec<(f64, f64, u64)> {
    let mut counts: BTreeMap<(u64, u64), u64> = BTreeMap::new();
    let mut buffer = RowBuffer::default();
    for &row in &used.rows {
        let row = model.rows().row(row, &mut buffer);
        for (&lower, &upper) in row.lower.iter().zip(row.upper) {
            *counts.entry(bits(lower, upper)).or_default() += 1;
        }
    }
    // The bits of non-negative doubles are in the order of the doubles.
    counts.into_iter().map(|((l, u), count)| (f64::from_bits(l), f64::from_bits(u), count)).collect()
}

/// Hashes of rows and choices, `index` giving the position of an interval.
pub(super) fn hashes(
    model: &IntervalMdp,
    used: &UsedRows,
    index: impl Fn(f64, f64) -> u32,
) -> (Vec<String>, Vec<String>, String) {
    let mut buffer = RowBuffer::default();
    let digests: Vec<[u8; 32]> = used
        .rows
        .iter()
        .map(|&row| {
            let (row, mut hash) = (model.rows().row(row, &mut buffer), Sha256::new());
            for ((successor, &lower), &upper) in row.successors.iter().zip(row.lower).zip(row.upper) {
                hash.update(successor.0.to_le_bytes());
                hash.update(index(lower, upper).to_le_bytes());
            }
            hash.finalize().into()
        })
        .collect();
    let (mut choices, mut all) = (Vec::with_capacity(model.num_states()), Sha256::new());
    for state in StateId::first(model.num_states()) {
        let word = if model.choices().is_absorbing(state) { "stay" } else { "none" };
        let mut hash = Sha256::new();
        for row in model.choices().rows(state) {
            hash.update(digests[used.index[row.index()] as usize]);
        }
        let digest: [u8; 32] = hash.finalize().into();
        let empty = model.choices().ranges(state).is_empty();
        let text = if empty { word.to_owned() } else { short(&digest) };
        all.update(if empty { word.as_bytes() } else { &digest });
        choices.push(text);
    }
    let rows = digests.iter().map(short).collect();
    (rows, choices, all.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
}

/// Enough to tell rows apart.
fn short(digest: &[u8; 32]) -> String {
    digest[..4].iter().map(|byte| format!("{byte:02x}")).collect()
}

/// All labels and the initial states.
pub(super) fn labels(model: &IntervalMdp) -> BTreeMap<String, LabelDigest> {
    let declared = model.labels().iter().map(|(name, set)| (name.to_owned(), LabelDigest::new(set)));
    declared.chain([("init".to_owned(), LabelDigest::new(model.initial()))]).collect()
}
