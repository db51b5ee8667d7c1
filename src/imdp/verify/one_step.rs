//! One application of the operator: whether bounds follow from the bounds one step later.

use super::Rejection;
use super::bounds::Bounds;
use super::extremum::Extremum;
use super::side::Side;
use super::task::Task;
use crate::model::ExactRow;
use crate::model::{IntervalMdp, MemoryError, RowBuffer, RowId, StateId, StateSet, require_memory};
use rayon::prelude::*;

/// The choice of a state that the policy says nothing about.
pub(super) const NO_CHOICE: u32 = u32::MAX;

/// The exact rows that moving states can choose.
pub(super) struct ExactRows<'a> {
    pub model: &'a IntervalMdp,
    pub used: StateSet,
    rows: Vec<Option<ExactRow>>,
    /// The longest range of rows of a moving state.
    longest: usize,
}

impl<'a> ExactRows<'a> {
    /// # Errors
    /// [`MemoryError`] if they would not fit.
    pub(super) fn new(model: &'a IntervalMdp, moving: &StateSet) -> Result<Self, MemoryError> {
        let moving = || moving.ones().map(StateId::from_index);
        let all = model.rows();
        let used: Vec<RowId> = model.choices().used_rows(all.len(), moving());
        let entries: u64 = used.iter().map(|&row| all.row_len(row) as u64).sum();
        // Two numerators of 16 bytes per entry; much smaller bounds than 1e-13 need longer ones.
        let tiny = all.any(|row| row.lower.iter().chain(row.upper).any(|&x| 0.0 < x && x < 1e-13));
        require_memory("the exact model", entries * if tiny { 400 } else { 32 } + 256 * all.len() as u64)?;
        let mut rows = vec![None; all.len()];
        let exact: Vec<_> = (used.par_iter())
            .map_init(RowBuffer::default, |buffer, &row| ExactRow::new(all.row(row, buffer)))
            .collect();
        used.iter().zip(exact).for_each(|(&row, exact)| rows[row.index()] = exact);
        let longest =
            moving().flat_map(|s| model.choices().ranges(s)).map(|range| range.len()).max().unwrap_or(1);
        let mut set = StateSet::with_capacity(all.len());
        used.iter().for_each(|&row| set.insert(row.index()));
        Ok(Self { model, used: set, rows, longest })
    }

    /// The exact bounds of a row.
    pub(super) fn get(&self, row: RowId) -> Result<&ExactRow, Rejection> {
        self.rows[row.index()].as_ref().ok_or(Rejection::NoDistribution { row })
    }
}

/// The proof of one of the bounds, step by step.
pub(super) struct SideProof<'a> {
    pub side: Side,
    rows: &'a ExactRows<'a>,
    task: &'a Task,
    /// Whether the policy has to make the bound true: a maximising one the lower, a minimising one the upper.
    pub follows_policy: bool,
    /// The bounds that the step to be checked leads to.
    pub values: Bounds,
    /// The expectations of rows, rounded to the proof's side, and which of them are those of `values`.
    expectations: Vec<f64>,
    fresh: StateSet,
    /// How many expectations were computed.
    pub evaluated: u64,
}

impl<'a> SideProof<'a> {
    /// Starts with bounds that hold before the first step.
    pub(super) fn new(side: Side, rows: &'a ExactRows<'a>, task: &'a Task) -> Self {
        let count = rows.rows.len();
        Self {
            side,
            rows,
            task,
            follows_policy: task.policy_maximises == (side == Side::Lower),
            values: Bounds::new(side, task.indicator()),
            expectations: vec![0.0; count],
            fresh: StateSet::with_capacity(count),
            evaluated: 0,
        }
    }

    /// Checks that `next` follows from `values` in one step, and makes it the new `values`.
    ///
    /// `choices` is what the policy does in that step.
    pub(super) fn step(&mut self, next: Bounds, choices: &[u32], step: Option<u64>) -> Result<(), Rejection> {
        if self.follows_policy {
            let chosen = self.chosen_rows(&next, choices, step)?;
            let rows: StateSet = chosen.iter().map(|&(_, row)| row.index()).collect();
            self.evaluate(&rows)?;
            self.check_policy(&next, &chosen, step)?;
        } else {
            self.evaluate(&self.rows.used)?;
            self.check_all_choices(&next, step)?;
        }
        self.check_fractions(&next, choices, step)?;
        let Self { rows, fresh, values, .. } = self;
        let changed = |s: &StateId| !values.agrees(&next, s.index());
        let mut buffer = RowBuffer::default();
        let is_stale = |row: &usize| {
            rows.model.rows().row(RowId::from_index(*row), &mut buffer).successors.iter().any(changed)
        };
        let stale: Vec<usize> = fresh.ones().filter(is_stale).collect();
        stale.into_iter().for_each(|row| fresh.set(row, false));
        self.values = next;
        Ok(())
    }

    /// The moving states whose bound is not trivial, and the rows that the policy chooses there.
    fn chosen_rows(
        &self,
        next: &Bounds,
        choices: &[u32],
        step: Option<u64>,
    ) -> Result<Vec<(usize, RowId)>, Rejection> {
        let trivial = |s: usize| next.fraction(s).is_none() && next.double(s) == self.side.trivial();
        let open = self.task.moving.ones().filter(|&s| !trivial(s));
        let chosen = open.map(|s| {
            let row = self.rows.model.choices().row_of_choice(StateId::from_index(s), choices[s]);
            let missing = Rejection::NoChoice { step, state: StateId::from_index(s), side: self.side };
            row.map(|row| (s, row)).ok_or(missing)
        });
        chosen.collect()
    }

    fn check_policy(
        &self,
        next: &Bounds,
        chosen: &[(usize, RowId)],
        step: Option<u64>,
    ) -> Result<(), Rejection> {
        let fails =
            |(s, row): &&(usize, RowId)| !self.side.follows(next.double(*s), self.expectations[row.index()]);
        match chosen.iter().filter(|(s, _)| next.fraction(*s).is_none()).find(fails) {
            Some(&(s, row)) => Err(self.rejection(next, s, row, step)),
            None => Ok(()),
        }
    }

    fn check_all_choices(&self, next: &Bounds, step: Option<u64>) -> Result<(), Rejection> {
        let worst = Extremum::new(self.side, &self.expectations, self.rows.longest);
        let choices = self.rows.model.choices();
        let fails = |s: &usize| {
            let double = next.fraction(*s).is_none();
            double && !self.side.follows(next.double(*s), worst.of(choices.ranges(StateId::from_index(*s))))
        };
        let Some(s) = self.task.moving.ones().find(fails) else { return Ok(()) };
        let refutes = |row: &RowId| !self.side.follows(next.double(s), self.expectations[row.index()]);
        let row = choices.rows(StateId::from_index(s)).find(refutes).unwrap_or_default();
        Err(self.rejection(next, s, row, step))
    }

    fn rejection(&self, next: &Bounds, s: usize, row: RowId, step: Option<u64>) -> Rejection {
        let expectation = self.expectations[row.index()];
        Rejection::Bound {
            step,
            state: StateId::from_index(s),
            side: self.side,
            bound: next.double(s),
            row,
            expectation,
        }
    }

    /// Checks the bounds that are fractions, which no rounded expectation can be compared with.
    fn check_fractions(&self, next: &Bounds, choices: &[u32], step: Option<u64>) -> Result<(), Rejection> {
        if next.fractions().next().is_none() {
            return Ok(());
        }
        let exact = self.values.to_exact();
        for (s, bound) in next.fractions() {
            let of_state = self.rows.model.choices();
            let rows: Vec<RowId> = match self.follows_policy {
                true => of_state.row_of_choice(StateId::from_index(s), choices[s]).into_iter().collect(),
                false => of_state.rows(StateId::from_index(s)).collect(),
            };
            for row in rows {
                let buffer = &mut RowBuffer::default();
                let successors = self.rows.model.rows().row(row, buffer).successors;
                let expectation = self.rows.get(row)?.expectation(successors, &exact, self.task.nature);
                let follows = match self.side {
                    Side::Lower => *bound <= expectation,
                    Side::Upper => *bound >= expectation,
                };
                if !follows {
                    return Err(self.rejection(next, s, row, step));
                }
            }
        }
        Ok(())
    }

    /// Computes the expectations of rows that are needed and not known for the present values.
    fn evaluate(&mut self, needed: &StateSet) -> Result<(), Rejection> {
        let stale: Vec<RowId> = needed.difference(&self.fresh).map(RowId::from_index).collect();
        if stale.is_empty() {
            return Ok(());
        }
        let exact = self.values.to_exact();
        let expectation = |buffer: &mut RowBuffer, &row: &RowId| {
            let successors = self.rows.model.rows().row(row, buffer).successors;
            let value = self.rows.get(row)?.expectation(successors, &exact, self.task.nature);
            Ok(self.side.round(&value))
        };
        let results = stale.par_iter().map_init(RowBuffer::default, expectation);
        let results: Vec<f64> = results.collect::<Result<_, Rejection>>()?;
        for (&row, result) in stale.iter().zip(results) {
            self.expectations[row.index()] = result;
            self.fresh.insert(row.index());
        }
        self.evaluated += stale.len() as u64;
        Ok(())
    }
}
