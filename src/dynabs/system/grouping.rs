//! Several steps seen as one (ECC 2024, Section II).

use super::LinearSystem;
use crate::linear_algebra::ExactMatrix;

/// `d` steps of `system` as one step.
///
/// `Â = Aᵈ`, `B̂ = [Aᵈ⁻¹B … AB B]` (`n×dp`, the first input leftmost), `q̂ = Σ_{i<d} Aⁱ q`. The noise of the
/// grouped system is `η̂ = Σ_{i<d} Aᵈ⁻¹⁻ⁱ η_i`, its inputs are the `d` inputs in order. All exact.
pub fn group(system: &LinearSystem, d: usize) -> LinearSystem {
    let n = system.state_dimension();
    let mut power = ExactMatrix::identity(n);
    let mut b = ExactMatrix::zeros(n, 0);
    let mut q = ExactMatrix::zeros(n, 1);
    for _ in 0..d {
        b = power.times(system.b()).beside(&b);
        q = q.plus(&power.times(system.q()));
        power = power.times(system.a());
    }
    LinearSystem::new(power, b, q)
}

/// The smallest `d` that makes `B̂` of full row rank; `None` iff `(A, B)` is not controllable.
pub fn smallest_group(system: &LinearSystem) -> Option<usize> {
    let n = system.state_dimension();
    (1..=n).find(|&d| system.grouped_rank(d) == n)
}

/// The matrices of grouped steps have too many digits to compute with them exactly.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "numbers of up to {digits} digits after {steps} steps; expected numbers that can be computed with exactly"
)]
pub struct TooManyDigits {
    /// How many digits they have.
    pub digits: u64,
    /// How many steps are grouped.
    pub steps: usize,
}

/// Fails if inverting the matrices of `d` grouped steps exactly would take too long.
///
/// `n³` products of numbers of `n` times as many bits as the entries have, each quadratic in them.
///
/// # Errors
/// [`TooManyDigits`] with the number of digits.
pub fn require_digits(system: &LinearSystem, d: usize) -> Result<(), TooManyDigits> {
    const MOST: f64 = 1e10;
    let n = system.state_dimension() as f64;
    let bits = d as u64 * system.a().bits() + system.b().bits().max(system.q().bits());
    if n.powi(5) * (bits as f64).powi(2) <= MOST {
        return Ok(());
    }
    Err(TooManyDigits { digits: (bits as f64 * std::f64::consts::LOG10_2) as u64, steps: d })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;

    fn exact(rows: usize, columns: usize, entries: &[f64]) -> ExactMatrix {
        ExactMatrix::from_decimals(&DMatrix::from_row_slice(rows, columns, entries)).unwrap()
    }

    #[test]
    fn double_integrator_of_the_paper() {
        let system = LinearSystem::new(
            exact(2, 2, &[2.0, 1.0, 0.0, 1.0]),
            exact(2, 1, &[0.5, 1.0]),
            exact(2, 1, &[0.1, 0.2]),
        );
        assert_eq!(smallest_group(&system), Some(2));
        let grouped = group(&system, 2);
        assert_eq!(*grouped.a(), exact(2, 2, &[4.0, 3.0, 0.0, 1.0]));
        assert_eq!(*grouped.b(), exact(2, 2, &[2.0, 0.5, 1.0, 1.0]));
        assert_eq!(*grouped.q(), exact(2, 1, &[0.5, 0.4]));
    }

    #[test]
    fn uncontrollable_pairs_have_no_group() {
        let system =
            LinearSystem::new(ExactMatrix::identity(2), exact(2, 1, &[1.0, 1.0]), ExactMatrix::zeros(2, 1));
        assert_eq!(smallest_group(&system), None);
        assert_eq!(system.controllability_rank(), 1);
    }
}
