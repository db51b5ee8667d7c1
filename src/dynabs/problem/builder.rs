//! From parts to a problem: the checks that need several parts at once.

use super::cost::require_apart;
use super::grouping::Setting;
pub(super) use super::problem::InitialState;
use super::problem::Problem;
use super::values::{name, vector};
use super::{
    Cost, CostParts, Dynamics, GroupSteps, InputSet, LowerLayer, NoiseSource, Partition, Probabilities,
    Stabilizer, TargetChoice, Task, checked_task, dynamics, regions, tracking,
};
use crate::partition::Grid;
use crate::system::{Variable, group};
use crate::{Diagnostic, Warning};
use imdp::numeric::to_f64;

/// The parts of a [`Problem`], not yet checked. Partition, task and noise must be given.
#[derive(Clone, Debug)]
#[must_use = "build() makes the problem"]
pub struct ProblemBuilder {
    name: String,
    dynamics: Dynamics,
    input: InputSet,
    group_steps: GroupSteps,
    lower_layer: Option<LowerLayer>,
    partition: Option<Partition>,
    targets: TargetChoice,
    task: Option<Task>,
    initial_state: Option<Vec<f64>>,
    costs: Vec<CostParts>,
    probabilities: Probabilities,
    noise: Option<NoiseSource>,
}

impl Problem {
    /// Begins a problem for a system and the inputs allowed in one step.
    pub fn builder(system: impl Into<Dynamics>, input: InputSet) -> ProblemBuilder {
        ProblemBuilder::new(system.into(), input)
    }
}

impl ProblemBuilder {
    pub(super) fn new(dynamics: Dynamics, input: InputSet) -> Self {
        Self {
            name: "problem".to_owned(),
            dynamics,
            input,
            group_steps: GroupSteps::Auto,
            lower_layer: None,
            partition: None,
            targets: TargetChoice::Centers,
            task: None,
            initial_state: None,
            costs: vec![],
            probabilities: Probabilities::default(),
            noise: None,
        }
    }

    /// A short name.
    pub fn name(mut self, name: impl Into<String>) -> Self {
        self.name = name.into();
        self
    }

    /// How many steps become one; by default as few as make the grouped `B` of full row rank.
    pub fn group_steps(mut self, steps: GroupSteps) -> Self {
        self.group_steps = steps;
        self
    }

    /// A lower layer, of linear feedback or with a plan to follow; by default there is none.
    pub fn lower_layer(mut self, layer: LowerLayer) -> Self {
        self.lower_layer = Some(layer);
        self
    }

    /// The grid of cells; everything outside counts as failed.
    pub fn partition(mut self, partition: Partition) -> Self {
        self.partition = Some(partition);
        self
    }

    /// The points that actions steer to; by default the centers of all cells.
    pub fn targets(mut self, targets: TargetChoice) -> Self {
        self.targets = targets;
        self
    }

    /// What the controller is to achieve.
    pub fn task(mut self, task: Task) -> Self {
        self.task = Some(task);
        self
    }

    /// The state from which the guarantee is wanted; by default every ordinary cell is initial.
    pub fn initial_state(mut self, state: Vec<f64>) -> Self {
        self.initial_state = Some(state);
        self
    }

    /// What steps cost, in the coordinates `x1, …` and `u1, …`; by default nothing.
    pub fn costs(mut self, costs: Vec<CostParts>) -> Self {
        self.costs = costs;
        self
    }

    /// How intervals are computed; by default so that all hold together with probability 0.99.
    pub fn probabilities(mut self, probabilities: Probabilities) -> Self {
        self.probabilities = probabilities;
        self
    }

    /// What is known of the noise, or where samples of it come from.
    pub fn noise(mut self, source: impl Into<NoiseSource>) -> Self {
        self.noise = Some(source.into());
        self
    }

    /// Checks all parts, reads or draws the samples.
    ///
    /// # Errors
    /// A [`Diagnostic`] for the first mistake found. Its place is the field's in a model file.
    pub fn build(self) -> Result<Problem, Diagnostic> {
        let Dynamics::Linear(linear) = &self.dynamics;
        let step_system = linear.system()?;
        let n = step_system.state_dimension();
        let step_input = self.input.polytope("/input", step_system.input_dimension())?;
        let mut group_steps = dynamics::group_steps(self.group_steps, &step_system)?;
        dynamics::require_short_numbers(&step_system, group_steps)?;

        let (states, inputs) =
            (Variable::numbered("x", n), Variable::numbered("u", step_system.input_dimension()));
        let costs = self.costs.iter().map(|cost| cost.cost([&states, &inputs]));
        let costs: Vec<Cost> = costs.collect::<Result<_, _>>()?;
        require_apart(&costs)?;
        let grid = given(self.partition, "partition")?.grid("/partition", n)?;
        let actions = regions::actions("/targets", &self.targets, n)?;
        let wanted = given(self.task, "task")?;
        let mut task = checked_task::CheckedTask::new(&wanted, &grid, group_steps)?;
        let initial = self.initial_state.map(|state| initial(state, &grid)).transpose()?;
        let noise = given(self.noise, "noise")?;
        let setting = Setting {
            system: &step_system,
            input: &step_input,
            grid: &grid,
            actions: &actions,
            labels: &task.labels,
            start: initial.as_ref().map(|initial| initial.cell),
        };
        let is_free =
            self.group_steps == GroupSteps::Auto && self.lower_layer.is_none() && !noise.is_grouped();
        let most = if is_free { wanted.horizon.most() } else { group_steps as u64 };
        let trials = setting.trials(group_steps, usize::try_from(most).unwrap_or(usize::MAX));
        if let Some(chosen) = Setting::chosen(&trials).filter(|&chosen| chosen > group_steps) {
            group_steps = chosen;
            dynamics::require_short_numbers(&step_system, group_steps)?;
            task = checked_task::CheckedTask::new(&wanted, &grid, group_steps)?;
        }
        checked_task::require_steerable(&wanted, group_steps, &self.probabilities)?;
        let worst_task = checked_task::at_worst(&task)?;
        let system = group(&step_system, group_steps);
        let input = step_input.power(group_steps);
        let stabilizer = self.lower_layer.map(|layer| Stabilizer::new(&layer, &system, &input, &grid));
        let stabilizer = stabilizer.transpose()?;
        if stabilizer.as_ref().is_some_and(|layer| layer.tracking().is_some()) {
            tracking::require_no_memory(&task.objective)?;
        }
        let noise = noise.plant_noise(&step_system, group_steps)?;
        let safety = checked_task::safety(wanted.check, group_steps, &noise, &self.probabilities)?;
        let mut warnings = task.warnings;
        if let Some(fewest) = trials.first().filter(|fewest| fewest.steps < group_steps) {
            warnings.push(Warning::Grouped { steps: group_steps, fewest: fewest.clone() });
        }
        warnings.extend(stabilizer.iter().flat_map(|layer| layer.warnings().iter().cloned()));
        warnings.extend(noise.samples().iter().flat_map(|samples| samples.warnings.iter().cloned()));
        Ok(Problem {
            name: name(self.name)?,
            step_system,
            step_input,
            group_steps,
            grouping: trials,
            system,
            input,
            stabilizer,
            grid,
            labels: task.labels,
            cell_task: task.cell_task,
            worst_task,
            objective: task.objective,
            unsafe_: task.unsafe_,
            outside_is_unsafe: task.outside_is_unsafe,
            safety,
            actions,
            horizon: task.horizon,
            threshold: task.threshold,
            initial,
            costs,
            probabilities: self.probabilities,
            noise,
            warnings,
        })
    }
}

pub(super) fn given<T>(part: Option<T>, name: &str) -> Result<T, Diagnostic> {
    part.ok_or_else(|| Diagnostic::at("", format!("no field `{name}`"), format!("the field `{name}`")))
}

pub(super) fn initial(state: Vec<f64>, grid: &Grid) -> Result<InitialState, Diagnostic> {
    let place = "/initial_state";
    let exact = vector(place, &state, grid.dimension(), "one per dimension of the state")?;
    let outside = (0..state.len()).find(|&j| grid.axes()[j].locate(&exact[j]).is_none());
    match (outside, grid.locate(&exact)) {
        (None, Some(cell)) => Ok(InitialState { state, cell }),
        (outside, _) => {
            let j = outside.unwrap_or_default();
            let axis = &grid.axes()[j];
            let expected = format!(
                "a state in the partition, [{}, {}) there",
                to_f64(axis.lower()),
                to_f64(axis.upper())
            );
            Err(Diagnostic::at(format!("{place}/{j}"), state[j].to_string(), expected)
                .remedy("Move the state or enlarge the partition; cells do not contain their upper faces."))
        }
    }
}
