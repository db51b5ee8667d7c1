//! Whether the states with a positive lower bound are left almost surely.

use super::Rejection;
use super::bounds::Bounds;
use super::one_step::ExactRows;
use super::task::Task;
use crate::exact::Nature;
use crate::model::{RowBuffer, RowId, StateId, StateSet};
use rayon::prelude::*;

/// Checks that ranks decrease with positive probability; states whose lower bound is 0 or final have rank 0.
///
/// In every state of `{L > 0}`, for the policy's choice if it maximises and for all choices otherwise: a
/// minimising nature gives lower ranks positive probability whatever it does, a maximising one by some
/// distribution that attains the expectation of `L`.
pub(super) fn check_ranks(
    rows: &ExactRows<'_>,
    task: &Task,
    lower: &Bounds,
    choices: &[u32],
    ranks: &[u32],
) -> Result<(), Rejection> {
    let open = |s: usize| task.moving.contains(s) && lower.is_positive(s);
    let rank = |s: StateId| if open(s.index()) { ranks[s.index()] } else { 0 };
    let of_choices = rows.model.choices();
    let states = || task.moving.ones().filter(|&s| open(s)).map(StateId::from_index);
    let values = lower.to_compare();
    let chosen = |s: StateId| of_choices.row_of_choice(s, choices[s.index()]);
    let used: Vec<RowId> = if task.policy_maximises {
        let mut set = StateSet::with_capacity(rows.model.rows().len());
        states().filter_map(chosen).for_each(|row| set.insert(row.index()));
        set.ones().map(RowId::from_index).collect()
    } else {
        of_choices.used_rows(rows.model.rows().len(), states())
    };
    let needed_by = |buffer: &mut RowBuffer, &row: &RowId| {
        let successors = rows.model.rows().row(row, buffer).successors;
        let exact = rows.get(row)?;
        Ok(match task.nature {
            Nature::Min => exact.certain_rank(successors, rank),
            Nature::Max => {
                let support = exact.maximal_support(successors, &values);
                let met = successors.iter().zip(support).filter(|(_, possible)| *possible);
                met.map(|(&s, _)| u64::from(rank(s)) + 1).min().unwrap_or(u64::MAX)
            }
        })
    };
    let found: Vec<u64> = {
        let found = used.par_iter().map_init(RowBuffer::default, needed_by);
        found.collect::<Result<_, Rejection>>()?
    };
    let mut needed = vec![u64::MAX; rows.model.rows().len()];
    used.iter().zip(found).for_each(|(&row, least)| needed[row.index()] = least);
    for state in states() {
        let rank = rank(state);
        let refutes = |row: &RowId| u64::from(rank) < needed[row.index()];
        let refuted = if task.policy_maximises {
            chosen(state).filter(refutes)
        } else {
            of_choices.rows(state).find(refutes)
        };
        if let Some(row) = refuted {
            return Err(Rejection::Rank { state, rank, row, needed: needed[row.index()] });
        }
    }
    Ok(())
}
