//! Whether distributions of a row give a set of states positive probability, exactly.

use super::Rejection;
use super::one_step::ExactRows;
use crate::exact::{ExactValues, Replaced};
use crate::model::ExactRow;
use crate::model::{Row, RowBuffer, RowId, StateId};

/// Which distributions of a row are meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Which {
    Some,
    Every,
}

/// Questions about rows.
pub(super) struct Masses<'a> {
    rows: &'a ExactRows<'a>,
}

impl<'a> Masses<'a> {
    pub(super) fn new(rows: &'a ExactRows<'a>) -> Self {
        Self { rows }
    }

    /// Whether some or every distribution of a row gives a set positive probability.
    pub(super) fn meets(
        &self,
        row: RowId,
        set: impl Fn(StateId) -> bool,
        which: Which,
    ) -> Result<bool, Rejection> {
        let buffer = &mut RowBuffer::default();
        let successors = self.rows.model.rows().row(row, buffer).successors;
        let members: Vec<bool> = successors.iter().map(|&state| set(state)).collect();
        Ok(meets(self.rows.get(row)?, &members, which))
    }

    /// Whether some distribution of a row gives a set positive probability, and nothing to states that are not `kept`.
    pub(super) fn meets_within(
        &self,
        row: RowId,
        set: impl Fn(StateId) -> bool,
        kept: impl Fn(StateId) -> bool,
    ) -> Result<bool, Rejection> {
        let buffer = &mut RowBuffer::default();
        let whole = self.rows.model.rows().row(row, buffer);
        let members: Vec<bool> = whole.successors.iter().map(|&state| set(state)).collect();
        let left_out: Vec<bool> = whole.successors.iter().map(|&state| !kept(state)).collect();
        if !left_out.contains(&true) {
            return Ok(meets(self.rows.get(row)?, &members, Which::Some));
        }
        let part = without(whole, &left_out);
        Ok(part.is_some_and(|part| meets(&part, &members, Which::Some)))
    }
}

/// Whether some or every distribution of a row gives these of its successors positive probability.
pub(super) fn meets(row: &ExactRow, members: &[bool], which: Which) -> bool {
    if !members.contains(&true) {
        return false;
    }
    let positions: Vec<StateId> = StateId::first(members.len()).collect();
    match which {
        // The least rank that is met for certain is that of the members, 0.
        Which::Every => row.certain_rank(&positions, |at| u32::from(!members[at.index()])) < 2,
        Which::Some => {
            let ones: Vec<f64> = members.iter().map(|&is| if is { 1.0 } else { 0.0 }).collect();
            let support = row.maximal_support(&positions, &ExactValues::with(&ones, &Replaced::new()));
            support.iter().zip(members).any(|(met, is_member)| *met && *is_member)
        }
    }
}

/// The row, some of whose successors get nothing; none if that cannot be.
pub(super) fn without(row: Row<'_>, left_out: &[bool]) -> Option<ExactRow> {
    let keep = |bounds: &[f64]| -> Vec<f64> {
        bounds.iter().zip(left_out).map(|(&bound, &out)| if out { 0.0 } else { bound }).collect()
    };
    let must_get = |position: usize| row.lower[position] > 0.0;
    if (0..row.len()).any(|position| left_out[position] && must_get(position)) {
        return None;
    }
    let exact: Vec<_> =
        row.exact.iter().filter(|bound| !left_out[bound.position as usize]).cloned().collect();
    let (lower, upper) = (keep(row.lower), keep(row.upper));
    ExactRow::new(Row { successors: row.successors, lower: &lower, upper: &upper, exact: &exact })
}
