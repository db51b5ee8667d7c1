//! Linear differential equations over one step, by the matrix exponential with a bounded remainder.

use crate::linear_algebra::ExactMatrix;
use crate::system::expression::{Graph, NodeId};
use crate::system::{Interval, LinearSystem, Mode, Variable};
use imdp::numeric::{Rational, to_f64, to_f64_up};
use num_traits::{One, Signed, Zero};

/// A matrix known up to an error of at most `error` in every entry.
#[derive(Clone, Debug)]
struct NearMatrix {
    center: ExactMatrix,
    error: Rational,
}

/// `x⁺ = A_d x + B_d u + q_d`, what `ẋ = A x + B u + q` does in a time `T` while `u` is held:
/// `A_d = e^{AT}`, `[B_d q_d] = ∫₀ᵀ e^{As} ds [B q]`, every entry enclosed.
#[derive(Clone, Debug)]
pub struct SampledLinear {
    entries: NearMatrix,
    states: usize,
    inputs: usize,
}

/// Why a system cannot be sampled.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SamplingError {
    /// The step is too long for the dynamics.
    #[error("‖A‖T = {norm:.0}; expected at most {limit}", limit = LARGEST_NORM)]
    TooLong {
        /// `‖A‖_∞ T`.
        norm: f64,
    },
}

/// The largest `‖M‖` of which an exponential is taken: its series is summed as it stands.
const LARGEST_NORM: f64 = 40.0;
/// What a series may leave out.
const SMALLEST: f64 = 1e-40;

impl SampledLinear {
    /// The step of length `time` of the system, which is in continuous time.
    ///
    /// # Errors
    /// [`SamplingError`] if the step is too long.
    pub fn new(system: &LinearSystem, time: &Rational) -> Result<Self, SamplingError> {
        let (n, p) = (system.state_dimension(), system.input_dimension());
        // exp([A B q; 0 0 0] T) = [A_d B_d q_d; 0 I] (Van Loan 1978).
        let all = system.a().beside(system.b()).beside(system.q());
        let block = ExactMatrix::from_fn(n + p + 1, n + p + 1, |i, j| {
            if i < n { all.get(i, j) * time } else { Rational::zero() }
        });
        Ok(Self { entries: exponential(&block)?, states: n, inputs: p })
    }

    /// Whether all entries are known exactly, as for integrators.
    pub fn is_exact(&self) -> bool {
        self.entries.error.is_zero()
    }

    /// An enclosure of the entry in row `i` and column `j` of `[A_d B_d q_d]`.
    pub fn entry(&self, i: usize, j: usize) -> Interval {
        self.entries.interval(i, j)
    }

    /// The mode with these entries.
    pub fn mode(&self, states: Vec<Variable>, inputs: Vec<Variable>) -> Mode {
        let columns = self.states + self.inputs;
        let mut graph = Graph::default();
        let factor = |graph: &mut Graph, i: usize, j: usize| match self.is_exact() {
            true => graph.constant(self.entries.center.get(i, j).clone()),
            false => graph.enclosed(self.entry(i, j)),
        };
        let row = |i: usize| {
            let mut sum = factor(&mut graph, i, columns);
            for j in 0..columns {
                let (factor, variable) = (factor(&mut graph, i, j), graph.variable(j as u32));
                let term = graph.multiply(factor, variable);
                sum = graph.add(sum, term);
            }
            sum
        };
        let next: Vec<NodeId> = (0..self.states).map(row).collect();
        Mode::new(graph, next, states, inputs, Vec::new())
    }
}

impl NearMatrix {
    fn interval(&self, i: usize, j: usize) -> Interval {
        let entry = self.center.get(i, j);
        Interval::enclosing(&(entry - &self.error), &(entry + &self.error))
    }
}

/// `e^M` by its series: after the term of degree `K`, what is left out is at most
/// `‖M‖^{K+1}/(K+1)! / (1 − ‖M‖/(K+2))` in every entry.
fn exponential(m: &ExactMatrix) -> Result<NearMatrix, SamplingError> {
    let n = m.rows();
    let row_sum = |i: usize| (0..n).fold(Rational::zero(), |sum, j| sum + m.get(i, j).abs());
    let norm = (0..n).map(row_sum).max().unwrap_or_default();
    if to_f64(&norm) > LARGEST_NORM {
        return Err(SamplingError::TooLong { norm: to_f64(&norm) });
    }
    // An upper bound of the norm with few digits keeps the bounds short.
    let norm = Rational::from_float(to_f64_up(&norm)).unwrap_or(norm);
    let (mut term, mut sum) = (ExactMatrix::identity(n), ExactMatrix::identity(n));
    let mut bound = to_f64_up(&norm);
    for degree in 1u32.. {
        let divisor = Rational::from_integer(degree.into());
        let product = term.times(m);
        term = ExactMatrix::from_fn(n, n, |i, j| product.get(i, j) / &divisor);
        if term.entries().iter().all(Zero::is_zero) {
            return Ok(NearMatrix { center: sum, error: Rational::zero() });
        }
        sum = sum.plus(&term);
        // Now `bound` is at least ‖M‖^{K+1}/(K+1)! for K = degree.
        bound = (bound * to_f64_up(&norm) / f64::from(degree + 1)).next_up().next_up();
        let ratio = to_f64_up(&norm) / f64::from(degree + 2);
        if bound < SMALLEST && ratio < 0.5 {
            // 1/(1 − ratio) < 2.
            let error = Rational::from_float(2.0 * bound).unwrap_or_else(Rational::one);
            return Ok(NearMatrix { center: sum, error });
        }
    }
    Err(SamplingError::TooLong { norm: to_f64(&norm) })
}
