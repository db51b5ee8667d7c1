//! A control problem whose actions are inputs.

use super::builder::{InitialState, given, initial};
use super::checked_task::CheckedTask;
use super::cost::{Cost, CostParts, require_apart};
use super::input_noise::{InputNoise, InputNoiseParts};
use super::problem::Objective;
use super::regions::Partition;
use super::task::Task;
use super::values::{count, name, vector};
use super::{FeedbackChoice, InputSet};
use crate::geometry::Polytope;
use crate::partition::{CellId, CellLabels, Grid, Region};
use crate::system::{Feedback, Mode};
use crate::task::CellTask;
use crate::{Diagnostic, Warning};
use imdp::numeric::Rational;
use imdp::property::Probability;
use num_traits::{Signed, Zero};

/// The parts of an [`InputProblem`], not yet checked.
#[derive(Clone, Debug)]
pub struct InputParts {
    /// A short name.
    pub name: String,
    /// The dynamics of one step.
    pub mode: Mode,
    /// Which coordinates are periodic: the partition covers one period.
    pub periodic: Vec<bool>,
    /// The set of inputs, `U`; without one, what is listed is allowed.
    pub set: Option<InputSet>,
    /// The inputs to choose from.
    pub inputs: InputChoice,
    /// The feedback about the centers of cells.
    pub feedback: FeedbackChoice,
    /// The grid of cells; everything outside counts as failed.
    pub partition: Partition,
    /// How many sub-cells a cell has in each coordinate; chosen if absent.
    pub resolution: Option<Vec<u32>>,
    /// The noise of one step.
    pub noise: InputNoiseParts,
    /// What the controller is to achieve.
    pub task: Option<Task>,
    /// The state from which the guarantee is wanted; by default every ordinary cell is initial.
    pub initial_state: Option<Vec<f64>>,
    /// What steps cost.
    pub costs: Vec<CostParts>,
}

/// Which inputs there are to choose from.
#[derive(Clone, Debug, PartialEq)]
pub enum InputChoice {
    /// So many evenly spaced values of every input, both ends of its interval included: all combinations. `U` must
    /// be a box.
    Grid(Vec<u32>),
    /// These.
    List(Vec<Vec<f64>>),
}

/// A validated control problem whose actions are inputs: any dynamics, any noise.
#[derive(Clone, Debug)]
pub struct InputProblem {
    name: String,
    mode: Mode,
    periodic: Vec<bool>,
    set: Option<Polytope>,
    inputs: Vec<Vec<Rational>>,
    feedback: Feedback,
    grid: Grid,
    labels: CellLabels,
    cell_task: CellTask,
    resolution: Option<Vec<u32>>,
    noise: InputNoise,
    objective: Objective,
    unsafe_: Vec<Region>,
    horizon: Option<u64>,
    threshold: Option<Probability>,
    initial: Option<InitialState>,
    costs: Vec<Cost>,
    warnings: Vec<Warning>,
}

/// More inputs than this are a mistake.
const MOST_INPUTS: u64 = 1 << 20;

/// A finer lattice than this has no use.
const FINEST: u32 = 64;

impl InputProblem {
    /// Checks all parts.
    ///
    /// # Errors
    /// A [`Diagnostic`] for the first mistake found. Its place is the field's in a model file.
    pub fn new(parts: InputParts) -> Result<Self, Diagnostic> {
        let (n, p) = (parts.mode.num_states(), parts.mode.num_inputs());
        let grid = parts.partition.grid("/partition", n)?;
        let set = parts.set.as_ref().map(|set| set.polytope("/input", p)).transpose()?;
        let feedback = parts.feedback.feedback(&parts.mode, &grid, parts.set.as_ref())?;
        let all = candidates(&parts.inputs, parts.set.as_ref(), &feedback)?;
        let (given_inputs, inputs) = (all.len(), allowed(all, set.as_ref(), &feedback, &grid));
        if inputs.is_empty() {
            let found =
                format!("{}, none of which leaves room for the feedback in U", count(given_inputs, "input"));
            return Err(Diagnostic::at(
                "/input",
                found,
                "an input ū with ū − K (x − c) ∈ U for every x of a cell",
            )
            .remedy("Use smaller cells, a smaller gain or a larger U."));
        }
        let resolution = parts.resolution.map(|r| checked_resolution(r, n)).transpose()?;
        let noise = parts.noise.noise(n)?;
        let task = CheckedTask::new(&given(parts.task, "task")?, &grid, 1)?;
        let initial = parts.initial_state.map(|state| initial(state, &grid)).transpose()?;
        let coordinates = [parts.mode.states(), parts.mode.inputs()];
        let costs: Vec<Cost> =
            parts.costs.iter().map(|cost| cost.cost(coordinates)).collect::<Result<_, _>>()?;
        require_apart(&costs)?;
        let mut warnings = task.warnings;
        warnings.extend(noise.samples().iter().flat_map(|samples| samples.noise.warnings.iter().cloned()));
        if inputs.len() < given_inputs {
            let unused = given_inputs - inputs.len();
            warnings.push(Warning::UnusedInputs { unused, inputs: given_inputs });
        }
        Ok(Self {
            name: name(parts.name)?,
            mode: parts.mode,
            periodic: parts.periodic,
            set,
            inputs,
            feedback,
            grid,
            labels: task.labels,
            cell_task: task.cell_task,
            resolution,
            noise,
            objective: task.objective,
            unsafe_: task.unsafe_,
            horizon: task.horizon,
            threshold: task.threshold,
            initial,
            costs,
            warnings,
        })
    }

    /// The name of the model.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The dynamics of one step.
    pub fn mode(&self) -> &Mode {
        &self.mode
    }

    /// Which coordinates are periodic.
    pub fn periodic(&self) -> &[bool] {
        &self.periodic
    }

    /// The set of inputs, `U`, if one was given.
    pub fn set(&self) -> Option<&Polytope> {
        self.set.as_ref()
    }

    /// The nominal inputs to choose from.
    pub fn inputs(&self) -> &[Vec<Rational>] {
        &self.inputs
    }

    /// The feedback about the centers of cells.
    pub fn feedback(&self) -> &Feedback {
        &self.feedback
    }

    /// The partition.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// What the cells mean to the task.
    pub fn labels(&self) -> &CellLabels {
        &self.labels
    }

    /// How many sub-cells a cell has in each coordinate, if that was given.
    pub fn resolution(&self) -> Option<&[u32]> {
        self.resolution.as_deref()
    }

    /// The noise of one step.
    pub fn noise(&self) -> &InputNoise {
        &self.noise
    }

    /// What the memory of the task becomes in each cell.
    pub fn cell_task(&self) -> &CellTask {
        &self.cell_task
    }

    /// What is wanted.
    pub fn objective(&self) -> &Objective {
        &self.objective
    }

    /// The unsafe region.
    pub fn unsafe_regions(&self) -> &[Region] {
        &self.unsafe_
    }

    /// The number of steps, or `None` for an unbounded task.
    pub fn horizon(&self) -> Option<u64> {
        self.horizon
    }

    /// The probability that is wanted.
    pub fn threshold(&self) -> Option<&Probability> {
        self.threshold.as_ref()
    }

    /// The initial state, if one was given.
    pub fn initial_state(&self) -> Option<&[f64]> {
        self.initial.as_ref().map(|initial| initial.state.as_slice())
    }

    /// The cell of the initial state, if one was given.
    pub fn initial_cell(&self) -> Option<CellId> {
        self.initial.as_ref().map(|initial| initial.cell)
    }

    /// What steps cost.
    pub fn costs(&self) -> &[Cost] {
        &self.costs
    }

    /// What the user should know.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }
}

fn checked_resolution(resolution: Vec<u32>, n: usize) -> Result<Vec<u32>, Diagnostic> {
    let place = "/partition/resolution";
    if resolution.len() != n {
        let expected = format!("{n}, one per dimension of the state");
        return Err(Diagnostic::at(place, count(resolution.len(), "number"), expected));
    }
    match resolution.iter().position(|&r| r == 0 || r > FINEST) {
        None => Ok(resolution),
        Some(j) => {
            let expected = format!("from 1 to {FINEST} sub-cells a cell");
            Err(Diagnostic::at(format!("{place}/{j}"), resolution[j].to_string(), expected))
        }
    }
}

/// The inputs that are listed, or spanned over what the feedback leaves of a box.
fn candidates(
    choice: &InputChoice,
    set: Option<&InputSet>,
    feedback: &Feedback,
) -> Result<Vec<Vec<Rational>>, Diagnostic> {
    let p = feedback.gain().rows();
    match (choice, set) {
        (InputChoice::List(list), _) => {
            let place = |i| format!("/input/list/{i}");
            let exact = list.iter().enumerate().map(|(i, u)| vector(&place(i), u, p, "one per input"));
            let list: Vec<_> = exact.collect::<Result<_, _>>()?;
            if list.is_empty() {
                return Err(Diagnostic::at("/input/list", "an empty list", "at least one input"));
            }
            Ok(list)
        }
        (InputChoice::Grid(_), None) if p == 0 => Ok(vec![vec![]]),
        (InputChoice::Grid(points), Some(InputSet::Box { lower, upper })) => {
            if points.len() != p {
                let expected = format!("{p}, one per input");
                return Err(Diagnostic::at("/input/points", count(points.len(), "number"), expected));
            }
            let (lower, upper) = (
                vector("/input/lower", lower, p, "one per input")?,
                vector("/input/upper", upper, p, "one per input")?,
            );
            let margins = feedback.margins();
            let shifted = |ends: &[Rational], sign: i64| -> Vec<Rational> {
                let sign = Rational::from_integer(sign.into());
                ends.iter().zip(margins).map(|(end, margin)| end + margin * &sign).collect()
            };
            let (lower, upper) = (shifted(&lower, 1), shifted(&upper, -1));
            let all: u64 = points.iter().fold(1, |all: u64, &k| all.saturating_mul(k.into()));
            if all == 0 || all > MOST_INPUTS {
                let expected =
                    format!("at least one value of every input, at most {MOST_INPUTS} combinations");
                return Err(Diagnostic::at("/input/points", format!("{all} combinations"), expected));
            }
            let value = |i: usize, k: u64| match points[i] {
                1 => (&lower[i] + &upper[i]) / Rational::from_integer(2.into()),
                last => &lower[i] + (&upper[i] - &lower[i]) * Rational::new(k.into(), (last - 1).into()),
            };
            let combination = |mut index: u64| {
                let mut input = vec![Rational::zero(); p];
                for i in (0..p).rev() {
                    input[i] = value(i, index % u64::from(points[i]));
                    index /= u64::from(points[i]);
                }
                input
            };
            Ok((0..all).map(combination).collect())
        }
        (InputChoice::Grid(_), _) => {
            let found = if set.is_some() { "a polytope" } else { "no set" };
            Err(Diagnostic::at("/input", found, "a box {lower, upper} with points, or a list of inputs"))
        }
    }
}

/// Those whose feedback stays in `U` all over a cell: `G ū + |G K| w / 2 ≤ g`.
fn allowed(
    all: Vec<Vec<Rational>>,
    set: Option<&Polytope>,
    feedback: &Feedback,
    grid: &Grid,
) -> Vec<Vec<Rational>> {
    let Some(set) = set else { return all };
    let normals = set.normals();
    let spread = normals.times(feedback.gain());
    let two = Rational::from_integer(2.into());
    let margin = |row: usize| {
        let widths = grid.axes().iter().enumerate();
        widths.fold(Rational::zero(), |sum, (k, axis)| sum + spread.get(row, k).abs() * axis.width() / &two)
    };
    let room: Vec<Rational> =
        set.offsets().iter().enumerate().map(|(row, offset)| offset - margin(row)).collect();
    let fits = |input: &Vec<Rational>| {
        (0..normals.rows()).all(|row| {
            let sum =
                input.iter().enumerate().fold(Rational::zero(), |sum, (i, u)| sum + normals.get(row, i) * u);
            sum <= room[row]
        })
    };
    all.into_iter().filter(fits).collect()
}
