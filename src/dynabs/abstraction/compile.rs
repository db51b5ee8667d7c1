//! The pipeline from problem to interval MDP.

use super::base::{Base, Intervals};
use super::enabling::Enabling;
use super::pac::{PacRows, Preference, Worth};
use super::states::{FAILED, REACHED, StateSpace, labels};
use super::targets::Targets;
use super::{AbstractionError, Footprint, Plan, known, reference, sharing};
use crate::Warning;
use crate::guarantee::{Event, Evidence, Guarantee};
use crate::partition::{CellId, CellKind, Grid};
use crate::problem::{Knowledge, Problem, TargetId};
use crate::system::FeedbackLaw;
use crate::task::{Aim, Memory};
use imdp::model::{
    ActionNames, Choices, ImdpError, IntervalMdp, ModelKind, Parts, RowId, RowRange, RowSet, StateId,
    StateSet,
};
use imdp::progress::Progress;
use imdp::property::{PathFormula, Property, Resolution, StateFormula, Threshold, ThresholdComparison};
use imdp::solver::{Answer, SolverOptions};
use std::time::{Duration, Instant};

/// A control problem as an interval MDP.
#[derive(Clone, Debug)]
pub struct Abstraction {
    /// The model.
    pub model: IntervalMdp,
    /// The task as a property of the model.
    pub property: Property,
    /// The state that every cell of the partition is at the start.
    pub state_of_cell: Vec<StateId>,
    /// The targets; there is a row for each of them with every memory of the task, memory after memory.
    pub targets: Targets,
    /// The law that steers to them.
    pub law: FeedbackLaw,
    /// The plan that actions are near, if one is followed.
    pub plan: Option<Plan>,
    /// What is asked about costs, in PRISM's syntax; nothing before they are rewards of the model.
    pub costs: Vec<String>,
    /// What the intervals promise, which is nothing in `reference` mode.
    pub guarantee: Guarantee,
    /// How much memory was expected to be needed.
    pub footprint: Footprint,
    /// How long each phase took.
    pub phases: Vec<(&'static str, Duration)>,
    /// What the user should know.
    pub warnings: Vec<Warning>,
    states: StateSpace,
}

/// How long to look for values by which windows are chosen: a better choice is not worth more.
const SCOUT_ITERATIONS: u64 = 200;

/// Measures the phases of the pipeline.
struct Clock {
    start: Instant,
    phases: Vec<(&'static str, Duration)>,
}

impl Clock {
    fn lap(&mut self, phase: &'static str) {
        let now = Instant::now();
        self.phases.push((phase, now - self.start));
        self.start = now;
    }
}

/// Abstracts a problem: targets, enabled actions, rows, labels, property.
///
/// # Errors
/// [`AbstractionError`] if nothing is enabled, the samples are too few or the model too large.
pub fn compile(problem: &Problem, progress: &dyn Progress) -> Result<Abstraction, AbstractionError> {
    let mut clock = Clock { start: Instant::now(), phases: vec![] };
    let grid = problem.grid();
    let steering = sharing::steering(problem)?;
    clock.lap("law");

    let footprint = Footprint::new(problem, &steering).with_rows(problem, &steering);
    footprint.check()?;
    clock.lap("memory");

    let states = state_space(problem);
    let Base { placements, intervals, mut enabling } = Base::new(problem, &states, &steering, progress)?;
    let footprint = footprint.with_rooms(problem, &enabling.targets)?;
    clock.lap("enabled actions");

    let mut warnings = warnings(problem, &enabling);
    let choices = choices(problem, &states, &mut enabling);
    let targets = &enabling.targets;
    let blocked = states.select(|state| is_blocked(problem, &states, &choices, state));
    clock.lap("choices");

    let is_published = matches!(intervals, Intervals::Reference(..));
    let (reached, failed) = outcome_states(problem, &states, &blocked, is_published);
    let property = task_property(problem);
    let model_of = |rows: RowSet| -> Result<IntervalMdp, ImdpError> {
        IntervalMdp::new(Parts {
            kind: ModelKind::Imdp,
            rows,
            choices: choices.clone(),
            actions: ActionNames::OfRow,
            initial: states.initial(problem.initial_cell(), problem.labels()),
            labels: labels(blocked.clone(), reached.clone(), failed.clone()),
            variables: states.variables(grid),
        })
    };
    let contradiction = intervals.contradiction();
    let (rows, evidence) = match intervals {
        Intervals::Reference(noise, beta_per_interval) => {
            let rows = reference::build(
                (problem, noise),
                beta_per_interval,
                targets,
                placements,
                &states,
                progress,
            )?;
            clock.lap("rows");
            (rows, Evidence::Published { beta_per_interval })
        }
        Intervals::Known(components) => {
            let tolerance = steering.law.steering_error(&steering.extent);
            let (rows, unlisted) =
                known::build(problem, components, (&enabling, &tolerance), &states, progress)?;
            clock.lap("rows");
            (rows, Evidence::Known { unlisted, both_sides: false })
        }
        Intervals::Pac(noise, prepared) => {
            let pac = PacRows::new((problem, noise), *prepared, &enabling, placements, &states)?;
            let rows = pac.rows(Preference::LeastFailing, "rows", progress);
            clock.lap("rows");
            let values = scout(&model_of(rows.clone())?, &property)?;
            let worth = Worth::new(values, &rows);
            let rows = pac.rows(Preference::Worth(&worth), "choice of windows", progress);
            clock.lap("choice of windows");
            (rows, Evidence::Samples(pac.evidence()))
        }
    };
    warnings.extend(contradiction);
    let model = model_of(rows)?;
    clock.lap("model");
    Ok(Abstraction {
        model,
        property,
        state_of_cell: state_of_cell(grid, &states),
        states,
        targets: enabling.targets,
        law: steering.law,
        plan: enabling.plan,
        costs: vec![],
        guarantee: Guarantee { event: Event::of(problem), evidence },
        footprint,
        phases: clock.phases,
        warnings,
    })
}

/// What the task is worth from every state, roughly: never above the value.
fn scout(model: &IntervalMdp, property: &Property) -> Result<Vec<f64>, AbstractionError> {
    let options = SolverOptions {
        max_iterations: SCOUT_ITERATIONS,
        epsilon: 1e-3,
        upper: false,
        ..SolverOptions::default()
    };
    Ok(Answer::new(model, property, &options)?.values.lower)
}

impl Abstraction {
    /// The abstraction of `problem` whose model was compiled before, `model`.
    ///
    /// Samples are not counted again; the choices of the model are compared with the actions that are enabled, so that
    /// whatever a policy chooses is safe to apply.
    ///
    /// # Errors
    /// [`AbstractionError::Foreign`] if the model or what is promised of it is another problem's.
    pub fn reopen(
        problem: &Problem,
        model: IntervalMdp,
        guarantee: Guarantee,
        progress: &dyn Progress,
    ) -> Result<Self, AbstractionError> {
        let mut clock = Clock { start: Instant::now(), phases: vec![] };
        let steering = sharing::steering(problem)?;
        let footprint = Footprint::new(problem, &steering);
        footprint.check()?;
        let states = state_space(problem);
        let mut enabling = Base::new(problem, &states, &steering, progress)?.enabling;
        let warnings = warnings(problem, &enabling);
        let same = guarantee.event == Event::of(problem)
            && model.num_states() == states.len()
            && model.rows().len() == states.memories().len() * enabling.targets.len()
            && *model.choices() == choices(problem, &states, &mut enabling);
        if !same {
            return Err(AbstractionError::Foreign);
        }
        clock.lap("enabled actions");
        Ok(Self {
            property: task_property(problem),
            state_of_cell: state_of_cell(problem.grid(), &states),
            warnings,
            states,
            model,
            targets: enabling.targets,
            law: steering.law,
            plan: enabling.plan,
            costs: vec![],
            guarantee,
            footprint,
            phases: clock.phases,
        })
    }

    /// The state of a cell with a memory of the task, if a run may have it there.
    pub fn state(&self, memory: Memory, cell: CellId) -> Option<StateId> {
        self.states.state(memory, cell)
    }

    /// The state on arrival in a cell, with a memory before or at the start.
    pub fn arrival(&self, problem: &Problem, before: Option<Memory>, cell: CellId) -> StateId {
        self.states.arrival(problem.worst_task(), before, cell)
    }

    /// The actions that are enabled in a cell, whatever the memory, as rows with one of them.
    pub fn ranges(&self, cell: CellId) -> &[RowRange] {
        self.states.first(cell).map_or(&[], |state| self.model.choices().ranges(state))
    }

    /// The memory and the cell of a state, or `None` for one that stands for several.
    pub fn pair(&self, state: StateId) -> Option<(Memory, CellId)> {
        self.states.pair(state)
    }

    /// The memory with which the action of a row is taken.
    pub fn memory(&self, row: RowId) -> Memory {
        let (layer, _) = self.targets.of_row(row);
        self.states.memories().get(layer).copied().unwrap_or_default()
    }

    /// The target that the action of a row steers to.
    pub fn target(&self, row: RowId) -> TargetId {
        self.targets.of_row(row).1
    }
}

fn state_space(problem: &Problem) -> StateSpace {
    match problem.knowledge() {
        Knowledge::Samples { .. } | Knowledge::Distribution(_) => StateSpace::of_task(problem.worst_task()),
        Knowledge::Published { .. } => StateSpace::complete(problem.grid()),
    }
}

fn state_of_cell(grid: &Grid, states: &StateSpace) -> Vec<StateId> {
    (0..grid.num_cells()).map(|cell| states.at_start(CellId(cell))).collect()
}

fn choices(problem: &Problem, states: &StateSpace, enabling: &mut Enabling) -> Choices {
    let per_state: Vec<Option<u32>> = (0..states.len())
        .map(|state| match states.cell(StateId::from_index(state)) {
            // The published tool draws goal and unsafe cells without choices.
            Some(cell) if problem.labels().kind(cell) != CellKind::Ordinary => Some(0),
            Some(cell) => Some(enabling.actions_of(cell).len() as u32).filter(|&own| own > 0),
            None => None,
        })
        .collect();
    let ranges = match states.memories() {
        // Most of all that is in memory: it is not copied.
        [_] if per_state.iter().flatten().map(|&own| own as usize).sum::<usize>()
            == enabling.num_ranges() =>
        {
            enabling.take_actions()
        }
        _ => {
            let of_pair = |(_, (memory, cell)): (StateId, (Memory, CellId))| {
                let first_row = states.layer(memory) * enabling.targets.len();
                let shifted = move |row: RowId| RowId::from_index(first_row + row.index());
                let own = enabling.actions_of(cell).iter();
                own.map(move |range| RowRange { first: shifted(range.first), last: shifted(range.last) })
            };
            states.pairs().flat_map(of_pair).collect()
        }
    };
    Choices::of_ranges(ranges, per_state.into_iter())
}

/// Whether a state is an ordinary cell with nothing enabled.
fn is_blocked(problem: &Problem, states: &StateSpace, choices: &Choices, state: StateId) -> bool {
    choices.is_absorbing(state)
        && states.cell(state).is_some_and(|cell| problem.labels().kind(cell) == CellKind::Ordinary)
}

/// The states that are labelled `reached` and `failed`.
fn outcome_states(
    problem: &Problem,
    states: &StateSpace,
    blocked: &StateSet,
    is_published: bool,
) -> (StateSet, StateSet) {
    let of_kind = |kind, heads: &[StateId]| {
        states.select(|state| match states.cell(state) {
            None => heads.contains(&state),
            Some(cell) => problem.labels().kind(cell) == kind,
        })
    };
    if is_published {
        (of_kind(CellKind::Goal, &[StateId(2)]), of_kind(CellKind::Unsafe, &[StateId(0), StateId(1)]))
    } else {
        // A run that starts in a cell in which nothing is enabled is over.
        let mut failed = blocked.clone();
        failed.insert(FAILED.index());
        (states.select(|state| state == REACHED && states.heads() > 1), failed)
    }
}

/// `Pmaxmin=? [ !"failed" U<=k "reached" ]`, or `G<=k !"failed"`, compared with the threshold if there is one.
fn task_property(problem: &Problem) -> Property {
    let (safe, steps) = (StateFormula::negation(StateFormula::label("failed")), problem.horizon());
    let path = match problem.worst_task().aim() {
        Aim::Stay => PathFormula::Globally { formula: safe, steps },
        Aim::Reach | Aim::End => {
            PathFormula::Until { left: safe, right: StateFormula::label("reached"), steps }
        }
    };
    match problem.threshold() {
        None => Property::value(Resolution::Pmaxmin, path),
        Some(probability) => {
            let comparison = ThresholdComparison::AtLeast;
            let threshold = Threshold { comparison, probability: probability.clone() };
            Property::verdict(Resolution::Pmaxmin, path, threshold)
        }
    }
}

fn warnings(problem: &Problem, enabling: &Enabling) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let ordinary = problem.labels().iter().filter(|(_, kind)| *kind == CellKind::Ordinary);
    let blocked = ordinary.filter(|(cell, _)| enabling.actions_of(*cell).is_empty()).count();
    if blocked > 0 {
        let ordinary = problem.labels().count(CellKind::Ordinary);
        warnings.push(Warning::NothingEnabled { cells: blocked, ordinary });
    }
    if let Some(cell) = problem.initial_cell()
        && problem.labels().kind(cell) == CellKind::Unsafe
    {
        warnings.push(Warning::UnsafeStart);
    }
    warnings
}
