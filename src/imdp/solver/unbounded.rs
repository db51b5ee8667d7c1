//! Unbounded until: part by part, from below and from above.
//!
//! The strong components of the graph are solved successors first, so that acyclic parts take a single
//! pass. Outside cycles both bounds are one application of the operator; a cyclic component is iterated
//! (`component`).

use super::bounded::indicator;
use super::component::Component;
use super::evidence::unlike;
use super::expectation::Bound;
use super::graph::{ChoiceTree, ranks, strong_components, zero_one};
use super::options::Control;
use super::policy::{NO_CHOICE, first_choice};
use super::query::{Direction, Players};
use super::range_optimum::RangeOptimum;
use super::shared::{Precise, Shared};
use super::slow::to_rational;
use super::sweep::Sweep;
use super::{Policy, Solution, SolveError, SolverOptions, Status, ValueBounds};
use crate::certificate::{Evidence, Inductive};
use crate::exact::Replaced;
use crate::model::{IntervalMdp, RowBuffer, RowId, StateId, StateSet, require_memory};

/// Sweeps of a cyclic part before it is given to linear equations.
const PATIENCE: u64 = 256;

/// The value of `safe U goal`.
pub(super) fn until(
    model: &IntervalMdp,
    safe: &StateSet,
    goal: &StateSet,
    players: Players,
    options: &SolverOptions<'_>,
) -> Result<Solution, SolveError> {
    until_with_patience(model, (safe, goal), players, options, PATIENCE)
}

/// The same, with another number of sweeps before linear equations.
pub(super) fn until_with_patience(
    model: &IntervalMdp,
    (safe, goal): (&StateSet, &StateSet),
    players: Players,
    options: &SolverOptions<'_>,
    patience: u64,
) -> Result<Solution, SolveError> {
    let states = model.num_states();
    let rows = model.rows().len();
    let mut moving = StateSet::with_capacity(states);
    let has_rows = |s: &usize| !model.choices().ranges(StateId::from_index(*s)).is_empty();
    (0..states)
        .filter(|&s| safe.contains(s) && !goal.contains(s))
        .filter(has_rows)
        .for_each(|s| moving.insert(s));
    let known = zero_one(model, goal, &moving, players);
    let open = |s: usize| known.positive.contains(s) && !known.certain.contains(s);

    let parts = parts(model, &open);
    let table = RangeOptimum::new(players.policy, rows);
    let mut shared = Shared {
        model,
        players,
        lower: indicator(&known.certain),
        upper: indicator(&known.positive),
        lower_rows: table.clone(),
        upper_rows: table,
        choices: known.choices.clone(),
        wants_policy: options.policy || options.evidence,
        precise_lower: Precise::new(),
        precise_upper: Precise::new(),
        patience,
        own_rows: StateSet::with_capacity(rows),
    };
    // Every cyclic part may add its share to the distance of the bounds of what it depends on.
    let share = options.epsilon / (2.0 * (1 + longest_dependency(&parts, model, rows)) as f64);
    let mut control = Control::new(options);
    let mut status = Status::Converged;
    for part in &parts {
        let outcome = match part {
            Part::Row(row) => {
                shared.evaluate_row(*row);
                None
            }
            Part::State(state) => {
                shared.evaluate_state(*state);
                None
            }
            Part::Cyclic { states, rows } => {
                Component::new(&mut shared, states.clone(), rows).solve(share, &mut control)
            }
        };
        if let Some(reason) = outcome {
            status = reason;
            break;
        }
    }
    let choices = shared.policy(&moving);
    let evidence = match options.evidence {
        true => Some(Evidence::Inductive(shared.evidence(&moving, &choices)?)),
        false => None,
    };
    let policy = shared.wants_policy.then(|| Policy::stationary(&choices));
    let values = ValueBounds { lower: shared.lower, upper: shared.upper };
    // A component may have met its limit without spoiling the whole, and the other way round.
    if status == Status::Converged && values.gap() > options.epsilon {
        status = Status::PrecisionLimit;
    }
    Ok(Solution { values, status, iterations: control.iterations, policy, history: vec![], evidence })
}

/// A strong component of the graph of states and rows.
enum Part {
    Row(RowId),
    State(StateId),
    Cyclic { states: Vec<StateId>, rows: Vec<RowId> },
}

/// The strong components of the open states, successors first; ranges are walked as trees of rows.
fn parts(model: &IntervalMdp, open: &impl Fn(usize) -> bool) -> Vec<Part> {
    let (states, rows) = (model.num_states(), model.rows().len());
    let tree = ChoiceTree::new(rows, model.choices(), |s| open(s.index()));
    let components = strong_components(states + 2 * rows, (0..states).filter(|&s| open(s)), |node, out| {
        match node.checked_sub(states) {
            None => out.extend(tree.cover(StateId::from_index(node)).iter().map(|node| node + states as u32)),
            Some(inner) if inner < rows => {
                out.extend([2 * inner, 2 * inner + 1].map(|child| (states + child) as u32));
            }
            Some(leaf) => {
                let buffer = &mut RowBuffer::default();
                let row = model.rows().row(RowId::from_index(leaf - rows), buffer);
                let possible = row.successors.iter().zip(row.upper).filter(|(_, u)| **u > 0.0);
                out.extend(possible.filter(|(s, _)| open(s.index())).map(|(s, _)| s.0));
            }
        }
    });
    let part = |component: Vec<u32>| {
        let (mut own_states, mut own_rows) = (vec![], vec![]);
        for node in component {
            let node = node as usize;
            if node < states {
                own_states.push(StateId::from_index(node));
            } else if node >= states + rows {
                own_rows.push(RowId::from_index(node - states - rows));
            }
        }
        match (&own_states[..], &own_rows[..]) {
            ([], []) => None,
            ([], &[row]) => Some(Part::Row(row)),
            (&[state], []) => Some(Part::State(state)),
            _ => {
                own_states.sort_unstable();
                own_rows.sort_unstable();
                Some(Part::Cyclic { states: own_states, rows: own_rows })
            }
        }
    };
    components.into_iter().filter_map(part).collect()
}

/// The largest number of cyclic parts that depend on one another, or a bound on it.
fn longest_dependency(parts: &[Part], model: &IntervalMdp, rows: usize) -> usize {
    let mut of_row = vec![0u32; rows];
    let mut of_state = vec![0u32; model.num_states()];
    let mut longest = 0;
    let behind = |row: RowId, of_state: &[u32]| {
        let buffer = &mut RowBuffer::default();
        model.rows().row(row, buffer).successors.iter().map(|&s| of_state[s.index()]).max().unwrap_or(0)
    };
    let across = |state: StateId, of_row: &[u32]| {
        model.choices().rows(state).map(|row| of_row[row.index()]).max().unwrap_or(0)
    };
    for part in parts {
        match part {
            Part::Row(row) => of_row[row.index()] = behind(*row, &of_state),
            Part::State(state) => of_state[state.index()] = across(*state, &of_row),
            Part::Cyclic { states, rows } => {
                let rows_behind = rows.iter().map(|&row| behind(row, &of_state)).max();
                let depth =
                    states.iter().map(|&s| across(s, &of_row)).max().max(rows_behind).unwrap_or(0) + 1;
                rows.iter().for_each(|&row| of_row[row.index()] = depth);
                states.iter().for_each(|&s| of_state[s.index()] = depth);
                longest = longest.max(depth as usize);
            }
        }
    }
    longest
}

impl Shared<'_> {
    /// Both bounds on a row whose successors are finished.
    fn evaluate_row(&mut self, row: RowId) {
        let mut sweep = Sweep::new(self.model, self.players, vec![], &[row]);
        sweep.evaluate_rows(&self.lower, Bound::Lower, &mut self.lower_rows);
        sweep.evaluate_rows(&self.upper, Bound::Upper, &mut self.upper_rows);
    }

    /// Both bounds on a state whose rows are finished.
    fn evaluate_state(&mut self, state: StateId) {
        let ranges = self.model.choices().ranges(state);
        let s = state.index();
        self.lower[s] = self.lower_rows.best(ranges).max(self.lower[s]);
        self.upper[s] = self.upper_rows.best(ranges).min(self.upper[s]).max(self.lower[s]);
        if self.wants_policy {
            self.choose(state);
        }
    }

    /// Whether choices must be noted when lower bounds improve.
    pub(super) fn maximises_for_policy(&self) -> bool {
        self.wants_policy && self.players.policy == Direction::Max
    }

    /// Whether the present choice of a state attains the new lower bound.
    pub(super) fn keeps_choice(&self, state: StateId, value: f64) -> bool {
        self.model
            .choices()
            .row_of_choice(state, self.choices[state.index()])
            .is_some_and(|row| self.lower_rows.values()[row.index()] >= value)
    }

    /// Makes the policy choose the best row of a state for the bounds that it must guarantee.
    pub(super) fn choose(&mut self, state: StateId) {
        let table = match self.players.policy {
            Direction::Max => &self.lower_rows,
            Direction::Min => &self.upper_rows,
        };
        let best = table.best(self.model.choices().ranges(state));
        let attains = |row: RowId| table.values()[row.index()] == best;
        let choice = first_choice(self.model.choices(), state, attains);
        self.choices[state.index()] = choice.unwrap_or(NO_CHOICE);
    }

    /// Whether choices must be noted when upper bounds improve.
    pub(super) fn minimises_for_policy(&self) -> bool {
        self.wants_policy && self.players.policy == Direction::Min
    }

    /// The choices made on the way: `L ≤ T_σ(L)` if the policy maximises, else `U ≥ T_σ(U)`.
    fn policy(&self, moving: &StateSet) -> Vec<u32> {
        let mut all = vec![NO_CHOICE; self.choices.len()];
        // Where nothing can be gained or lost, the first choice is as good as any.
        let choices = moving.ones().map(|s| (s, self.choices[s]));
        choices.for_each(|(s, choice)| all[s] = if choice == NO_CHOICE { 0 } else { choice });
        all
    }

    /// What proves the bounds.
    fn evidence(&self, moving: &StateSet, choices: &[u32]) -> Result<Inductive, SolveError> {
        let rows = self.model.rows();
        // Rows as lists, and as lists by state; ranks.
        let bytes = 40 * rows.num_entries() + 64 * (rows.len() + choices.len());
        require_memory("the certificate", bytes as u64)?;
        let of_doubles = |precise: &Precise| {
            let mut states = moving.clone();
            precise.keys().for_each(|&s| states.remove(s.index()));
            states
        };
        let fractions = |precise: &Precise| -> Replaced {
            precise.iter().map(|(&s, &units)| (s, to_rational(units))).collect()
        };
        let (exact_lower, exact_upper) = (fractions(&self.precise_lower), fractions(&self.precise_upper));
        Ok(Inductive {
            choices: unlike(choices, moving.ones(), NO_CHOICE),
            lower: unlike(&self.lower, of_doubles(&self.precise_lower).ones(), 0.0),
            upper: unlike(&self.upper, of_doubles(&self.precise_upper).ones(), 1.0),
            ranks: ranks(self.model, moving, self.players, &self.lower, &exact_lower, choices),
            exact_lower: exact_lower.into_iter().collect(),
            exact_upper: exact_upper.into_iter().collect(),
        })
    }
}
