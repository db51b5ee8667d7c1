//! Local feedback about the center of a cell.

use crate::linear_algebra::ExactMatrix;
use crate::partition::Grid;
use imdp::numeric::{Rational, to_f64};
use num_traits::{Signed, Zero};

/// The input `u = ū − K (x − c)` in the cell with center `c`, for every nominal input `ū`.
///
/// A gain that contracts the cell makes images small. `K` is `p×n`, in exact decimals.
#[derive(Clone, Debug, PartialEq)]
pub struct Feedback {
    gain: ExactMatrix,
    nearest: Vec<f64>,
    margins: Vec<Rational>,
}

impl Feedback {
    /// No feedback: `K = 0` for `p` inputs and the states of `grid`.
    pub fn none(inputs: usize, grid: &Grid) -> Self {
        Self::new(ExactMatrix::zeros(inputs, grid.dimension()), grid)
    }

    /// The feedback with gain `K` on the cells of `grid`.
    pub fn new(gain: ExactMatrix, grid: &Grid) -> Self {
        let two = Rational::from_integer(2.into());
        let margin = |i: usize| {
            grid.axes()
                .iter()
                .enumerate()
                .fold(Rational::zero(), |sum, (k, axis)| sum + gain.get(i, k).abs() * axis.width() / &two)
        };
        Self {
            margins: (0..gain.rows()).map(margin).collect(),
            nearest: gain.entries().iter().map(to_f64).collect(),
            gain,
        }
    }

    /// `K`, `p×n`.
    pub fn gain(&self) -> &ExactMatrix {
        &self.gain
    }

    /// `max |u_i − ū_i| = Σ_k |K_ik| w_k / 2` over a cell of widths `w`, the same in all cells: `ū` is enabled iff
    /// `ū + Π [−margin_i, margin_i]`, or for a polytope what `K` makes of the cell, lies in `U`.
    pub fn margins(&self) -> &[Rational] {
        &self.margins
    }

    /// `K` in doubles, row by row: what [`input`](Self::input) computes with.
    pub fn nearest_gain(&self) -> &[f64] {
        &self.nearest
    }

    /// Whether `K = 0`.
    pub fn is_none(&self) -> bool {
        self.gain.entries().iter().all(Zero::is_zero)
    }

    /// `u = ū − K (x − c)`, in doubles, term by term from left to right.
    pub fn input(&self, nominal: &[f64], x: &[f64], center: &[f64], u: &mut [f64]) {
        let n = x.len();
        for (i, u) in u.iter_mut().enumerate() {
            let gains = &self.nearest[i * n..(i + 1) * n];
            *u = gains
                .iter()
                .zip(x.iter().zip(center))
                .fold(nominal[i], |u, (gain, (x, c))| u - gain * (x - c));
        }
    }
}
