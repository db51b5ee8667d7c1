//! Infinite-horizon discrete-time LQR by a structure-preserving doubling algorithm.

use nalgebra::{DMatrix, DVector};

/// A stabilising LQR gain and the evidence for it.
#[derive(Clone, Debug)]
pub struct Lqr {
    /// `K = (R + BᵀPB)⁻¹ BᵀPA`, `p×n`, for `u = −K x`.
    pub gain: DMatrix<f64>,
    /// `P`, the stabilising solution of the Riccati equation, `n×n`.
    pub cost: DMatrix<f64>,
    /// `‖AᵀPA − P − AᵀPB(R + BᵀPB)⁻¹BᵀPA + Q‖_F / ‖P‖_F`: how well `P` solves its equation.
    pub residual: f64,
}

/// Why no LQR gain was found.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum RiccatiError {
    /// The iteration did not settle.
    #[error("the Riccati iteration did not converge (relative residual {residual:.1e})")]
    NotConverged {
        /// The relative residual when it was given up.
        residual: f64,
    },
    /// The solution found does not stabilise the system.
    #[error("the closed loop A − BK has spectral radius {radius}, not below 1")]
    NotStabilising {
        /// The spectral radius of `A − BK`.
        radius: f64,
    },
}

/// The largest relative residual that is accepted as a solution.
const ACCEPTED_RESIDUAL: f64 = 1e-9;
/// Doubling converges quadratically: 60 doublings are 2⁶⁰ steps of the plain iteration.
const MAX_DOUBLINGS: usize = 60;
/// Each refinement squares the error until rounding stops it.
const MAX_REFINEMENTS: usize = 3;

impl Lqr {
    /// The gain that minimises `Σ xᵀQx + uᵀRu` for `x⁺ = A x + B u`, with `Q` and `R` positive definite.
    ///
    /// Doubling (Chu, Fan, Lin, Wang, *Int. J. Control* 77, 2004):
    /// `A⁺ = A W A`, `G⁺ = G + A W G Aᵀ`, `H⁺ = H + Aᵀ H W A` with `W = (I + G H)⁻¹`, from `G = B R⁻¹ Bᵀ`,
    /// `H = Q`; `H` converges quadratically to `P`. Shapes: `A` `n×n`, `B` `n×p`, `Q` `n×n`, `R` `p×p`.
    ///
    /// # Errors
    /// [`RiccatiError`] if the iteration does not converge or `A − BK` is not stable.
    pub fn solve(
        a: &DMatrix<f64>,
        b: &DMatrix<f64>,
        q: &DMatrix<f64>,
        r: &DMatrix<f64>,
    ) -> Result<Self, RiccatiError> {
        let failed = RiccatiError::NotConverged { residual: f64::INFINITY };
        let n = a.nrows();
        let mut transition = a.clone();
        let mut input = b * r.clone().lu().solve(&b.transpose()).ok_or(failed)?;
        let mut cost = q.clone();
        for _ in 0..MAX_DOUBLINGS {
            let lu = (DMatrix::identity(n, n) + &input * &cost).lu();
            let w_a = lu.solve(&transition).ok_or(failed)?;
            let w_g = lu.solve(&input).ok_or(failed)?;
            let step = transition.transpose() * &cost * &w_a;
            input += &transition * w_g * transition.transpose();
            transition = &transition * w_a;
            cost += &step;
            symmetrise(&mut input);
            symmetrise(&mut cost);
            if step.norm() <= f64::EPSILON * cost.norm() || !cost.norm().is_finite() {
                break;
            }
        }
        let mut gain = optimal_gain(a, b, r, &cost).ok_or(failed)?;
        let mut residual = residual(a, b, q, &cost, &gain);
        for _ in 0..MAX_REFINEMENTS {
            let refined = closed_loop_cost(&(a - b * &gain), &(q + gain.transpose() * r * &gain));
            let Some(refined_gain) = optimal_gain(a, b, r, &refined) else { break };
            let refined_residual = self::residual(a, b, q, &refined, &refined_gain);
            if refined_residual.is_nan() || refined_residual >= residual {
                break;
            }
            (cost, gain, residual) = (refined, refined_gain, refined_residual);
        }
        if residual.is_nan() || residual > ACCEPTED_RESIDUAL {
            return Err(RiccatiError::NotConverged { residual });
        }
        let radius = spectral_radius(&(a - b * &gain));
        if radius >= 1.0 {
            return Err(RiccatiError::NotStabilising { radius });
        }
        Ok(Self { gain, cost, residual })
    }
}

/// The largest modulus of an eigenvalue of a square matrix.
pub fn spectral_radius(m: &DMatrix<f64>) -> f64 {
    let eigenvalues: DVector<_> = m.complex_eigenvalues();
    eigenvalues.iter().map(|z| z.re.hypot(z.im)).fold(0.0, f64::max)
}

fn optimal_gain(
    a: &DMatrix<f64>,
    b: &DMatrix<f64>,
    r: &DMatrix<f64>,
    cost: &DMatrix<f64>,
) -> Option<DMatrix<f64>> {
    let weighted = b.transpose() * cost;
    (r + &weighted * b).lu().solve(&(weighted * a))
}

/// `Σ_k (Aᵀ)ᵏ W Aᵏ`: the cost of the closed loop `A` with weight `W`, by doubling (Smith, *SIAM J. Appl.
/// Math.* 16, 1968). One step of Newton's method for the Riccati equation (Kleinman, *IEEE TAC* 13, 1968).
fn closed_loop_cost(closed_loop: &DMatrix<f64>, weight: &DMatrix<f64>) -> DMatrix<f64> {
    let mut power = closed_loop.clone();
    let mut cost = weight.clone();
    for _ in 0..MAX_DOUBLINGS {
        let step = power.transpose() * &cost * &power;
        cost += &step;
        if step.norm() <= f64::EPSILON * cost.norm() || !cost.norm().is_finite() {
            break;
        }
        power = &power * &power;
    }
    symmetrise(&mut cost);
    cost
}

fn residual(
    a: &DMatrix<f64>,
    b: &DMatrix<f64>,
    q: &DMatrix<f64>,
    cost: &DMatrix<f64>,
    gain: &DMatrix<f64>,
) -> f64 {
    let next = a.transpose() * cost * (a - b * gain) + q;
    (next - cost).norm() / cost.norm()
}

fn symmetrise(m: &mut DMatrix<f64>) {
    *m = (&*m + m.transpose()) * 0.5;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scalar_riccati_equation() {
        // a = b = q = r = 1: P² = P + 1, so P is the golden ratio and K = 1 / P.
        let one = DMatrix::from_element(1, 1, 1.0);
        let lqr = Lqr::solve(&one, &one, &one, &one).unwrap();
        let golden = (1.0 + 5f64.sqrt()) / 2.0;
        assert!((lqr.cost[(0, 0)] - golden).abs() < 1e-14);
        assert!((lqr.gain[(0, 0)] - 1.0 / golden).abs() < 1e-14);
        assert!(lqr.residual < 1e-14);
    }

    #[test]
    fn an_unstabilisable_pair_is_refused() {
        let a = DMatrix::from_row_slice(2, 2, &[2.0, 0.0, 0.0, 0.5]);
        let b = DMatrix::from_row_slice(2, 1, &[0.0, 1.0]);
        assert!(Lqr::solve(&a, &b, &DMatrix::identity(2, 2), &DMatrix::identity(1, 1)).is_err());
    }
}
