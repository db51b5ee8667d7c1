//! The feedback law in doubles, in one fixed order of operations.

use crate::system::FeedbackLaw;
use nalgebra::DMatrix;

/// `u = c + M d + N x`, row by row and from left to right: what the generated C code computes too.
///
/// Each sum has `2n + 1` terms, the number of roundings that [`FeedbackLaw::constraints`] allows for, so an
/// enabled action stays in `U` with all its rounding errors.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct InputLaw {
    /// `M`, `dp×n`, row by row.
    pub(super) target_gain: Vec<f64>,
    /// `N`, `dp×n`, row by row.
    pub(super) state_gain: Vec<f64>,
    /// `c`, `dp` entries.
    pub(super) constant: Vec<f64>,
}

impl InputLaw {
    pub(super) fn new(law: &FeedbackLaw) -> Self {
        Self {
            target_gain: by_rows(&law.target_gain()),
            state_gain: by_rows(&law.state_gain()),
            constant: by_rows(&law.constant()),
        }
    }

    /// The inputs of one group of steps in the order of time, written to `u`.
    pub(super) fn evaluate(&self, target: &[f64], x: &[f64], u: &mut [f64]) {
        let n = x.len();
        for (i, u) in u.iter_mut().enumerate() {
            let row = i * n..(i + 1) * n;
            let by_target = self.target_gain[row.clone()].iter().zip(target);
            let by_state = self.state_gain[row].iter().zip(x);
            *u = by_target.chain(by_state).fold(self.constant[i], |sum, (gain, value)| sum + gain * value);
        }
    }
}

/// The entries of a matrix, row by row.
pub(super) fn by_rows(m: &DMatrix<f64>) -> Vec<f64> {
    m.row_iter().flat_map(|row| row.iter().copied().collect::<Vec<_>>()).collect()
}
