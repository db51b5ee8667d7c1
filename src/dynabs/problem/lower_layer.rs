//! The lower layer: linear feedback with an LQR gain or a given one, or a plan to follow.

use super::InputSet;
use super::tracking::{Tracking, TrackingLayer};
use super::values::{matrix, symmetric, vector};
use crate::Diagnostic;
use crate::Warning;
use crate::geometry::Polytope;
use crate::linear_algebra::{Definiteness, ExactMatrix};
use crate::partition::Grid;
use crate::system::{LinearSystem, Lqr, TwoLayer, decimal_gain, lower_layer_violation};
use nalgebra::DMatrix;

/// What is done without being asked, on the grouped system (`d·p` inputs); `u′` is left to the abstraction.
#[derive(Clone, Debug, PartialEq)]
pub enum LowerLayer {
    /// `u = −K (x − x̄) + u′`: the paper's.
    Feedback(FeedbackLayer),
    /// `u = u_plan(x) + u′`: in every cell the input that steers where a plan says.
    Tracking(TrackingLayer),
}

/// A lower layer `u = −K (x − x̄) + u′`.
#[derive(Clone, Debug, PartialEq)]
pub struct FeedbackLayer {
    /// `K`, or where it comes from.
    pub gain: Gain,
    /// `x̄`, the state to stabilise about; 0 if absent.
    pub about: Option<Vec<f64>>,
    /// `U′`, what is left to the abstraction; contains 0.
    pub abstract_input: InputSet,
}

/// Where the gain of a lower layer comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum Gain {
    /// From the weights of a linear-quadratic regulator.
    Lqr(LqrWeights),
    /// It is this matrix, `(d·p)×n`.
    Given(Vec<Vec<f64>>),
}

/// The weights of a linear-quadratic regulator for the grouped system.
#[derive(Clone, Debug, PartialEq)]
pub struct LqrWeights {
    /// `Q`, `n×n`, symmetric positive definite.
    pub q: Vec<Vec<f64>>,
    /// `R`, `(d·p)×(d·p)`, symmetric positive definite.
    pub r: Vec<Vec<f64>>,
    /// Rounds the gain to this many decimals, at most 300; not at all if absent.
    pub decimals: Option<u32>,
}

/// A lower layer that fits its problem.
#[derive(Clone, Debug)]
pub enum Stabilizer {
    /// Linear feedback.
    Feedback(Box<LinearStabilizer>),
    /// A plan to follow.
    Tracking(Tracking),
}

/// A two-layer design and how its gain was found.
#[derive(Clone, Debug)]
pub struct LinearStabilizer {
    /// The closed loop.
    pub layers: TwoLayer,
    /// The relative residual of the Riccati equation, if the gain is an LQR gain.
    pub riccati_residual: Option<f64>,
    /// What the user should know.
    pub warnings: Vec<Warning>,
}

impl Stabilizer {
    /// Builds a lower layer for the grouped `system` with inputs `input`.
    pub(super) fn new(
        layer: &LowerLayer,
        system: &LinearSystem,
        input: &Polytope,
        grid: &Grid,
    ) -> Result<Self, Diagnostic> {
        match layer {
            LowerLayer::Feedback(layer) => {
                linear(layer, system, input, grid).map(|layer| Self::Feedback(Box::new(layer)))
            }
            LowerLayer::Tracking(layer) => Tracking::new(layer, input, grid).map(Self::Tracking),
        }
    }

    /// The linear feedback, if that is what it is.
    pub fn feedback(&self) -> Option<&LinearStabilizer> {
        match self {
            Self::Feedback(feedback) => Some(feedback),
            Self::Tracking(_) => None,
        }
    }

    /// The plan to follow, if that is what it does.
    pub fn tracking(&self) -> Option<&Tracking> {
        match self {
            Self::Feedback(_) => None,
            Self::Tracking(tracking) => Some(tracking),
        }
    }

    /// What the user should know.
    pub fn warnings(&self) -> &[Warning] {
        self.feedback().map_or(&[], |feedback| &feedback.warnings)
    }
}

fn linear(
    layer: &FeedbackLayer,
    system: &LinearSystem,
    input: &Polytope,
    grid: &Grid,
) -> Result<LinearStabilizer, Diagnostic> {
    let (n, p) = (system.state_dimension(), system.input_dimension());
    let remedy = "Shift U′, or stabilise about another state with /stabilizer/about.";
    let abstract_input = layer.abstract_input.around_zero("/stabilizer/abstract_input", p, remedy)?;
    let (gain, riccati_residual) = match &layer.gain {
        Gain::Lqr(weights) => {
            let (a, b) = (system.a().to_f64(), system.b().to_f64());
            let (gain, residual) = lqr_gain("/stabilizer/lqr", weights, &a, &b)?;
            (gain, Some(residual))
        }
        Gain::Given(gain) => {
            let what = "(d·p)×n for d grouped steps, p inputs and n states";
            (matrix("/stabilizer/gain", gain, Some(p), Some(n), what)?, None)
        }
    };
    let about = match &layer.about {
        None => ExactMatrix::zeros(n, 1),
        Some(about) => {
            let about = vector("/stabilizer/about", about, n, "one per dimension of the state")?;
            ExactMatrix::from_fn(n, 1, |i, _| about[i].clone())
        }
    };
    let layers = TwoLayer::new(system, gain, about, abstract_input);
    if !layers.closed_loop().is_regular() {
        return Err(Diagnostic::at(
            "/stabilizer",
            "a gain with singular A − BK",
            "a non-singular closed loop",
        )
        .remedy("Change the gain or the weights a little."));
    }
    let warnings = warnings(&layers, input, grid);
    Ok(LinearStabilizer { layers, riccati_residual, warnings })
}

/// The gain for `A` (`n×n`) and `B` (`n×p`) with the weights at `place`, and its residual.
pub(super) fn lqr_gain(
    place: &str,
    weights: &LqrWeights,
    a: &DMatrix<f64>,
    b: &DMatrix<f64>,
) -> Result<(ExactMatrix, f64), Diagnostic> {
    let (n, p) = (a.nrows(), b.ncols());
    let definite = |field: &str, values: &[Vec<f64>], size, what| {
        let place = &format!("{place}/{field}");
        let weight = symmetric(place, values, size, what)?;
        match weight.definiteness() {
            Definiteness::PositiveDefinite => Ok(weight.to_f64()),
            Definiteness::PositiveSemidefinite => {
                Err(Diagnostic::at(place, "a singular matrix", "a positive definite matrix")
                    .remedy("Add a small multiple of the identity."))
            }
            Definiteness::Indefinite => {
                Err(Diagnostic::at(place, "a matrix with a negative direction", "a positive definite matrix")
                    .remedy("Weights penalise: check the signs and sizes of the entries."))
            }
        }
    };
    let q = definite("Q", &weights.q, n, "n×n for n states")?;
    let r = definite("R", &weights.r, p, "(d·p)×(d·p) for d grouped steps and p inputs")?;
    let failed = |found: String| {
        Diagnostic::at(place, found, "weights for which the Riccati equation can be solved")
            .remedy("Bring the entries of Q and R closer together in size.")
    };
    let lqr = Lqr::solve(a, b, &q, &r).map_err(|error| failed(error.to_string()))?;
    if let Some(decimals) = weights.decimals.filter(|&decimals| decimals > 300) {
        return Err(Diagnostic::at(format!("{place}/decimals"), decimals.to_string(), "at most 300"));
    }
    let gain = decimal_gain(&lqr.gain, weights.decimals)
        .ok_or_else(|| failed("a gain that is not finite".into()))?;
    Ok((gain, lqr.residual))
}

fn warnings(layers: &TwoLayer, input: &Polytope, grid: &Grid) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let radius = layers.eigenvalues().first().map_or(0.0, |(re, im)| re.hypot(*im));
    if radius >= 1.0 {
        warnings.push(Warning::Unstable { radius });
    }
    let lower: Vec<_> = grid.axes().iter().map(|axis| axis.lower().clone()).collect();
    let upper: Vec<_> = grid.axes().iter().map(|axis| axis.upper().clone()).collect();
    if let Some((worst, offset)) = lower_layer_violation(layers, input, &lower, &upper) {
        warnings.push(Warning::GainLeavesInput { worst, offset });
    }
    warnings
}
