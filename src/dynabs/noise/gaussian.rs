//! Gaussian noise in a reproducible stream.

use super::NoiseSamples;
use crate::linear_algebra::ExactMatrix;
use imdp::numeric::to_f64;
use nalgebra::{DMatrix, DVector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha12Rng;
use rand_distr::{Distribution, StandardNormal};

/// The normal distribution `N(μ, Σ)`, `Σ` positive semidefinite.
#[derive(Clone, Debug)]
pub struct Gaussian {
    mean: DVector<f64>,
    /// `F` with `Σ = F Fᵀ`, lower triangular.
    factor: DMatrix<f64>,
}

impl Gaussian {
    /// `N(mean, covariance)` with `mean` `n×1` and `covariance` `n×n`; `None` if the latter is indefinite, or its factor
    /// leaves the range of doubles.
    pub fn new(mean: &[f64], covariance: &ExactMatrix) -> Option<Self> {
        let factors = covariance.ldl()?;
        let deviations: Vec<_> = factors.diagonal.iter().map(|d| to_f64(d).sqrt()).collect();
        let factor = factors.lower.to_f64() * DMatrix::from_diagonal(&DVector::from_vec(deviations));
        factor.iter().all(|x| x.is_finite()).then(|| Self { mean: DVector::from_column_slice(mean), factor })
    }

    /// The dimension of the noise.
    pub fn dimension(&self) -> usize {
        self.mean.len()
    }

    /// The mean, `n` numbers.
    pub fn mean(&self) -> &[f64] {
        self.mean.as_slice()
    }

    /// Draws one sample, `n` numbers.
    pub fn draw(&self, rng: &mut impl Rng, sample: &mut [f64]) {
        sample.iter_mut().for_each(|z| *z = StandardNormal.sample(rng));
        // From the last entry up, those that are still needed are still there: F is lower triangular.
        for i in (0..sample.len()).rev() {
            let sum = (0..=i).fold(0.0, |sum, j| sum + self.factor[(i, j)] * sample[j]);
            sample[i] = self.mean[i] + sum;
        }
    }

    /// `count` independent samples: the same for the same seed, on every machine.
    ///
    /// ChaCha with 12 rounds; the seed is expanded as `rand`'s `seed_from_u64` does.
    pub fn sample(&self, count: usize, seed: u64) -> NoiseSamples {
        let mut rng = ChaCha12Rng::seed_from_u64(seed);
        let n = self.mean.len();
        let mut values = vec![0.0; count * n];
        values.chunks_exact_mut(n).for_each(|sample| self.draw(&mut rng, sample));
        NoiseSamples::new(n, values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;

    #[test]
    fn moments_and_reproducibility() {
        let covariance = DMatrix::from_row_slice(2, 2, &[6.0, 1.0, 1.0, 2.0]);
        let gaussian =
            Gaussian::new(&[1.0, -2.0], &ExactMatrix::from_decimals(&covariance).unwrap()).unwrap();
        let samples = gaussian.sample(200_000, 7);
        assert_eq!(samples, gaussian.sample(200_000, 7));
        assert_ne!(samples, gaussian.sample(200_000, 8));
        let count = samples.len() as f64;
        let mean = |f: &dyn Fn(&[f64]) -> f64| samples.iter().map(f).sum::<f64>() / count;
        assert!((mean(&|s| s[0]) - 1.0).abs() < 0.03 && (mean(&|s| s[1]) + 2.0).abs() < 0.02);
        assert!((mean(&|s| (s[0] - 1.0).powi(2)) - 6.0).abs() < 0.12);
        assert!((mean(&|s| (s[0] - 1.0) * (s[1] + 2.0)) - 1.0).abs() < 0.06);
    }

    #[test]
    fn a_factor_beyond_doubles_is_none() {
        // The factor of the second column by the first is 1e-8 / 5e-324.
        let covariance = DMatrix::from_row_slice(2, 2, &[5e-324, 1e-8, 1e-8, 1e308]);
        assert!(Gaussian::new(&[0.0; 2], &ExactMatrix::from_decimals(&covariance).unwrap()).is_none());
    }

    #[test]
    fn degenerate_covariances_are_fine() {
        let covariance = DMatrix::from_row_slice(2, 2, &[0.0, 0.0, 0.0, 0.01]);
        let gaussian = Gaussian::new(&[3.0, 0.0], &ExactMatrix::from_decimals(&covariance).unwrap()).unwrap();
        assert!(gaussian.sample(100, 1).iter().all(|s| s[0] == 3.0));
    }
}
