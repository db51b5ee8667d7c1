//! Step-bounded until, and next: value iteration with bounds on both sides.
//!
//! `V_0 = 1_goal`, `V_{k+1}(s) = opt_a opt_p p·V_k` for safe states that are not goal states.

use super::contenders::{Contenders, LITTLE_GROWTH};
use super::evidence::Recorder;
use super::expectation::Bound;
use super::history::History;
use super::options::Control;
use super::policy::{NO_CHOICE, first_choice};
use super::query::{Direction, Players};
use super::range_optimum::RangeOptimum;
use super::sweep::Sweep;
use super::{Policy, Solution, SolveError, SolverOptions, Status, ValueBounds};
use crate::certificate::Evidence;
use crate::model::{GrowingMemory, IntervalMdp, RowId, StateId, StateSet};

/// The value of `safe U<=steps goal`.
pub(super) fn until(
    model: &IntervalMdp,
    (safe, goal, steps): (&StateSet, &StateSet, u64),
    players: Players,
    options: &SolverOptions<'_>,
) -> Result<Solution, SolveError> {
    let choices = model.choices();
    let moving =
        |&s: &StateId| safe.contains(s.index()) && !goal.contains(s.index()) && !choices.ranges(s).is_empty();
    let states: Vec<StateId> = StateId::first(model.num_states()).filter(moving).collect();
    let mut iteration = Iteration::new(model, players, states, goal, options);
    let mut control = Control::of(options, Some(steps));
    let mut status = Status::HorizonReached;
    while control.iterations < steps {
        if let Some(reason) = control.stop() {
            status = reason;
            break;
        }
        let changed = iteration.step(control.iterations + 1)?;
        control.done(iteration.gap);
        if !changed {
            break;
        }
    }
    if status != Status::HorizonReached {
        iteration.give_up_upper();
    }
    Ok(iteration.finish(steps, status, control.iterations))
}

/// The value of `X goal`.
pub(super) fn next(
    model: &IntervalMdp,
    goal: &StateSet,
    players: Players,
    options: &SolverOptions<'_>,
) -> Result<Solution, SolveError> {
    let moving = |&s: &StateId| !model.choices().ranges(s).is_empty();
    let states: Vec<StateId> = StateId::first(model.num_states()).filter(moving).collect();
    let mut iteration = Iteration::new(model, players, states, goal, options);
    // `X` is no `U<=1`: a goal state may be left at once.
    iteration.monotone = false;
    (iteration.asks, iteration.contenders) = (false, None);
    iteration.step(1)?;
    Ok(iteration.finish(1, Status::HorizonReached, 1))
}

/// 1 in the states of a set, 0 elsewhere.
pub(super) fn indicator(set: &StateSet) -> Vec<f64> {
    (0..set.len()).map(|s| if set.contains(s) { 1.0 } else { 0.0 }).collect()
}

/// A change in a list that grows, which may take twice as much, and in the policy that it becomes.
pub(super) const CHANGE_BYTES: u64 = 2 * size_of::<(StateId, u64, u32)>() as u64 + 16;

struct Iteration<'a> {
    model: &'a IntervalMdp,
    players: Players,
    sweep: Sweep<'a>,
    lower: Vec<f64>,
    upper: Vec<f64>,
    lower_rows: RangeOptimum,
    upper_rows: RangeOptimum,
    /// Whether to ask at some time which rows may be the best of some state.
    asks: bool,
    /// Of lower and, if they are wanted, of upper bounds.
    contenders: Option<Vec<Contenders>>,
    /// How much values have grown in the last step, at most.
    grown: f64,
    results: Vec<f64>,
    gap: f64,
    /// Whether values can only grow from step to step.
    monotone: bool,
    wants_upper: bool,
    /// The current choice of every state, if a policy is wanted, and all changes of it.
    current: Option<Vec<u32>>,
    changes: Vec<(StateId, u64, u32)>,
    memory: GrowingMemory,
    /// By position in `sweep.states`: whether the last step raised the lower bound.
    raised: Vec<bool>,
    recorder: Option<Recorder>,
    history: History,
}

/// The bounds that a policy guarantees: those from below if it maximises, those from above if it minimises.
fn guaranteed<'v>(policy: Direction, lower: &'v [f64], upper: &'v [f64]) -> &'v [f64] {
    match policy {
        Direction::Max => lower,
        Direction::Min => upper,
    }
}

impl<'a> Iteration<'a> {
    fn new(
        model: &'a IntervalMdp,
        players: Players,
        states: Vec<StateId>,
        goal: &StateSet,
        options: &SolverOptions<'_>,
    ) -> Self {
        let mut table = RangeOptimum::new(players.policy, model.rows().len());
        table.prepare(model.choices(), &states);
        let rows = model.choices().used_rows(model.rows().len(), states.iter().copied());
        let asks = players.policy == Direction::Max && Contenders::pay(model);
        let asks_at_once = asks && model.rows().as_stored().is_none();
        Self {
            model,
            players,
            lower: indicator(goal),
            upper: indicator(goal),
            lower_rows: table.clone(),
            upper_rows: table,
            asks,
            // Before the first step all values are 0, and so is what any row is worth.
            contenders: asks_at_once.then(|| {
                vec![Contenders::new(model, &vec![0.0; model.num_states()]); 1 + usize::from(options.upper)]
            }),
            grown: f64::INFINITY,
            results: vec![],
            gap: 0.0,
            monotone: true,
            wants_upper: options.upper,
            current: (options.policy || options.evidence).then(|| vec![NO_CHOICE; model.num_states()]),
            changes: vec![],
            memory: GrowingMemory::new("the policy"),
            raised: vec![false; states.len()],
            recorder: options.evidence.then(|| Recorder::new(states.len())),
            history: History::new(options.history),
            sweep: Sweep::new(model, players, states, &rows),
        }
    }

    /// One step; returns whether any bound changed. `left` is the number of steps left in the new values.
    ///
    /// # Errors
    /// [`SolveError::Memory`] if there may be no room for the step's certificate or changes of the policy.
    fn step(&mut self, left: u64) -> Result<bool, SolveError> {
        let mut changed = false;
        self.gap = 0.0;
        if self.current.is_some() {
            let bytes = |changes: usize| CHANGE_BYTES * changes as u64;
            self.memory.make_room(bytes(self.changes.len()), bytes(self.sweep.states.len()))?;
        }
        let guaranteed = guaranteed(self.players.policy, &self.lower, &self.upper);
        self.history.keep(guaranteed);
        self.evaluate_rows();
        let mut recorder = self.recorder.as_mut();
        if let Some(recorder) = &mut recorder {
            recorder.begin()?;
        }
        let mut grown = 0.0f64;
        self.sweep.evaluate_states(&self.lower_rows, &mut self.results);
        for (i, (&s, &value)) in self.sweep.states.iter().zip(&self.results).enumerate() {
            let old = &mut self.lower[s.index()];
            self.raised[i] = value > *old;
            // The exact values do not decrease, so a decrease is rounding only.
            let value = if self.monotone { value.max(*old) } else { value };
            if value != *old {
                changed = true;
                grown = grown.max(value - *old);
                *old = value;
                if let Some(recorder) = &mut recorder {
                    recorder.lower(s, value);
                }
            }
        }
        if self.wants_upper {
            self.sweep.evaluate_states(&self.upper_rows, &mut self.results);
        } else {
            self.results.fill(1.0);
        }
        for (&s, &value) in self.sweep.states.iter().zip(&self.results) {
            let old = &mut self.upper[s.index()];
            let value = if self.monotone { value.max(*old) } else { value };
            if value != *old {
                changed = true;
                *old = value;
                if let Some(recorder) = &mut recorder {
                    recorder.upper(s, value);
                }
            }
            self.gap = self.gap.max(value - self.lower[s.index()]);
        }
        if let Some(recorder) = recorder {
            recorder.end();
        }
        self.grown = grown;
        self.update_policy(left);
        Ok(changed)
    }

    /// Evaluates the rows that may be the best of some state, for bounds on both sides if wanted.
    fn evaluate_rows(&mut self) {
        let Self {
            model,
            sweep,
            contenders,
            lower,
            upper,
            lower_rows,
            upper_rows,
            wants_upper,
            asks,
            grown,
            ..
        } = self;
        let sides = [(&*lower, &mut *lower_rows), (&*upper, &mut *upper_rows)];
        if let Some(contenders) = contenders {
            for (contenders, (values, rows)) in contenders.iter_mut().zip(sides) {
                contenders.look(model, &sweep.states, values, rows);
            }
        } else if *asks && *grown <= LITTLE_GROWTH {
            let wanted = sides.iter().take(1 + usize::from(*wants_upper));
            *contenders = Some(wanted.map(|(values, _)| Contenders::new(model, values)).collect());
        }
        let wants = |side: usize, row: RowId| contenders.as_ref().is_none_or(|both| both[side].wants(row));
        if *wants_upper {
            let values: Vec<[f64; 2]> = lower.iter().zip(&*upper).map(|(&low, &high)| [low, high]).collect();
            let (sides, tables) = ([Bound::Lower, Bound::Upper], [lower_rows, upper_rows]);
            sweep.evaluate_some_rows(&values, sides, tables, |row| [wants(0, row), wants(1, row)]);
        } else {
            let (values, _) = lower.as_chunks::<1>();
            sweep.evaluate_some_rows(values, [Bound::Lower], [lower_rows], |row| [wants(0, row)]);
        }
    }

    /// Replaces the choices that are no longer optimal on the side that the policy must guarantee.
    ///
    /// A maximising policy keeps its choice where the lower bound is not raised: that bound was reached by it,
    /// and what now looks better may do so by rounding only.
    fn update_policy(&mut self, left: u64) {
        let Some(current) = &mut self.current else { return };
        let optimum = self.players.policy;
        let table = if optimum == Direction::Max { &self.lower_rows } else { &self.upper_rows };
        let (choices, weights) = (self.model.choices(), table.values());
        for (&s, &raised) in self.sweep.states.iter().zip(&self.raised) {
            let now = &mut current[s.index()];
            if optimum == Direction::Max && !raised && *now != NO_CHOICE {
                continue;
            }
            let best = table.best(choices.ranges(s));
            let keep = choices
                .row_of_choice(s, *now)
                .is_some_and(|row| !optimum.prefers(best, weights[row.index()]));
            if !keep && let Some(choice) = first_choice(choices, s, |row| weights[row.index()] == best) {
                *now = choice;
                self.changes.push((s, left, choice));
            }
        }
    }

    /// Replaces the upper bounds, which do not hold for further steps, by 1.
    fn give_up_upper(&mut self) {
        for &s in &self.sweep.states {
            self.upper[s.index()] = 1.0;
        }
        if let Some(recorder) = &mut self.recorder {
            recorder.give_up_upper(&self.sweep.states);
        }
    }

    fn finish(self, steps: u64, status: Status, iterations: u64) -> Solution {
        let states = self.model.num_states();
        let guaranteed = guaranteed(self.players.policy, &self.lower, &self.upper);
        Solution {
            history: self.history.finish(guaranteed, steps, iterations),
            values: ValueBounds { lower: self.lower, upper: self.upper },
            status,
            iterations,
            policy: self.current.is_some().then(|| Policy::time_varying(steps, states, &self.changes)),
            evidence: self.recorder.map(|recorder| Evidence::Steps(recorder.finish(&self.changes))),
        }
    }
}
