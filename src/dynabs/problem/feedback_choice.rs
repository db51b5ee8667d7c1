//! Where the gain of local feedback comes from.

use super::InputSet;
use super::lower_layer::{LqrWeights, lqr_gain};
use super::values::matrix;
use crate::Diagnostic;
use crate::linear_algebra::ExactMatrix;
use crate::partition::Grid;
use crate::system::{Feedback, Mode, decimal_gain, narrowing_gain};
use imdp::numeric::to_f64;

/// The local feedback `u = ū − K (x − c)` about the center `c` of the cell.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum FeedbackChoice {
    /// No feedback.
    #[default]
    None,
    /// `K` itself, `p×n`.
    Gain(Vec<Vec<f64>>),
    /// `K` of a linear-quadratic regulator for the dynamics, linearised at the center of the partition.
    Lqr(LqrWeights),
    /// `K` that makes images small and uses at most this share of the width of `U`, which must be a box.
    Narrow(f64),
}

/// Gains that are chosen keep this many decimals of their largest entry.
const DECIMALS: i32 = 4;

impl FeedbackChoice {
    /// The feedback for a mode on the cells of a grid.
    pub(super) fn feedback(
        &self,
        mode: &Mode,
        grid: &Grid,
        set: Option<&InputSet>,
    ) -> Result<Feedback, Diagnostic> {
        let (n, p) = (mode.num_states(), mode.num_inputs());
        let linearised = || {
            let middle = |lower: f64, upper: f64| lower / 2.0 + upper / 2.0;
            let x: Vec<f64> =
                grid.axes().iter().map(|axis| middle(to_f64(axis.lower()), to_f64(axis.upper()))).collect();
            let u = match set {
                Some(InputSet::Box { lower, upper }) => {
                    lower.iter().zip(upper).map(|(&lower, &upper)| middle(lower, upper)).collect()
                }
                _ => vec![0.0; p],
            };
            mode.linearised(&x, &u)
        };
        let gain = match self {
            Self::None => ExactMatrix::zeros(p, n),
            Self::Gain(gain) => {
                matrix("/feedback/gain", gain, Some(p), Some(n), "p×n for p inputs and n states")?
            }
            Self::Lqr(weights) => {
                let (a, b) = linearised();
                lqr_gain("/feedback/lqr", weights, &a, &b)?.0
            }
            Self::Narrow(share) => narrow(*share, mode, grid, set, &linearised())?,
        };
        Ok(Feedback::new(gain, grid))
    }
}

fn narrow(
    share: f64,
    mode: &Mode,
    grid: &Grid,
    set: Option<&InputSet>,
    (a, b): &(nalgebra::DMatrix<f64>, nalgebra::DMatrix<f64>),
) -> Result<ExactMatrix, Diagnostic> {
    let place = "/feedback/narrow";
    if !(0.0..=1.0).contains(&share) {
        return Err(Diagnostic::at(place, share.to_string(), "the share of U's width to use, from 0 to 1"));
    }
    let Some(InputSet::Box { lower, upper }) = set else {
        return Err(Diagnostic::at(place, "inputs that are no box", "a box {lower, upper} at /input")
            .remedy("Give the gain itself."));
    };
    let widths: Vec<f64> = grid.axes().iter().map(|axis| to_f64(axis.width())).collect();
    let budget: Vec<f64> =
        lower.iter().zip(upper).map(|(lower, upper)| share * (upper - lower) / 2.0).collect();
    let finite = |m: &nalgebra::DMatrix<f64>| m.iter().all(|entry| entry.is_finite());
    if budget.len() != mode.num_inputs() || !finite(a) || !finite(b) {
        let expected =
            "dynamics with a derivative at the center of the partition, and one interval per input";
        return Err(Diagnostic::at(place, "no such derivative, or another number of inputs", expected));
    }
    let mut gain = narrowing_gain(a, b, &widths, &budget);
    let largest = gain.iter().fold(0.0f64, |largest, entry| largest.max(entry.abs()));
    if largest > 0.0 {
        // Towards 0, so that no row uses more than its share.
        let unit = 10f64.powi(largest.log10().floor() as i32 - DECIMALS + 1);
        gain.apply(|entry| *entry = (*entry / unit).trunc() * unit);
    }
    let places = (DECIMALS - 1 - largest.max(1e-300).log10().floor() as i32).clamp(0, 300);
    decimal_gain(&gain, Some(places as u32))
        .ok_or_else(|| Diagnostic::at(place, "a gain that is not finite", "dynamics with moderate entries"))
}
