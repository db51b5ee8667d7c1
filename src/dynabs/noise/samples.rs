//! A table of noise samples.

use crate::system::LinearSystem;
use imdp::numeric::{UNIT_ROUNDOFF, rounding_factor};
use nalgebra::{DMatrix, DVector};

/// `N` samples of an `n`-dimensional noise, each with a bound on its rounding error.
///
/// Those that were read or drawn are finite. Sums of several steps may overflow: then the value is not finite, and its
/// error neither, which means that nothing is known of it.
#[derive(Clone, Debug, PartialEq)]
pub struct NoiseSamples {
    dimension: usize,
    /// Sample after sample.
    values: Vec<f64>,
    /// Like `values`: how far each can be from the number that it stands for. None if that is one rounding.
    errors: Option<Vec<f64>>,
}

/// One sample, and how exactly it is known.
#[derive(Clone, Copy, Debug)]
pub struct NoiseSample<'a> {
    values: &'a [f64],
    errors: Option<&'a [f64]>,
}

impl<'a> NoiseSample<'a> {
    /// Numbers that are exactly what they stand for.
    pub fn exact(values: &'a [f64]) -> Self {
        Self { values, errors: None }
    }

    /// The noise in dimension `j`.
    pub fn value(&self, j: usize) -> f64 {
        self.values[j]
    }

    /// How far that can be from the number that it stands for: by reading it, or by adding up several steps.
    pub fn error(&self, j: usize) -> f64 {
        self.errors.map_or(self.values[j].abs() * UNIT_ROUNDOFF, |errors| errors[j])
    }
}

impl NoiseSamples {
    /// The table with these values, sample after sample.
    pub fn new(dimension: usize, values: Vec<f64>) -> Self {
        assert!(dimension > 0 && values.len().is_multiple_of(dimension), "whole samples");
        Self { dimension, values, errors: None }
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

    /// All numbers, sample after sample.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The mean of every coordinate.
    pub fn mean(&self) -> Vec<f64> {
        let count = self.len().max(1) as f64;
        let sum = |j: usize| self.iter().map(|sample| sample[j]).sum::<f64>();
        (0..self.dimension).map(|j| sum(j) / count).collect()
    }

    /// The standard deviation of every coordinate.
    pub fn deviations(&self) -> Vec<f64> {
        let (count, mean) = (self.len().max(1) as f64, self.mean());
        let squares = |j: usize| self.iter().map(|sample| (sample[j] - mean[j]).powi(2)).sum::<f64>();
        (0..self.dimension).map(|j| (squares(j) / count).sqrt()).collect()
    }

    /// The samples, one after the other.
    pub fn iter(&self) -> impl Iterator<Item = &[f64]> {
        self.values.chunks_exact(self.dimension)
    }

    /// The samples with their errors, one after the other.
    pub fn measured(&self) -> impl Iterator<Item = NoiseSample<'_>> {
        (0..self.len()).map(|i| self.get(i))
    }

    /// Sample number `i`, counted from 0.
    pub fn sample(&self, i: usize) -> &[f64] {
        &self.values[i * self.dimension..(i + 1) * self.dimension]
    }

    /// Sample number `i`, counted from 0, with its error.
    pub fn get(&self, i: usize) -> NoiseSample<'_> {
        let own = i * self.dimension..(i + 1) * self.dimension;
        NoiseSample {
            values: &self.values[own.clone()],
            errors: self.errors.as_ref().map(|errors| &errors[own]),
        }
    }

    /// The noise so far after each of `d` steps: `ξ_i = Σ_{j<i} Aⁱ⁻¹⁻ʲ η_j` for `i = 1 … d`.
    ///
    /// From disjoint blocks of `d` consecutive samples of one step, so that the results are independent; what does
    /// not fill a block is dropped. The last table, `ξ_d`, is the noise of the grouped system.
    pub fn partial_sums(&self, system: &LinearSystem, d: usize) -> Vec<Self> {
        if d == 1 {
            return vec![self.clone()];
        }
        let n = self.dimension;
        let a = system.a().to_f64();
        let step = Recurrence { magnitude: a.abs(), a };
        let blocks = self.len() / d;
        let empty = || Self {
            dimension: n,
            values: Vec::with_capacity(blocks * n),
            errors: Some(Vec::with_capacity(blocks * n)),
        };
        let mut sums: Vec<Self> = (0..d).map(|_| empty()).collect();
        for block in self.values.chunks_exact(d * n) {
            let (mut sum, mut error) = (DVector::zeros(n), DVector::zeros(n));
            for (noise, table) in block.chunks_exact(n).zip(&mut sums) {
                (sum, error) = step.next(&sum, &error, &DVector::from_column_slice(noise));
                table.values.extend(sum.iter());
                table.errors.get_or_insert_default().extend(error.iter());
            }
        }
        sums
    }

    /// The noise of `d` steps together, from samples of one step: the last of the [partial sums](Self::partial_sums).
    pub fn grouped(&self, system: &LinearSystem, d: usize) -> Self {
        self.partial_sums(system, d).pop().unwrap_or_else(|| self.clone())
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

/// `ξ⁺ = A ξ + η` with a bound on the error.
struct Recurrence {
    a: DMatrix<f64>,
    magnitude: DMatrix<f64>,
}

impl Recurrence {
    fn next(
        &self,
        sum: &DVector<f64>,
        error: &DVector<f64>,
        noise: &DVector<f64>,
    ) -> (DVector<f64>, DVector<f64>) {
        let n = noise.len();
        let next = &self.a * sum + noise;
        // A was rounded, η read, and the sum has n + 1 terms.
        let rounding = (&self.magnitude * sum.abs() + noise.abs()) * rounding_factor(n + 3);
        let inherited = &self.magnitude * error;
        let total = (inherited + rounding) * (1.0 + rounding_factor(2 * n + 8));
        let known = |x: f64, error: f64| if x.is_finite() { error } else { f64::INFINITY };
        let errors = DVector::from_fn(n, |j, _| known(next[j], total[j]));
        (next, errors)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear_algebra::ExactMatrix;

    fn system(a: &[f64]) -> LinearSystem {
        let exact = |rows, columns, entries: &[f64]| {
            ExactMatrix::from_decimals(&DMatrix::from_row_slice(rows, columns, entries)).unwrap()
        };
        LinearSystem::new(exact(2, 2, a), exact(2, 1, &[0.5, 1.0]), exact(2, 1, &[0.0, 0.0]))
    }

    #[test]
    fn grouping_weights_earlier_noise_by_the_dynamics() {
        // A (1, 1) + (10, 20) = (13, 21); the fifth sample does not fill a block.
        let samples = NoiseSamples::new(2, vec![1.0, 1.0, 10.0, 20.0, 0.0, 1.0, 0.0, 0.0, 9.0, 9.0]);
        let sums = samples.partial_sums(&system(&[2.0, 1.0, 0.0, 1.0]), 2);
        assert_eq!(sums[0].iter().collect::<Vec<_>>(), [[1.0, 1.0], [0.0, 1.0]]);
        assert_eq!(sums[1].iter().collect::<Vec<_>>(), [[13.0, 21.0], [1.0, 1.0]]);
        assert_eq!(samples.grouped(&system(&[2.0, 1.0, 0.0, 1.0]), 2), sums[1]);
    }

    #[test]
    fn errors_are_those_of_each_sample() {
        let samples = NoiseSamples::new(2, vec![1e150, 0.0, 1e150, 0.0, 1.0, 1.0, 1.0, 1.0]);
        let grouped = samples.grouped(&system(&[2.0, 1.0, 0.0, 1.0]), 2);
        assert!(grouped.get(0).error(0) > 1e133 && grouped.get(1).error(0) < 1e-13);
    }

    #[test]
    fn nothing_is_known_of_what_overflows() {
        let samples = NoiseSamples::new(2, vec![1e300, 1e300, 1.0, 1.0, 1.0, 2.0, 3.0, 4.0]);
        let grouped = samples.grouped(&system(&[1e30, -1e30, 0.0, 1.0]), 2);
        assert!(!grouped.sample(0)[0].is_finite() && grouped.get(0).error(0) == f64::INFINITY);
        assert!(grouped.get(1).error(0).is_finite());
    }
}
