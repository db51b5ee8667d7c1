//! Where the state is after some of the steps of a group.

use super::law::{AffineMap, absolute_product};
use super::{Extent, FeedbackLaw, LinearSystem, group};
use crate::linear_algebra::ExactMatrix;
use imdp::numeric::{UNIT_ROUNDOFF, rounding_factor, to_f64};
use nalgebra::DMatrix;

/// The state after `i` steps of a group but for the noise so far: `x_i = T d + S x + r` for target `d` and first state `x`.
///
/// With the inputs `u = M d + N x + c` of the law: `T = B̂_i M_i`, `S = Aⁱ + B̂_i N_i`, `r = B̂_i c_i + q̂_i`, where
/// `B̂_i = [Aⁱ⁻¹B … B]` and `M_i`, `N_i`, `c_i` are the rows of the first `i` inputs. In exact rationals, rounded once.
#[derive(Clone, Debug)]
pub struct PartialImage {
    /// `T`, `n×n`.
    pub target: DMatrix<f64>,
    /// `S`, `n×n`.
    pub state: DMatrix<f64>,
    /// `r`, `n` entries.
    pub constant: Vec<f64>,
    /// Per dimension, how far `T d + S x + r`, evaluated in doubles in any order, can be from the state that the inputs
    /// computed in doubles lead to, for all states and targets of the extent.
    pub error: Vec<f64>,
}

impl FeedbackLaw {
    /// The state after the first `steps` steps of a group, `step` being the system of one step.
    pub fn partial_image(&self, step: &LinearSystem, steps: usize, extent: &Extent) -> PartialImage {
        let partial = group(step, steps);
        let (n, inputs) = (partial.state_dimension(), partial.input_dimension());
        let first = |m: &ExactMatrix| ExactMatrix::from_fn(inputs, m.columns(), |i, j| m.get(i, j).clone());
        let law = AffineMap {
            target: first(&self.input.target),
            state: first(&self.input.state),
            constant: first(&self.input.constant),
        };
        let image = AffineMap {
            target: partial.b().times(&law.target),
            state: partial.a().plus(&partial.b().times(&law.state)),
            constant: partial.b().times(&law.constant).plus(partial.q()),
        };
        let of_input = law.evaluation_error(extent);
        // Coefficients, target, state and every operation are rounded.
        let factor = rounding_factor(2 * n + 6);
        let error = |(j, magnitude): (usize, f64)| {
            (factor * magnitude + absolute_product(partial.b(), j, &of_input)) * (1.0 + 64.0 * UNIT_ROUNDOFF)
        };
        PartialImage {
            target: image.target.to_f64(),
            state: image.state.to_f64(),
            constant: (0..n).map(|j| to_f64(image.constant.get(j, 0))).collect(),
            error: image.magnitudes(extent).into_iter().enumerate().map(error).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Polytope;
    use crate::system::Demands;

    #[test]
    fn halfway_to_the_target() {
        let exact = |rows, columns, entries: &[f64]| {
            ExactMatrix::from_decimals(&DMatrix::from_row_slice(rows, columns, entries)).unwrap()
        };
        // Position and velocity: u₀ = (d₁ − x₁) − (3 x₂ + d₂) / 2 and u₁ = d₂ − x₂ − u₀.
        let step = LinearSystem::new(
            exact(2, 2, &[1.0, 1.0, 0.0, 1.0]),
            exact(2, 1, &[0.5, 1.0]),
            exact(2, 1, &[0.25, 0.0]),
        );
        let law =
            FeedbackLaw::new(&group(&step, 2), &Polytope::from_box(&[], &[]), None, &Demands::default())
                .unwrap();
        let extent = Extent { state: vec![10.0, 2.0], target: vec![10.0, 2.0] };
        let image = law.partial_image(&step, 1, &extent);
        let (x, d) = ([3.0, 1.0], [7.0, -1.0]);
        let u = (d[0] - 0.5 - x[0]) - (3.0 * x[1] + d[1]) / 2.0;
        let expected = [x[0] + x[1] + 0.5 * u + 0.25, x[1] + u];
        for j in 0..2 {
            let at = |m: &DMatrix<f64>, v: [f64; 2]| m[(j, 0)] * v[0] + m[(j, 1)] * v[1];
            let state = at(&image.target, d) + at(&image.state, x) + image.constant[j];
            assert!((state - expected[j]).abs() <= image.error[j], "{state} {expected:?}");
            assert!(image.error[j] < 1e-13);
        }
    }
}
