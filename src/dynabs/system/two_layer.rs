//! The two-layer control design (ECC 2024, Section III).

use super::LinearSystem;
use crate::geometry::Polytope;
use crate::linear_algebra::ExactMatrix;
use nalgebra::DMatrix;

/// A stabilising lower layer `u = −K (x − x̄) + u′`, leaving `u′ ∈ U′` to the abstraction.
///
/// The closed loop is `x⁺ = A_cl x + B u′ + q_cl + η` with `A_cl = A − BK` and `q_cl = q + BKx̄`.
#[derive(Clone, Debug)]
pub struct TwoLayer {
    gain: ExactMatrix,
    about: ExactMatrix,
    abstract_input: Polytope,
    closed_loop: LinearSystem,
}

impl TwoLayer {
    /// Closes the loop of `system` (`n` states, `p` inputs) with `K` (`p×n`) about `x̄` (`n×1`).
    ///
    /// The gain counts as the exact decimals that print it.
    pub fn new(
        system: &LinearSystem,
        gain: ExactMatrix,
        about: ExactMatrix,
        abstract_input: Polytope,
    ) -> Self {
        let feedback = system.b().times(&gain);
        let closed_loop = LinearSystem::new(
            system.a().minus(&feedback),
            system.b().clone(),
            system.q().plus(&feedback.times(&about)),
        );
        Self { gain, about, abstract_input, closed_loop }
    }

    /// `K`, `p×n`.
    pub fn gain(&self) -> &ExactMatrix {
        &self.gain
    }

    /// `x̄`, `n×1`.
    pub fn about(&self) -> &ExactMatrix {
        &self.about
    }

    /// `U′`, the inputs left to the abstraction.
    pub fn abstract_input(&self) -> &Polytope {
        &self.abstract_input
    }

    /// `x⁺ = A_cl x + B u′ + q_cl + η`.
    pub fn closed_loop(&self) -> &LinearSystem {
        &self.closed_loop
    }

    /// The eigenvalues `(re, im)` of `A_cl`, largest modulus first.
    pub fn eigenvalues(&self) -> Vec<(f64, f64)> {
        let matrix: DMatrix<f64> = self.closed_loop.a().to_f64();
        let mut values: Vec<_> = matrix.complex_eigenvalues().iter().map(|z| (z.re, z.im)).collect();
        values.sort_by(|(a, b), (c, d)| c.hypot(*d).total_cmp(&a.hypot(*b)).then(d.total_cmp(b)));
        values
    }
}
