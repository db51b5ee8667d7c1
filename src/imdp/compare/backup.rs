//! One step of robust value iteration in plain floating point: to weigh actions, not to prove anything.

use crate::model::{IntervalMdp, RowBuffer, RowId, StateId};
use crate::property::{Query, QueryKind};

/// A query whose actions are to be weighed.
pub(crate) struct Backup<'a> {
    model: &'a IntervalMdp,
    query: &'a Query,
}

impl<'a> Backup<'a> {
    pub(crate) fn new(model: &'a IntervalMdp, query: &'a Query) -> Self {
        Self { model, query }
    }

    /// The values with no step left: 1 in goal states.
    pub(crate) fn initial(&self) -> Vec<f64> {
        let (QueryKind::Until { goal, .. } | QueryKind::Next { goal }) = &self.query.kind;
        (0..self.model.num_states()).map(|state| f64::from(u8::from(goal.contains(state)))).collect()
    }

    /// `opt_p p·V` over the distributions `p` of a row.
    pub(crate) fn row_value(&self, row: RowId, values: &[f64]) -> f64 {
        let buffer = &mut RowBuffer::default();
        let row = self.model.rows().row(row, buffer);
        let value = |at: &usize| values[row.successors[*at].index()];
        let mut order: Vec<usize> = (0..row.len()).collect();
        order.sort_by(|a, b| value(a).total_cmp(&value(b)));
        if self.query.resolution.nature_maximises() {
            order.reverse();
        }
        let mut slack = (1.0 - row.lower.iter().sum::<f64>()).max(0.0);
        let pour = |at: usize| {
            let poured = (row.upper[at] - row.lower[at]).min(slack);
            slack -= poured;
            (row.lower[at] + poured) * value(&at)
        };
        order.into_iter().map(pour).sum()
    }

    /// The values with one more step left.
    pub(crate) fn step(&self, values: &[f64]) -> Vec<f64> {
        let best: fn(f64, f64) -> f64 =
            if self.query.resolution.policy_maximises() { f64::max } else { f64::min };
        self.step_by(values, |state, row_value| self.model.choices().rows(state).map(row_value).reduce(best))
    }

    /// The values with one more step left if `decide` says what a state is worth, given what its rows are worth.
    ///
    /// A state about which it says nothing keeps its value.
    pub(crate) fn step_by(
        &self,
        values: &[f64],
        decide: impl Fn(StateId, &dyn Fn(RowId) -> f64) -> Option<f64>,
    ) -> Vec<f64> {
        let weights: Vec<f64> =
            RowId::first(self.model.rows().len()).map(|row| self.row_value(row, values)).collect();
        let next = (0..self.model.num_states()).map(|state| {
            if let QueryKind::Until { safe, goal, .. } = &self.query.kind {
                if goal.contains(state) {
                    return 1.0;
                } else if !safe.contains(state) {
                    return 0.0;
                }
            }
            decide(StateId::from_index(state), &|row| weights[row.index()]).unwrap_or(values[state])
        });
        next.collect()
    }

    /// Whether it matters what is done in a state.
    pub(crate) fn matters(&self, state: StateId) -> bool {
        match &self.query.kind {
            QueryKind::Until { safe, goal, .. } => {
                safe.contains(state.index()) && !goal.contains(state.index())
            }
            QueryKind::Next { .. } => true,
        }
    }

    /// The number of steps, if bounded.
    pub(crate) fn horizon(&self) -> Option<u64> {
        match self.query.kind {
            QueryKind::Until { steps, .. } => steps,
            QueryKind::Next { .. } => Some(1),
        }
    }
}
