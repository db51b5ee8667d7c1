//! A table of noise samples.

use crate::linear_algebra::ExactMatrix;
use crate::system::LinearSystem;
use imdp::numeric::{UNIT_ROUNDOFF, rounding_factor};
use nalgebra::{DMatrix, DVector};

/// `N` samples of an `n`-dimensional noise, all finite.
#[derive(Clone, Debug, PartialEq)]
pub struct NoiseSamples {
    dimension: usize,
    /// Sample after sample.
    values: Vec<f64>,
    /// Per dimension, how far a value can be from the number it stands for.
    rounding: Vec<f64>,
}

impl NoiseSamples {
    /// The table with these values, sample after sample.
    pub fn new(dimension: usize, values: Vec<f64>) -> Self {
        assert!(dimension > 0 && values.len().is_multiple_of(dimension), "whole samples");
        let mut samples = Self { dimension, values, rounding: vec![] };
        let reading = |magnitude| magnitude * UNIT_ROUNDOFF;
        samples.rounding = samples.magnitudes().into_iter().map(reading).collect();
        samples
    }

    /// Per dimension, a bound on the rounding error of the values: of reading them, or of grouping them.
    pub fn rounding(&self) -> &[f64] {
        &self.rounding
    }

    /// The dimension `n` of the noise.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The number `N` of samples.
    pub fn len(&self) -> usize {
        self.values.len() / self.dimension
    }

    /// Whether there are no samples.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// The samples, one after the other.
    pub fn iter(&self) -> impl Iterator<Item = &[f64]> {
        self.values.chunks_exact(self.dimension)
    }

    /// Sample number `i`, counted from 0.
    pub fn sample(&self, i: usize) -> &[f64] {
        &self.values[i * self.dimension..(i + 1) * self.dimension]
    }

    /// `max |δ_j|` over all samples, per dimension.
    pub fn magnitudes(&self) -> Vec<f64> {
        let mut magnitudes = vec![0.0f64; self.dimension];
        for sample in self.iter() {
            for (magnitude, value) in magnitudes.iter_mut().zip(sample) {
                *magnitude = magnitude.max(value.abs());
            }
        }
        magnitudes
    }

    /// Samples of the noise of `d` steps from samples of one step: `η̂ = Σ_{i<d} Aᵈ⁻¹⁻ⁱ η_i`.
    ///
    /// Disjoint blocks of `d` consecutive samples, so that the results are independent; what does not
    /// fill a block is dropped.
    pub fn grouped(&self, system: &LinearSystem, d: usize) -> Self {
        if d == 1 {
            return self.clone();
        }
        let mut power = ExactMatrix::identity(self.dimension);
        let mut powers: Vec<DMatrix<f64>> = Vec::with_capacity(d);
        for _ in 0..d {
            powers.push(power.to_f64());
            power = power.times(system.a());
        }
        let blocks = self.values.chunks_exact(d * self.dimension);
        let values = blocks.flat_map(|block| {
            let steps = block.chunks_exact(self.dimension);
            let zero = DVector::zeros(self.dimension);
            let sum = steps
                .enumerate()
                .fold(zero, |sum, (i, step)| sum + &powers[d - 1 - i] * DVector::from_column_slice(step));
            sum.iter().copied().collect::<Vec<f64>>()
        });
        let mut grouped = Self::new(self.dimension, values.collect());
        let magnitudes = DVector::from_vec(self.magnitudes());
        let sums: DVector<f64> = powers.iter().map(|power| power.abs() * &magnitudes).sum();
        let factor = rounding_factor(d * (self.dimension + 2));
        grouped.rounding = sums.iter().map(|sum| factor * sum).collect();
        grouped
    }

    /// The table as CSV, one sample a line, each number in the shortest form that reads back the same.
    pub fn to_csv(&self) -> String {
        let line = |sample: &[f64]| {
            let numbers: Vec<_> = sample.iter().map(|&x| imdp::numeric::shortest_decimal(x)).collect();
            numbers.join(",") + "\n"
        };
        self.iter().map(line).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grouping_weights_earlier_noise_by_the_dynamics() {
        let exact = |rows, columns, entries: &[f64]| {
            ExactMatrix::from_decimals(&DMatrix::from_row_slice(rows, columns, entries)).unwrap()
        };
        let system = LinearSystem::new(
            exact(2, 2, &[2.0, 1.0, 0.0, 1.0]),
            exact(2, 1, &[0.5, 1.0]),
            exact(2, 1, &[0.0, 0.0]),
        );
        // A (1, 1) + (10, 20) = (13, 21); the fifth sample does not fill a block.
        let samples = NoiseSamples::new(2, vec![1.0, 1.0, 10.0, 20.0, 0.0, 1.0, 0.0, 0.0, 9.0, 9.0]);
        let grouped = samples.grouped(&system, 2);
        assert_eq!(grouped.iter().collect::<Vec<_>>(), [[13.0, 21.0], [1.0, 1.0]]);
    }
}
