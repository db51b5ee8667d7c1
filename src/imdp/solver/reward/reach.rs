//! Expected rewards until a goal.

use super::super::evidence::unlike;
use super::super::expectation::Bound;
use super::super::graph::{stays, zero_one};
use super::super::options::Control;
use super::super::policy::NO_CHOICE;
use super::super::query::{Direction, Event, Players};
use super::super::{Policy, Solution, SolveError, SolverOptions, Status, ValueBounds, solve_for};
use super::operator::Operator;
use crate::certificate::{Evidence, RewardInductive};
use crate::model::{IntervalMdp, RewardStructure, RowId, StateId, StateSet};

/// Sweeps in which a lower bound that was derived from the upper one is lowered until it holds.
const REPAIRS: usize = 256;

/// The value in every state.
pub(super) fn reach(
    model: &IntervalMdp,
    rewards: &RewardStructure,
    goal: &StateSet,
    players: Players,
    options: &SolverOptions<'_>,
) -> Result<Solution, SolveError> {
    let states = model.num_states();
    let has_rows = |s: &usize| !model.choices().ranges(StateId::from_index(*s)).is_empty();
    let mut moving = StateSet::with_capacity(states);
    (0..states).filter(|&s| !goal.contains(s)).filter(has_rows).for_each(|s| moving.insert(s));
    // Who wants little reward wants the goal to be met.
    let willing = Players { policy: players.policy.flipped(), nature: players.nature.flipped() };
    let finite = zero_one(model, goal, &moving, willing).certain;
    let inside = |s: StateId| finite.contains(s.index());
    let usable: Vec<bool> = RowId::first(model.rows().len())
        .map(|row| players.policy == Direction::Max || stays(model.rows().row(row), willing.nature, inside))
        .collect();
    let usable = |row: RowId| usable[row.index()];
    let open: Vec<StateId> = finite.ones().filter(|&s| moving.contains(s)).map(StateId::from_index).collect();
    let operator = |rewards| Operator::new(model, rewards, players, open.clone(), (&usable, &inside));
    let mut iteration = Iteration {
        steps: operator(None),
        operator: operator(Some(rewards)),
        lower: vec![0.0; states],
        upper: vec![0.0; states],
        choices: vec![NO_CHOICE; states],
        maximises: players.policy == Direction::Max,
        counted: None,
        control: Control::new(options),
    };
    let status = iteration.run(options.epsilon);
    let proved = options.evidence && iteration.widen(options.epsilon);
    let Iteration { mut lower, mut upper, mut choices, control, .. } = iteration;
    for state in (0..states).filter(|&s| !finite.contains(s)) {
        (lower[state], upper[state]) = (f64::INFINITY, f64::INFINITY);
    }
    let mut evidence = None;
    if proved && let Some(missed) = missed(model, goal, willing, (&finite, &moving), &mut choices, options)? {
        let open = || open.iter().map(|s| s.index());
        let chosen = moving.ones().filter(|&s| choices[s] != NO_CHOICE);
        evidence = Some(Evidence::RewardInductive(RewardInductive {
            choices: chosen.map(|s| (StateId::from_index(s), choices[s])).collect(),
            lower: unlike(&lower, open(), 0.0),
            upper: unlike(&upper, open(), f64::INFINITY),
            missed,
        }));
    }
    Ok(Solution {
        values: ValueBounds { lower, upper },
        status,
        iterations: control.iterations,
        policy: options.policy.then(|| Policy::stationary(&choices)),
        evidence,
        history: vec![],
    })
}

/// Upper bounds below 1 on the probability that the goal is met, for the states whose rewards are infinite, and what a policy
/// does there that wants to miss it; none if the bounds do not tell for all of them.
fn missed(
    model: &IntervalMdp,
    goal: &StateSet,
    willing: Players,
    (finite, moving): (&StateSet, &StateSet),
    choices: &mut [u32],
    options: &SolverOptions<'_>,
) -> Result<Option<Vec<(StateId, f64)>>, SolveError> {
    let infinite: Vec<usize> = moving.difference(finite).collect();
    if infinite.is_empty() {
        return Ok(Some(vec![]));
    }
    let mut safe = StateSet::with_capacity(model.num_states());
    safe.insert_range(..);
    let event = Event::Until { safe: &safe, goal, steps: None };
    let options = SolverOptions { evidence: true, ..*options };
    let solution = solve_for(model, &event, willing, &options)?;
    let Some(Evidence::Inductive(inductive)) = solution.evidence else { return Ok(None) };
    let below = inductive.upper.iter().filter(|(s, _)| infinite.binary_search(&s.index()).is_ok()).count();
    if below < infinite.len() {
        return Ok(None);
    }
    // Where the rewards are finite, the choices are those for them.
    for &(state, choice) in &inductive.choices {
        if !finite.contains(state.index()) {
            choices[state.index()] = choice;
        }
    }
    Ok(Some(inductive.upper.into_iter().filter(|(s, _)| !finite.contains(s.index())).collect()))
}

struct Iteration<'a> {
    /// The operator that counts steps.
    steps: Operator,
    operator: Operator,
    lower: Vec<f64>,
    upper: Vec<f64>,
    choices: Vec<u32>,
    maximises: bool,
    /// At least the expected number of steps, once that is known.
    counted: Option<Vec<f64>>,
    control: Control<'a>,
}

impl Iteration<'_> {
    fn run(&mut self, epsilon: f64) -> Status {
        let states = self.operator.states.clone();
        if states.is_empty() {
            return Status::Converged;
        }
        let steps = match self.expected_steps() {
            Ok(steps) => {
                self.counted = Some(steps.clone());
                steps
            }
            Err(reason) => {
                states.iter().for_each(|&s| self.upper[s.index()] = f64::INFINITY);
                return reason;
            }
        };
        let longest = states.iter().map(|&s| steps[s.index()]).fold(1.0, f64::max);
        let largest = self.operator.largest_cost();
        for &s in &states {
            self.upper[s.index()] = (largest * steps[s.index()]).next_up();
        }
        let mut next_jump = 4;
        for sweep in 1u64.. {
            if let Some(reason) = self.control.stop() {
                return reason;
            }
            let changed = self.sweep();
            let gap = self.gap();
            self.control.done(gap);
            if gap <= epsilon {
                return Status::Converged;
            }
            if sweep >= next_jump || !changed {
                next_jump = sweep + 1 + sweep / 4;
                let jumped = self.jump(&steps, epsilon / (4.0 * longest));
                if self.gap() <= epsilon {
                    return Status::Converged;
                }
                if !changed && !jumped {
                    return Status::PrecisionLimit;
                }
            }
        }
        Status::PrecisionLimit
    }

    /// `w ≥ 1 + opt p·w`: at least the number of steps that the players take who want few or many, as with rewards.
    ///
    /// While `w` grows by at most 0.45 in a sweep, `2w` is such: `1 + 2 p·w ≤ 2(w + 0.45) − 1 ≤ 2w`.
    fn expected_steps(&mut self) -> Result<Vec<f64>, Status> {
        let mut steps = vec![0.0; self.lower.len()];
        loop {
            if let Some(reason) = self.control.stop() {
                return Err(reason);
            }
            let (results, chosen) = self.steps.apply(&steps, 1.0, Bound::Upper);
            let mut growth: f64 = 0.0;
            for ((&s, value), choice) in self.steps.states.iter().zip(results).zip(chosen) {
                growth = growth.max(value - steps[s.index()]);
                steps[s.index()] = steps[s.index()].max(value);
                // Choices that are made for few steps lead to the goal.
                self.choices[s.index()] = choice;
            }
            self.control.done(f64::INFINITY);
            if growth <= 0.45 {
                steps.iter_mut().for_each(|value| *value *= 2.0);
                return Ok(steps);
            }
        }
    }

    /// One step from below and one from above; returns whether anything changed.
    fn sweep(&mut self) -> bool {
        let mut changed = false;
        let (results, chosen) = self.operator.apply(&self.lower, 1.0, Bound::Lower);
        for (i, &s) in self.operator.states.iter().enumerate() {
            let value = &mut self.lower[s.index()];
            if results[i] > *value {
                changed = true;
                *value = results[i];
                if self.maximises {
                    self.choices[s.index()] = chosen[i];
                }
            }
        }
        let (results, chosen) = self.operator.apply(&self.upper, 1.0, Bound::Upper);
        for (i, &s) in self.operator.states.iter().enumerate() {
            let value = &mut self.upper[s.index()];
            if results[i] < *value {
                changed = true;
                *value = results[i].max(self.lower[s.index()]);
                if !self.maximises {
                    self.choices[s.index()] = chosen[i];
                }
            }
        }
        changed
    }

    /// How far apart the bounds are, relative to what is above 1.
    fn gap(&self) -> f64 {
        let gap = |&s: &StateId| {
            let (lower, upper) = (self.lower[s.index()], self.upper[s.index()]);
            (upper - lower) / lower.max(1.0)
        };
        self.operator.states.iter().map(gap).fold(0.0, f64::max)
    }

    /// Makes the upper bounds such that a step lowers all of them, as a proof of them needs; returns whether it could.
    fn widen(&mut self, epsilon: f64) -> bool {
        let states = self.operator.states.clone();
        if states.iter().any(|&s| self.upper[s.index()] == f64::INFINITY) {
            return false;
        }
        let Some(steps) = self.counted.clone() else { return states.is_empty() };
        let scale = states.iter().map(|&s| self.upper[s.index()]).fold(1.0, f64::max);
        let longest = states.iter().map(|&s| steps[s.index()]).fold(1.0, f64::max);
        let largest = (self.operator.largest_cost() * 1.5).max(f64::MIN_POSITIVE);
        let mut margin = (epsilon.min(1e-9) * scale / longest).max(1e-15 * scale);
        let mut candidate = self.upper.clone();
        loop {
            let is_last = margin > largest;
            for &s in &states {
                let s = s.index();
                let raised = (self.upper[s] + margin * steps[s]).next_up();
                candidate[s] = if is_last { (largest * steps[s]).next_up() } else { raised };
            }
            let (results, chosen) = self.operator.apply(&candidate, 1.0, Bound::Upper);
            if states.iter().zip(&results).all(|(&s, value)| *value < candidate[s.index()]) {
                for (i, &s) in states.iter().enumerate() {
                    self.upper[s.index()] = candidate[s.index()];
                    if !self.maximises {
                        self.choices[s.index()] = chosen[i];
                    }
                }
                return true;
            }
            if is_last {
                return false;
            }
            margin *= 4.0;
        }
    }

    /// Tries bounds that are close to those on the other side; returns whether one of them holds.
    fn jump(&mut self, steps: &[f64], margin: f64) -> bool {
        let states = self.operator.states.clone();
        let scale = states.iter().map(|&s| self.lower[s.index()]).fold(1.0, f64::max);
        let margin = margin * scale;
        let mut candidate = self.upper.clone();
        for &s in &states {
            let s = s.index();
            candidate[s] = (self.lower[s] + margin * steps[s]).next_up();
        }
        let (results, chosen) = self.operator.apply(&candidate, 1.0, Bound::Upper);
        let mut jumped = false;
        if states.iter().zip(&results).all(|(&s, value)| *value < candidate[s.index()]) {
            for (i, &s) in states.iter().enumerate() {
                if results[i] < self.upper[s.index()] {
                    jumped = true;
                    self.upper[s.index()] = results[i].max(self.lower[s.index()]);
                    if !self.maximises {
                        self.choices[s.index()] = chosen[i];
                    }
                }
            }
        }
        let mut candidate = self.lower.clone();
        for &s in &states {
            let s = s.index();
            candidate[s] = (self.upper[s] - margin * steps[s]).max(self.lower[s]);
        }
        for _ in 0..REPAIRS {
            let (results, chosen) = self.operator.apply(&candidate, 1.0, Bound::Lower);
            let mut holds = true;
            for (&s, &value) in states.iter().zip(&results) {
                let s = s.index();
                if value < candidate[s] {
                    holds = false;
                    candidate[s] = value;
                }
            }
            if !holds {
                continue;
            }
            for (i, &s) in states.iter().enumerate() {
                let value = candidate[s.index()];
                if value > self.lower[s.index()] {
                    jumped = true;
                    self.lower[s.index()] = value.min(self.upper[s.index()]);
                    if self.maximises {
                        self.choices[s.index()] = chosen[i];
                    }
                }
            }
            break;
        }
        jumped
    }
}
