//! From a state and an action to an input, in doubles, in one fixed order of operations.

use crate::partition::{CellId, CellLookup, Grid};
use crate::system::{Feedback, FeedbackLaw, Mode, Variable};
use nalgebra::DMatrix;

/// The law of the actions.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Law {
    /// Actions are targets.
    Steering(SteeringLaw),
    /// Actions are inputs.
    Centered(CenteredLaw),
}

/// `u = c + M d + N x`, row by row and from left to right: what the generated C code computes too.
///
/// Each sum has `2n + 1` terms, the number of roundings that [`FeedbackLaw::constraints`] allows for, so an
/// enabled action stays in `U` with all its rounding errors.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SteeringLaw {
    /// `M`, `dp×n`, row by row.
    pub(super) target_gain: Vec<f64>,
    /// `N`, `dp×n`, row by row.
    pub(super) state_gain: Vec<f64>,
    /// `c`, `dp` entries.
    pub(super) constant: Vec<f64>,
    /// The targets `d`, one after the other, `n` numbers each.
    pub(super) points: Vec<f64>,
}

/// `u = ū − K (x − c)` in the cell with center `c`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CenteredLaw {
    /// The nominal inputs `ū`, one after the other, `p` numbers each.
    pub(super) nominal: Vec<f64>,
    /// `p`.
    pub(super) inputs: usize,
    /// What the numbers of `x` and `u` are.
    pub(super) coordinates: [Vec<Variable>; 2],
    pub(super) feedback: Feedback,
    /// Per coordinate, the centers of the cells.
    pub(super) centers: Vec<Vec<f64>>,
}

impl Law {
    /// The number of inputs decided at once.
    pub(super) fn inputs(&self) -> usize {
        match self {
            Self::Steering(law) => law.constant.len(),
            Self::Centered(law) => law.inputs,
        }
    }

    /// The target that an action steers to, or its nominal input, in a state of `n` numbers.
    pub(super) fn action(&self, action: u32, n: usize) -> &[f64] {
        let (all, width) = match self {
            Self::Steering(law) => (&law.points, n),
            Self::Centered(law) => (&law.nominal, law.inputs),
        };
        &all[action as usize * width..(action as usize + 1) * width]
    }

    /// The inputs of an action in a state of a cell, those of the first step first, written to `u`.
    pub(super) fn evaluate(
        &self,
        action: u32,
        (cell, lookup): (CellId, &CellLookup),
        x: &[f64],
        u: &mut [f64],
    ) {
        let numbers = self.action(action, x.len());
        match self {
            Self::Steering(law) => law.evaluate(numbers, x, u),
            Self::Centered(law) => law.feedback.input(numbers, x, &law.center(cell, lookup), u),
        }
    }
}

impl SteeringLaw {
    pub(super) fn new(law: &FeedbackLaw, points: Vec<f64>) -> Self {
        Self {
            target_gain: by_rows(&law.target_gain()),
            state_gain: by_rows(&law.state_gain()),
            constant: by_rows(&law.constant()),
            points,
        }
    }

    fn evaluate(&self, target: &[f64], x: &[f64], u: &mut [f64]) {
        let n = x.len();
        for (i, u) in u.iter_mut().enumerate() {
            let row = i * n..(i + 1) * n;
            let by_target = self.target_gain[row.clone()].iter().zip(target);
            let by_state = self.state_gain[row].iter().zip(x);
            *u = by_target.chain(by_state).fold(self.constant[i], |sum, (gain, value)| sum + gain * value);
        }
    }
}

impl CenteredLaw {
    pub(super) fn new(nominal: Vec<f64>, mode: &Mode, feedback: Feedback, grid: &Grid) -> Self {
        let centers = grid.axes().iter().map(|axis| axis.centers()).collect();
        let coordinates = [mode.states().to_vec(), mode.inputs().to_vec()];
        Self { nominal, inputs: mode.num_inputs(), coordinates, feedback, centers }
    }

    /// What the numbers of `x` and `u` are, in words.
    pub(super) fn words(&self) -> String {
        let named = |all: &[Variable]| {
            let one = |v: &Variable| match &v.unit {
                Some(unit) => format!("{} in {unit}", v.name),
                None => v.name.clone(),
            };
            all.iter().map(one).collect::<Vec<_>>().join(", ")
        };
        let [x, u] = &self.coordinates;
        let input = if u.is_empty() { String::new() } else { format!("; u = ({})", named(u)) };
        format!("x = ({}){input}.", named(x))
    }

    fn center(&self, cell: CellId, lookup: &CellLookup) -> Vec<f64> {
        let center =
            |(centers, stride): (&Vec<f64>, &u32)| centers[(cell.0 / stride) as usize % centers.len()];
        self.centers.iter().zip(lookup.strides()).map(center).collect()
    }
}

/// The entries of a matrix, row by row.
pub(super) fn by_rows(m: &DMatrix<f64>) -> Vec<f64> {
    m.row_iter().flat_map(|row| row.iter().copied().collect::<Vec<_>>()).collect()
}
