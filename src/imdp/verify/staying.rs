//! Where a run can stay for ever such that it meets some sets infinitely often.

use super::Rejection;
use super::masses::{Masses, Which};
use super::one_step::ExactRows;
use crate::exact::Nature;
use crate::model::{IntervalMdp, RowId, StateId, StateSet};

/// A condition on a run: what it must meet finitely and what infinitely often.
#[derive(Clone, Copy, Debug)]
pub struct OmegaCondition<'a> {
    /// States that must be met finitely often.
    pub finitely: &'a StateSet,
    /// Sets of states each of which must be met infinitely often.
    pub infinitely: &'a [StateSet],
}

/// Checks that the states of `lower` satisfy one of the conditions with probability 1 if the policy wants it, whatever a
/// minimising nature does; those that are `satisfied` do so anyway.
///
/// Let `X` be the largest set outside of `finitely` in which every state has a choice that stays in `X`, and from which each set
/// can be reached by such choices: from every state, some of them leads with positive probability to a state from which fewer
/// are needed. (Choices that stay: every distribution stays if nature minimises, some if it maximises; likewise for positive
/// probability.) There are finitely many states, so in a number of steps a set is met with at least some probability, and
/// again and again: infinitely often, with probability 1.
///
/// # Errors
/// [`Rejection::Accepting`] names a state that is not in any `X`.
pub fn prove_accepting(
    model: &IntervalMdp,
    conditions: &[OmegaCondition<'_>],
    (lower, satisfied): (&StateSet, &StateSet),
    nature_maximises: bool,
) -> Result<(), Rejection> {
    let rows = ExactRows::new(model, &everything(model))?;
    let nature = if nature_maximises { Nature::Max } else { Nature::Min };
    let mut proved = satisfied.clone();
    for condition in conditions {
        proved.union_with(&staying(&rows, everything(model), condition, nature)?);
    }
    match lower.difference(&proved).next() {
        None => Ok(()),
        Some(state) => Err(Rejection::Accepting { state: StateId::from_index(state) }),
    }
}

/// Checks that runs which satisfy a condition meet `upper` with probability 1, or are those that never satisfy one.
///
/// Whatever policy and nature do, the states that a run meets infinitely often are, with probability 1, an end component of the
/// model in which nature helps: each has a choice with a distribution that stays, and all can be reached from each other. If
/// it satisfies a condition and does not meet `upper`, all of it is in the `X` of [`prove_accepting`] for a maximising nature,
/// within the states outside of `upper`. So that must be empty, for every condition.
///
/// # Errors
/// [`Rejection::Missed`] names a state of such an `X`.
pub fn prove_nothing_missed(
    model: &IntervalMdp,
    conditions: &[OmegaCondition<'_>],
    (upper, satisfied): (&StateSet, &StateSet),
) -> Result<(), Rejection> {
    let missed = |state| Err(Rejection::Missed { state: StateId::from_index(state) });
    if let Some(state) = satisfied.difference(upper).next() {
        return missed(state);
    }
    let rows = ExactRows::new(model, &everything(model))?;
    for condition in conditions {
        let mut outside = everything(model);
        outside.difference_with(upper);
        if let Some(state) = staying(&rows, outside, condition, Nature::Max)?.ones().next() {
            return missed(state);
        }
    }
    Ok(())
}

fn everything(model: &IntervalMdp) -> StateSet {
    let mut all = StateSet::with_capacity(model.num_states());
    all.insert_range(..);
    all
}

/// The set `X` of [`prove_accepting`], within a set.
fn staying(
    rows: &ExactRows<'_>,
    mut set: StateSet,
    condition: &OmegaCondition<'_>,
    nature: Nature,
) -> Result<StateSet, Rejection> {
    set.difference_with(condition.finitely);
    loop {
        let before = set.count_ones(..);
        let mut choices = Choices::new(rows, &set, nature)?;
        set.intersect_with(&choices.states);
        for infinitely in condition.infinitely {
            let reached = choices.leading_to(infinitely)?;
            set.intersect_with(&reached);
        }
        if set.count_ones(..) == before {
            return Ok(set);
        }
    }
}

/// The choices that stay in a set.
struct Choices<'a> {
    masses: Masses<'a>,
    nature: Nature,
    set: StateSet,
    /// The states that have some; those without rows stay where they are.
    states: StateSet,
    rows: Vec<(usize, Vec<RowId>)>,
}

impl<'a> Choices<'a> {
    fn new(rows: &'a ExactRows<'a>, set: &StateSet, nature: Nature) -> Result<Self, Rejection> {
        let masses = Masses::new(rows);
        let mut states = StateSet::with_capacity(set.len());
        let mut own = vec![];
        for s in set.ones() {
            let of_state = rows.model.choices();
            let mut stay = vec![];
            for row in of_state.rows(StateId::from_index(s)) {
                let outside = |state: StateId| !set.contains(state.index());
                let leaves = match nature {
                    Nature::Min => masses.meets(row, outside, Which::Some)?,
                    Nature::Max => masses.meets(row, outside, Which::Every)?,
                };
                if !leaves {
                    stay.push(row);
                }
            }
            if !stay.is_empty() || of_state.ranges(StateId::from_index(s)).is_empty() {
                states.insert(s);
            }
            own.push((s, stay));
        }
        Ok(Self { masses, nature, set: set.clone(), states, rows: own })
    }

    /// The states from which these choices lead to a set with positive probability, those in it included.
    fn leading_to(&mut self, goal: &StateSet) -> Result<StateSet, Rejection> {
        let mut found = self.states.clone();
        found.intersect_with(goal);
        loop {
            let mut more = vec![];
            for (s, rows) in self.rows.iter().filter(|(s, _)| !found.contains(*s)) {
                for &row in rows {
                    let inside = |state: StateId| found.contains(state.index());
                    let leads = match self.nature {
                        Nature::Min => self.masses.meets(row, inside, Which::Every)?,
                        Nature::Max => {
                            let kept = |state: StateId| self.set.contains(state.index());
                            self.masses.meets_within(row, inside, kept)?
                        }
                    };
                    if leads {
                        more.push(*s);
                        break;
                    }
                }
            }
            if more.is_empty() {
                return Ok(found);
            }
            more.into_iter().for_each(|s| found.insert(s));
        }
    }
}
