//! Eigenvalues in floating point, for hints: nothing is proven of them.

use nalgebra::{DMatrix, Schur};

/// Enough for any matrix that converges at all.
const MOST_ITERATIONS: usize = 10_000;

/// The eigenvalues `(re, im)` of a square matrix, row by row; none if they are not found.
pub fn eigenvalues(rows: &[Vec<f64>]) -> Option<Vec<(f64, f64)>> {
    let n = rows.len();
    if n == 0 || rows.iter().any(|row| row.len() != n || row.iter().any(|x| !x.is_finite())) {
        return None;
    }
    let matrix = DMatrix::from_fn(n, n, |i, j| rows[i][j]);
    let found = Schur::try_new(matrix, f64::EPSILON, MOST_ITERATIONS)?.complex_eigenvalues();
    let values: Vec<_> = found.iter().map(|z| (z.re, z.im)).collect();
    values.iter().all(|(re, im)| re.is_finite() && im.is_finite()).then_some(values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_matrices_have_known_ones() {
        assert_eq!(eigenvalues(&[vec![-0.5]]), Some(vec![(-0.5, 0.0)]));
        let oscillator = eigenvalues(&[vec![0.0, 1.0], vec![-4.0, 0.0]]).unwrap();
        assert!(oscillator.iter().all(|(re, im)| re.abs() < 1e-12 && (im.abs() - 2.0).abs() < 1e-12));
        assert_eq!(eigenvalues(&[vec![f64::NAN]]), None);
        assert_eq!(eigenvalues(&[]), None);
    }
}
