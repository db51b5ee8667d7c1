//! Writing bmdp-tool's format.

use super::REACH;
use crate::model::{End, IntervalMdp, RowBuffer, RowId, StateId};
use crate::progress::Progress;
use std::fmt::Write as _;
use std::io::{self, Write};

/// Writes a model in bmdp-tool's format.
///
/// Every state gets as many actions as the state with the most, the last of its own repeated: that changes no value. The
/// states to be reached are those with the label `reach`, or the first of `reached`, `goal` and `target` that the model has.
#[derive(Debug)]
pub struct BmdpWriter<'a> {
    model: &'a IntervalMdp,
    actions: usize,
    goal: Option<&'a str>,
}

/// The labels that are taken for the states to be reached.
const GOALS: [&str; 4] = [REACH, "reached", "goal", "target"];

impl<'a> BmdpWriter<'a> {
    /// Prepares to write `model`.
    pub fn new(model: &'a IntervalMdp) -> Self {
        let states = StateId::first(model.num_states());
        let actions = states.map(|state| model.choices().num_choices_of(state)).max().unwrap_or(0).max(1);
        let goal = GOALS.into_iter().find(|goal| model.labels().get(goal).is_some());
        Self { model, actions, goal }
    }

    /// The label that the states to be reached have; none if none is known.
    pub fn goal(&self) -> Option<&'a str> {
        self.goal
    }

    /// Writes the file.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, out: &mut impl Write, progress: &dyn Progress) -> io::Result<()> {
        let model = self.model;
        let goal = self.goal.and_then(|goal| model.labels().get(goal));
        let reached: Vec<usize> = goal.into_iter().flat_map(|goal| goal.ones()).collect();
        writeln!(out, "{}\n{}\n{}", model.num_states(), self.actions, reached.len())?;
        for state in reached {
            writeln!(out, "{state}")?;
        }
        let mut text = String::new();
        for state in StateId::first(model.num_states()) {
            text.clear();
            for (action, row) in padded_choices(model, state, self.actions).enumerate() {
                self.transitions(state, action, row, &mut text);
            }
            if progress.is_interrupted() {
                return Err(io::Error::other("interrupted, nothing was written"));
            }
            out.write_all(text.as_bytes())?;
        }
        Ok(())
    }

    fn transitions(&self, state: StateId, action: usize, row: Option<RowId>, text: &mut String) {
        // Writing to a string cannot fail.
        let buffer = &mut RowBuffer::default();
        let Some(row) = row.map(|row| self.model.rows().row(row, buffer)) else {
            let _ = writeln!(text, "{state} {action} {state} 1 1");
            return;
        };
        for (i, successor) in row.successors.iter().enumerate() {
            let [lower, upper] = [End::Lower, End::Upper].map(|end| row.text(end, i));
            let _ = writeln!(text, "{state} {action} {successor} {lower} {upper}");
        }
    }
}

/// The rows of a state's choices, none for self-loops, the last one repeated up to so many.
pub(in crate::formats) fn padded_choices(
    model: &IntervalMdp,
    state: StateId,
    count: usize,
) -> impl Iterator<Item = Option<RowId>> + '_ {
    let last = model.choices().rows(state).last();
    model.choices().rows(state).map(Some).chain(std::iter::repeat(last)).take(count)
}
