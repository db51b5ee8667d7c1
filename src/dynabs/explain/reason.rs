//! Reasons, as numbers and in words.

use crate::system::GroupingTrial;
use serde::Serialize;
use std::fmt;

/// Why a bound is what it is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Explanation {
    /// The bound.
    pub bound: f64,
    /// The reasons, the first to be looked at first.
    pub reasons: Vec<Reason>,
}

/// One reason.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "reason")]
pub enum Reason {
    /// No initial state is given: the bound is for the worst cell.
    NoStart {
        /// In how many ordinary cells nothing is enabled.
        idle: usize,
        /// How many ordinary cells there are.
        ordinary: usize,
        /// The bound in the best cell.
        best: f64,
    },
    /// The initial state is in an unsafe cell.
    UnsafeStart,
    /// Nothing is enabled in the cell of the initial state.
    NothingAtStart {
        /// In how many ordinary cells nothing is enabled.
        idle: usize,
        /// How many ordinary cells there are.
        ordinary: usize,
        /// What numbers of grouped steps could do.
        grouping: Vec<GroupingTrial>,
    },
    /// No input is enabled in the cell of the initial state, where actions are inputs.
    NoInputAtStart {
        /// In how many ordinary cells none is.
        idle: usize,
        /// How many ordinary cells there are.
        ordinary: usize,
    },
    /// How far the bounds are apart, where actions are inputs.
    Between {
        /// What is promised.
        lower: f64,
        /// What no controller with these inputs exceeds.
        upper: f64,
        /// How many samples of the noise there are; none if it is known.
        samples: Option<usize>,
    },
    /// The bounds if there were no noise, where actions are inputs.
    WithoutNoise {
        /// What would be promised.
        lower: f64,
        /// What no controller with these inputs would exceed.
        upper: f64,
    },
    /// What changes of the model would bring, where actions are inputs.
    Trials {
        /// The changes, one field each.
        trials: Vec<Trial>,
    },
    /// Without any noise the goal is too far away.
    TooFar {
        /// The grouped steps that it takes from target to target; none if it cannot be reached.
        steps: Option<u64>,
        /// How many there are.
        horizon: Option<u64>,
        /// How many cells can be come to.
        visited: usize,
        /// How many ordinary cells there are.
        ordinary: usize,
    },
    /// The samples are too few.
    Samples {
        /// The value with all probabilities in the middle of their intervals.
        exact: f64,
        /// How many samples there are.
        samples: usize,
        /// About how many would bring the bound within 0.01 of that.
        needed: Option<u64>,
    },
    /// Where simulated runs end that do not succeed.
    Losses {
        /// The share of runs that succeed.
        simulated: f64,
        /// How the others end.
        losses: Vec<Loss>,
    },
    /// How far noise reaches.
    Noise {
        /// Per dimension.
        spreads: Vec<Spread>,
    },
}

/// What one change of a model would bring.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Trial {
    /// The change in words.
    pub what: String,
    /// The field and its value, as `--set` takes them.
    pub change: String,
    /// What would be promised.
    pub lower: f64,
    /// What no controller with these inputs would exceed.
    pub upper: f64,
    /// How many pairs of a cell and an input there would be.
    pub pairs: u64,
}

/// How often runs end in one way.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Loss {
    /// How: where they end.
    pub end: String,
    /// The share of all runs.
    pub share: f64,
}

/// How far noise reaches in one dimension.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// The standard deviation of one grouped step, in cells.
    pub deviation: f64,
    /// How many cells there are.
    pub cells: u32,
}

impl fmt::Display for Explanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "why the bound is {:.6}:", self.bound)?;
        self.reasons.iter().try_for_each(|reason| writeln!(f, "- {reason}"))
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoStart { idle, ordinary, best } => write!(
                f,
                "start: no /initial_state is given, so the bound is for the worst cell; in {idle} of {ordinary} cells nothing is \
                 enabled; in the best cell it is {best:.6}. Give the state that matters"
            ),
            Self::UnsafeStart => f.write_str(
                "start: the cell of the initial state meets an unsafe region. Move /initial_state, or cut /partition so that faces of \
                 /task/unsafe are faces of cells",
            ),
            Self::NothingAtStart { idle, ordinary, grouping } => {
                write!(
                    f,
                    "enabled: nothing in the cell of the initial state, as in {idle} of {ordinary} cells"
                )?;
                write!(f, "{}", GroupingTable(grouping))?;
                f.write_str("\n  Shrink cells or enlarge /input by the factor, group more steps (/dynamics/group_steps), or place /targets where the start can be steered to")
            }
            Self::NoInputAtStart { idle, ordinary } => write!(
                f,
                "enabled: no input in the cell of the initial state, as in {idle} of {ordinary} cells. Enlarge /input, shrink cells, or \
                 use less /feedback"
            ),
            Self::Between { lower, upper, samples } => between(f, *lower, *upper, *samples),
            Self::WithoutNoise { lower, upper } => match (*lower > SURE, *upper > 0.0) {
                (true, _) => f.write_str("reach: without noise it is done for certain"),
                (false, true) => write!(
                    f,
                    "reach: without noise {lower:.6} would be promised and at most {upper:.6} be possible, so images of cells are too large. \
                     Use more /partition/cells, or /feedback"
                ),
                (false, false) => f.write_str(
                    "reach: without noise no controller with these inputs does it. Raise /task/horizon, enlarge /input, give it more \
                     values, or look for walls in /task/unsafe",
                ),
            },
            Self::Trials { trials } => {
                f.write_str("changes, one at a time:")?;
                trials.iter().try_for_each(|trial| {
                    let Trial { what, change, lower, upper, pairs } = trial;
                    write!(f, "\n    {what}: {lower:.6}, at most {upper:.6}, {pairs} pairs of cell and input (--set '{change}')")
                })
            }
            Self::TooFar { steps: Some(steps), horizon, .. } => {
                let given = horizon.map_or("no".to_owned(), |horizon| horizon.to_string());
                write!(f, "reach: without noise the goal is {steps} grouped steps away, and there are {given}. Raise /task/horizon or enlarge /input")
            }
            Self::TooFar { steps: None, visited, ordinary, .. } => write!(
                f,
                "reach: without noise no chain of targets leads from the start to the goal; it comes to {visited} of {ordinary} cells. \
                 Enlarge /input, shrink cells, group another number of steps (/dynamics/group_steps), or look for walls in /task/unsafe"
            ),
            Self::Samples { exact, samples, needed } => {
                write!(
                    f,
                    "samples: with frequencies taken for probabilities the value would be {exact:.4}; {samples} samples do not prove that"
                )?;
                match needed {
                    Some(needed) => write!(f, ", about {needed} would come within 0.01. Raise /noise/count, or measure more"),
                    None => f.write_str(", and 400 times as many would not come within 0.01"),
                }
            }
            Self::Losses { simulated, losses } => {
                write!(f, "runs: {:.1} % of simulated runs succeed", 100.0 * simulated)?;
                losses.iter().try_for_each(|loss| write!(f, "; {:.1} % {}", 100.0 * loss.share, loss.end))
            }
            Self::Noise { spreads } => {
                f.write_str("noise: its standard deviation in one step is")?;
                for (j, spread) in spreads.iter().enumerate() {
                    let and = if j == 0 { "" } else { "," };
                    write!(f, "{and} {:.2} of {} cells in x{}", spread.deviation, spread.cells, j + 1)?;
                }
                if spreads.iter().any(|spread| spread.deviation * 6.0 > f64::from(spread.cells)) {
                    f.write_str(": too much for this partition. Enlarge /partition")?;
                }
                Ok(())
            }
        }
    }
}

/// Where it is as good as certain.
const SURE: f64 = 0.999;

/// What the distance between two bounds says.
fn between(f: &mut fmt::Formatter<'_>, lower: f64, upper: f64, samples: Option<usize>) -> fmt::Result {
    let (impossible, open) = (1.0 - upper, upper - lower);
    write!(
        f,
        "bounds: {lower:.6} is promised and no controller with these inputs exceeds {upper:.6}: {impossible:.6} is lost to noise and \
         inputs whatever the cells, {open:.6} is open"
    )?;
    match (samples, impossible > open) {
        (_, true) => f.write_str(". Enlarge /input or raise /task/horizon; finer cells bring less than that"),
        (Some(samples), false) => {
            write!(
                f,
                ": cells, lattice or {samples} samples. Measure more, use fewer cells, or see what changes bring"
            )
        }
        (None, false) => f.write_str(": cells and lattice. See what changes bring"),
    }
}

impl fmt::Display for GroupingTrial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let input = self.input + 1;
        write!(f, "{} steps: ", self.steps)?;
        if self.share > 1.0 {
            return write!(f, "the states of a cell take {:.4} times the range of input {input}", self.share);
        }
        write!(f, "the states of a cell take {:.0} % of the range of input {input}", 100.0 * self.share)?;
        if self.leaves_start == Some(false) {
            f.write_str("; nothing is enabled at the start")?;
        }
        if self.meets_goal == Some(false) {
            f.write_str("; nothing that steers into the goal is enabled")?;
        }
        Ok(())
    }
}

/// The first and the last lines of a table of numbers of steps.
pub struct GroupingTable<'a>(pub &'a [GroupingTrial]);

/// So many lines are shown at either end.
const LINES: usize = 3;

impl fmt::Display for GroupingTable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let trials = self.0;
        let (first, last) = match trials.len() > 2 * LINES {
            true => (&trials[..LINES], &trials[trials.len() - LINES..]),
            false => (trials, &trials[..0]),
        };
        first.iter().try_for_each(|trial| write!(f, "\n    {trial}"))?;
        if !last.is_empty() {
            f.write_str("\n    …")?;
        }
        last.iter().try_for_each(|trial| write!(f, "\n    {trial}"))
    }
}
