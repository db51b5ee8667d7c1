//! The checker of expected rewards.

use super::check::{ProvedBounds, prove};
use super::earned::{LARGEST, Outlook, earned, exact, reading};
use super::one_step::{ExactRows, NO_CHOICE};
use super::task::nature_of;
use super::{Rejection, Side};
use crate::certificate::{Evidence, Inductive, RewardInductive, Step};
use crate::exact::Nature;
use crate::model::{IntervalMdp, RewardStructure, RowId, StateId, StateSet};
use crate::numeric::Rational;
use crate::property::{QueryKind, Resolution};
use num_traits::One;

/// Which rewards are meant.
#[derive(Clone, Debug)]
pub enum RewardTask<'a> {
    /// Those before a goal state is met; infinite where it may be missed.
    Reach(&'a StateSet),
    /// Those of so many steps, or of all steps if discounted by a factor below 1.
    Cumulative {
        /// The number of steps, if bounded.
        steps: Option<u64>,
        /// What the rewards of the next step are worth today.
        discount: Rational,
    },
    /// That of the state after so many steps.
    Instantaneous(u64),
}

/// Checks what is said to prove bounds on an expected reward.
///
/// # Errors
/// [`Rejection`] says what does not follow, in which step and state.
pub fn prove_rewards(
    model: &IntervalMdp,
    rewards: &RewardStructure,
    task: &RewardTask<'_>,
    resolution: Resolution,
    evidence: &Evidence,
) -> Result<ProvedBounds, Rejection> {
    let earned = rewards.states.iter().chain(&rewards.choices).chain(rewards.branches.values().flatten());
    if let Some(&found) = earned.into_iter().find(|&&reward| reward >= LARGEST) {
        return Err(Rejection::Reward { found, largest: LARGEST });
    }
    let mut moving = StateSet::with_capacity(model.num_states());
    let has_rows = |s: &usize| !model.choices().ranges(StateId::from_index(*s)).is_empty();
    (0..model.num_states()).filter(has_rows).for_each(|s| moving.insert(s));
    if let RewardTask::Reach(goal) = task {
        moving.difference_with(goal);
    }
    let rows = ExactRows::new(model, &moving)?;
    let nothing = RewardStructure::default();
    let (of_steps, discount) = match task {
        RewardTask::Cumulative { discount, .. } => (rewards, discount.clone()),
        RewardTask::Reach(_) => (rewards, Rational::one()),
        // Only the last state's reward counts: the steps themselves earn nothing.
        RewardTask::Instantaneous(_) => (&nothing, Rational::one()),
    };
    let mut proof = Proof {
        rows: &rows,
        rewards: of_steps,
        moving: &moving,
        // Without a goal, those that stay where they are go on earning.
        staying: !matches!(task, RewardTask::Reach(_)),
        first_choices: model.choices().first_choices(),
        discount,
        policy_maximises: resolution.policy_maximises(),
        nature: nature_of(resolution),
        choices: vec![NO_CHOICE; model.num_states()],
        evaluated: 0,
    };
    let rewards_of = |side| (0..model.num_states()).map(|s| reading(rewards.of_state(s), side)).collect();
    let zero = vec![0.0; model.num_states()];
    let (lower, upper, steps) = match (task, evidence) {
        (RewardTask::Cumulative { steps: Some(horizon), .. }, Evidence::RewardSteps(steps)) => {
            proof.steps(steps, *horizon, [zero.clone(), zero])?
        }
        (RewardTask::Instantaneous(horizon), Evidence::RewardSteps(steps)) => {
            proof.steps(steps, *horizon, [Side::Lower, Side::Upper].map(rewards_of))?
        }
        (RewardTask::Cumulative { steps: None, .. }, Evidence::RewardInductive(inductive)) => {
            if proof.discount >= Rational::one() || !inductive.missed.is_empty() {
                return Err(Rejection::Evidence { property: "undiscounted", evidence: "discounted" });
            }
            let unknown = vec![f64::INFINITY; zero.len()];
            proof.inductive(inductive, [zero, unknown], false)?
        }
        (RewardTask::Reach(goal), Evidence::RewardInductive(inductive)) => {
            let (mut lower, mut upper) = (zero.clone(), zero);
            let infinite = infinite(model, goal, resolution, inductive)?;
            infinite.ones().for_each(|s| lower[s] = f64::INFINITY);
            (0..upper.len()).filter(|&s| !goal.contains(s)).for_each(|s| upper[s] = f64::INFINITY);
            proof.inductive(inductive, [lower, upper], true)?
        }
        _ => return Err(Rejection::Evidence { property: "rewards", evidence: "something else" }),
    };
    Ok(ProvedBounds { lower, upper, steps, rows: proof.evaluated })
}

/// The states for which it is proved that the goal may be missed.
fn infinite(
    model: &IntervalMdp,
    goal: &StateSet,
    resolution: Resolution,
    inductive: &RewardInductive,
) -> Result<StateSet, Rejection> {
    let mut safe = StateSet::with_capacity(model.num_states());
    safe.insert_range(..);
    let event = QueryKind::Until { safe, goal: goal.clone(), steps: None };
    let (choices, upper) = (inductive.choices.clone(), inductive.missed.clone());
    // Choices are for rewards elsewhere, and those of goal states and of states without rows say nothing.
    let evidence = Evidence::Inductive(Inductive { choices, upper, ..Inductive::default() });
    let bounds = prove(model, event, resolution.flipped(), &evidence)?;
    let mut found = StateSet::with_capacity(model.num_states());
    (0..model.num_states()).filter(|&s| bounds.upper[s] < 1.0).for_each(|s| found.insert(s));
    Ok(found)
}

struct Proof<'a> {
    rows: &'a ExactRows<'a>,
    rewards: &'a RewardStructure,
    moving: &'a StateSet,
    /// Whether states without rows earn something.
    staying: bool,
    first_choices: Vec<u64>,
    discount: Rational,
    policy_maximises: bool,
    nature: Nature,
    choices: Vec<u32>,
    evaluated: u64,
}

/// Lower and upper bounds by state, and how many steps were checked.
type Bounds = (Vec<f64>, Vec<f64>, u64);

impl Proof<'_> {
    fn steps(&mut self, steps: &[Step], horizon: u64, start: [Vec<f64>; 2]) -> Result<Bounds, Rejection> {
        let found = steps.len() as u64;
        if found > horizon {
            return Err(Rejection::Steps { found, expected: horizon });
        }
        let [mut lower, mut upper] = start;
        for (k, step) in (1..).zip(steps) {
            let exact = step.exact_lower.first().or(step.exact_upper.first());
            if let Some(&(state, _)) = exact {
                let (what, expected) = ("exact bounds", "none where rewards are meant");
                return Err(Rejection::State { step: Some(k), state, what, expected });
            }
            self.take_choices(&step.choices, Some(k))?;
            let (mut next_lower, mut next_upper) = (lower.clone(), upper.clone());
            self.assign(&step.lower, "lower bounds", Some(k), &mut next_lower)?;
            self.assign(&step.upper, "upper bounds", Some(k), &mut next_upper)?;
            self.follow(Side::Lower, &lower, &next_lower, Some(k), false)?;
            self.follow(Side::Upper, &upper, &next_upper, Some(k), false)?;
            (lower, upper) = (next_lower, next_upper);
        }
        if found < horizon {
            // From here on nothing changes: every further step is this one.
            self.follow(Side::Lower, &lower, &lower, Some(found + 1), false)?;
            self.follow(Side::Upper, &upper, &upper, Some(found + 1), false)?;
        }
        Ok((lower, upper, horizon.min(found + 1)))
    }

    fn inductive(
        &mut self,
        inductive: &RewardInductive,
        [mut lower, mut upper]: [Vec<f64>; 2],
        strict: bool,
    ) -> Result<Bounds, Rejection> {
        self.take_choices(&inductive.choices, None)?;
        self.assign(&inductive.lower, "lower bounds", None, &mut lower)?;
        self.assign(&inductive.upper, "upper bounds", None, &mut upper)?;
        self.follow(Side::Lower, &lower, &lower, None, false)?;
        self.follow(Side::Upper, &upper, &upper, None, strict)?;
        Ok((lower, upper, 1))
    }

    fn take_choices(&mut self, list: &[(StateId, u32)], step: Option<u64>) -> Result<(), Rejection> {
        self.check_order(list, "choices", step)?;
        list.iter().for_each(|&(state, choice)| self.choices[state.index()] = choice);
        Ok(())
    }

    fn assign(
        &self,
        list: &[(StateId, f64)],
        what: &'static str,
        step: Option<u64>,
        values: &mut [f64],
    ) -> Result<(), Rejection> {
        self.check_order(list, what, step)?;
        if let Some(&(_, found)) = list.iter().find(|(_, value)| !(0.0..LARGEST).contains(value)) {
            return Err(Rejection::Reward { found, largest: LARGEST });
        }
        list.iter().for_each(|&(state, value)| values[state.index()] = value);
        Ok(())
    }

    /// Only states whose value can change may be listed, in order.
    fn check_order<T>(
        &self,
        list: &[(StateId, T)],
        what: &'static str,
        step: Option<u64>,
    ) -> Result<(), Rejection> {
        let mut previous = None;
        for &(state, _) in list {
            let rejected = |expected| Err(Rejection::State { step, state, what, expected });
            if previous.replace(state).is_some_and(|previous| previous >= state) {
                return rejected("states in ascending order");
            }
            let exists = state.index() < self.choices.len();
            if !exists || !(self.staying || self.moving.contains(state.index())) {
                return rejected("states that have something to choose");
            }
        }
        Ok(())
    }

    /// Checks that bounds follow from those one step later.
    fn follow(
        &mut self,
        side: Side,
        values: &[f64],
        next: &[f64],
        step: Option<u64>,
        strict: bool,
    ) -> Result<(), Rejection> {
        let mut outlook = Outlook::new(self.rows, self.rewards, (self.nature, side), &self.discount, values);
        let trivial = |value: f64| match side {
            // Infinite lower bounds are proved otherwise.
            Side::Lower => value == 0.0 || value == f64::INFINITY,
            Side::Upper => value == f64::INFINITY,
        };
        let follows_policy = self.policy_maximises == (side == Side::Lower);
        let all = 0..values.len();
        for s in all.filter(|&s| !trivial(next[s])) {
            let state = StateId::from_index(s);
            if !self.moving.contains(s) {
                if self.staying {
                    self.stay(side, s, (values[s], next[s]), step)?;
                }
                continue;
            }
            let of_state = self.rows.model.choices();
            let bound = exact(next[s]);
            let chosen: Vec<(u32, RowId)> = match follows_policy {
                true => {
                    let choice = self.choices[s];
                    of_state.row_of_choice(state, choice).map(|row| (choice, row)).into_iter().collect()
                }
                false => (0..).zip(of_state.rows(state)).collect(),
            };
            if chosen.is_empty() {
                return Err(Rejection::NoChoice { step, state, side });
            }
            for (number, row) in chosen {
                let choice = self.first_choices[s] + u64::from(number);
                let value = outlook
                    .of_choice(choice, row)?
                    .map(|later| earned(self.rewards, s, Some(choice), side) + later);
                let follows = match (side, &value) {
                    (Side::Lower, None) => true,
                    (Side::Upper, None) => false,
                    (Side::Lower, Some(value)) => bound <= *value,
                    (Side::Upper, Some(value)) if strict => bound > *value,
                    (Side::Upper, Some(value)) => bound >= *value,
                };
                if !follows {
                    let expectation = value.map_or(f64::INFINITY, |value| side.round(&value));
                    return Err(Rejection::Bound { step, state, side, bound: next[s], row, expectation });
                }
            }
        }
        self.evaluated += outlook.evaluated;
        Ok(())
    }

    /// Checks the bound of a state that stays where it is.
    fn stay(
        &self,
        side: Side,
        s: usize,
        (later, bound): (f64, f64),
        step: Option<u64>,
    ) -> Result<(), Rejection> {
        let state = StateId::from_index(s);
        // Without a choice, only the state earns something.
        let choice = self.rows.model.choices().is_absorbing(state).then(|| self.first_choices[s]);
        let finite = later.is_finite();
        let value = earned(self.rewards, s, choice, side) + exact(later) * &self.discount;
        let follows = match side {
            Side::Lower => exact(bound) <= value,
            Side::Upper => finite && exact(bound) >= value,
        };
        match follows {
            true => Ok(()),
            false => Err(Rejection::Earned { step, state, side, bound, value: side.round(&value) }),
        }
    }
}
