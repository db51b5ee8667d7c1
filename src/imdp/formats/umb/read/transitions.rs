//! Choices and branches, streamed side by side.

use super::super::member;
use super::actions::Actions;
use super::archive::Archive;
use super::array::{Array, Offsets};
use super::index::Index;
use crate::formats::import::{
    Assembly, AssemblyError, Expected, ImportError, Interval, Judgement, PendingRow, Position, RowFault,
    Transitions, Warning, hash_row,
};
use crate::model::{RowId, Rows, StateId, StateSet};
use crate::numeric::shortest_decimal;

/// How many branches are read between two signs of life.
const STRIDE: u64 = 1 << 16;

/// Reads the transitions; `progress` is told how many branches have been read.
pub(super) fn read_transitions(
    archive: &Archive,
    index: &mut Index,
    without_choices: Option<&StateSet>,
    progress: &mut dyn FnMut(u64),
) -> Result<Transitions, ImportError> {
    let counts = index.counts;
    let mut of_state =
        Offsets::open(archive, member::STATE_TO_CHOICES, counts.states, counts.choices, "states")?;
    let mut of_choice =
        Offsets::open(archive, member::CHOICE_TO_BRANCHES, counts.choices, counts.branches, "choices")?;
    let mut actions = Actions::open(archive, index)?;
    let mut branches = Branches::open(archive, index)?;
    let expected = Expected { states: counts.states, choices: counts.choices, transitions: counts.branches };
    let mut assembly = Assembly::new(expected)?;
    let mut row = PendingRow::default();
    let mut rows = Rows::new();
    let mut widened: Option<(u64, Position)> = None;
    let mut told = 0;
    for state in 0..counts.states {
        for choice in of_state.next(state + 1 == counts.states)? {
            let range = of_choice.next(choice + 1 == counts.choices)?;
            let at_choice = |name: &str| Position::member(archive.path(), name, Some(choice));
            if range.is_empty() {
                return Err(at_choice(member::CHOICE_TO_BRANCHES).refuse("a choice with branches", "none"));
            }
            row.clear();
            for _ in range.clone() {
                let (successor, lower, upper) = branches.next()?;
                row.push(successor, Interval::of_doubles(lower, upper));
            }
            let action = match &mut actions {
                Some(actions) => actions.next(range.end - range.start, &mut assembly)?,
                None => None,
            };
            // Doubles stand for their shortest decimals, as in a text.
            let texts = if row.is_clear() { vec![] } else { decimals(&row) };
            let written = || texts.iter().map(|(lower, upper)| (lower.as_bytes(), upper.as_bytes()));
            rows.clear();
            let at_branch =
                |nth: u64, name: &str| Position::member(archive.path(), name, Some(range.start + nth));
            let judgement = row.finish(written, &mut rows).map_err(|fault| match fault {
                RowFault::Twice { successor, nth } => at_branch(u64::from(nth), member::BRANCH_TO_TARGET)
                    .refuse(RowFault::ONCE, successor.to_string()),
                RowFault::NoDistribution(fault) => {
                    at_branch(0, member::BRANCH_TO_PROBABILITY).refuse(fault.expected, fault.sum)
                }
            })?;
            if judgement != Judgement::FINE {
                let first = at_branch(0, member::BRANCH_TO_PROBABILITY);
                widened.get_or_insert((0, first)).0 += 1;
            }
            if without_choices.is_some_and(|set| set.contains(state as usize)) {
                continue;
            }
            let content = rows.row(RowId(0));
            assembly.push(StateId(state as u32), hash_row(content), content, action).map_err(|error| {
                match error {
                    AssemblyError::Memory(error) => error.into(),
                    AssemblyError::TooManyRows => {
                        at_choice(member::CHOICE_TO_BRANCHES).refuse(AssemblyError::at_most(), "one more")
                    }
                }
            })?;
            if range.end - told > STRIDE {
                told = range.end;
                progress(told);
            }
        }
    }
    let mut transitions = assembly.finish();
    let widened = widened.map(|(count, first)| Warning::Widened { count, first });
    transitions.warnings.splice(0..0, widened);
    Ok(transitions)
}

fn decimals(row: &PendingRow) -> Vec<(String, String)> {
    let bounds = row.bounds().into_iter();
    bounds.map(|(lower, upper)| (shortest_decimal(lower), shortest_decimal(upper))).collect()
}

/// The destinations and bounds of branches.
struct Branches {
    states: u64,
    targets: Array,
    /// Without probabilities, every branch has probability 1.
    bounds: Option<Array>,
    intervals: bool,
    zero_lower_bound: Option<f64>,
}

impl Branches {
    fn open(archive: &Archive, index: &Index) -> Result<Self, ImportError> {
        let branches = index.counts.branches;
        let Some(targets) = Array::open(archive, member::BRANCH_TO_TARGET, 8, branches)? else {
            let at = Position::member(archive.path(), member::BRANCH_TO_TARGET, None);
            return Err(at.refuse("the destinations of all branches", "no such member"));
        };
        let width = if index.intervals { 16 } else { 8 };
        Ok(Self {
            states: index.counts.states,
            targets,
            bounds: Array::open(archive, member::BRANCH_TO_PROBABILITY, width, branches)?,
            intervals: index.intervals,
            zero_lower_bound: index.zero_lower_bound,
        })
    }

    #[inline]
    fn next(&mut self) -> Result<(StateId, f64, f64), ImportError> {
        let target = self.targets.next_u64()?;
        if target >= self.states {
            let expected = format!("a destination below {}, the number of states", self.states);
            return Err(self.targets.refuse(expected, target.to_string()));
        }
        let Some(array) = &mut self.bounds else {
            return Ok((StateId(target as u32), 1.0, 1.0));
        };
        let (mut lower, mut upper) = if self.intervals { array.next_pair()? } else { array.next_double()? };
        if let Some(zero) = self.zero_lower_bound.filter(|zero| *zero == lower) {
            upper = if upper == zero { 0.0 } else { upper };
            lower = 0.0;
        }
        // Written so that NaN fails.
        for bound in [lower, upper] {
            if !(0.0..=1.0).contains(&bound) {
                return Err(array.refuse("probabilities between 0 and 1", format!("{bound:?}")));
            }
        }
        if lower > upper {
            let expected = format!("an upper bound of at least {}", shortest_decimal(lower));
            return Err(array.refuse(expected, shortest_decimal(upper)));
        }
        // There is a negative zero.
        Ok((StateId(target as u32), lower + 0.0, upper + 0.0))
    }
}
