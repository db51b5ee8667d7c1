//! Until with a lower bound on the steps: the goal counts only from some step on.
//!
//! `left U[a,b] right` is `left` for `a` steps, and then `left U<=b-a right`. For the first `a` steps, a state in which
//! `left` holds has the value of its best choice, and any other state has 0.

use super::expectation::Bound;
use super::options::Control;
use super::query::Players;
use super::range_optimum::RangeOptimum;
use super::sweep::Sweep;
use super::{Event, Solution, SolveError, SolverOptions, Status, ValueBounds, solve};
use crate::model::{IntervalMdp, StateId, StateSet};
use crate::property::Resolution;

/// Bounds on the value of `safe U[first, last] goal` in every state; without a last step it may take for ever.
///
/// # Errors
/// Those of [`solve`].
pub fn solve_delayed(
    model: &IntervalMdp,
    (safe, goal): (&StateSet, &StateSet),
    (first, last): (u64, Option<u64>),
    resolution: Resolution,
    options: &SolverOptions<'_>,
) -> Result<Solution, SolveError> {
    let steps = last.map(|last| last.saturating_sub(first));
    let plain = SolverOptions { policy: false, evidence: false, ..*options };
    let mut solution = solve(model, &Event::Until { safe, goal, steps }, resolution, &plain)?;
    let players = Players::from(resolution);
    let moves = |&s: &StateId| safe.contains(s.index()) && !model.choices().ranges(s).is_empty();
    let states: Vec<StateId> = StateId::first(model.num_states()).filter(moves).collect();
    let mut table = RangeOptimum::new(players.policy, model.rows().len());
    table.prepare(model.choices(), &states);
    let rows = model.choices().used_rows(model.rows().len(), states.iter().copied());
    let mut sweep = Sweep::new(model, players, states, &rows);
    let mut control = Control::of(options, Some(first));
    let ValueBounds { lower, upper } = &mut solution.values;
    let mut results = vec![];
    for waited in 0..first {
        if let Some(reason) = control.stop() {
            solution.status = reason;
            let open = sweep.states.iter().map(|&s| s.index());
            open.for_each(|state| (lower[state], upper[state]) = (0.0, 1.0));
            return Ok(solution);
        }
        for (values, side) in [(&mut *lower, Bound::Lower), (&mut *upper, Bound::Upper)] {
            sweep.evaluate_rows(values, side, &mut table);
            sweep.evaluate_states(&table, &mut results);
            sweep.states.iter().zip(&results).for_each(|(&s, &value)| values[s.index()] = value);
            // Where `safe` does not hold nothing can come of waiting.
            if waited == 0 {
                (0..values.len())
                    .filter(|&state| !safe.contains(state))
                    .for_each(|state| values[state] = 0.0);
            }
        }
        control.done(0.0);
        solution.iterations += 1;
    }
    if last.is_some() {
        solution.status = Status::HorizonReached;
    }
    Ok(solution)
}
