//! The system of one step in doubles.

use crate::controller::law::by_rows;
use crate::system::LinearSystem;

/// `x⁺ = A x + B u + q + η` of one original step.
#[derive(Clone, Debug)]
pub struct Plant {
    a: Vec<f64>,
    b: Vec<f64>,
    q: Vec<f64>,
    inputs: usize,
}

impl Plant {
    /// The plant of a system.
    pub fn new(system: &LinearSystem) -> Self {
        let [a, b, q] = [system.a(), system.b(), system.q()].map(|m| by_rows(&m.to_f64()));
        Self { a, b, q, inputs: system.input_dimension() }
    }

    /// One step from `x` (`n`) with input `u` (`p`) and noise (`n`), written to `next` (`n`).
    pub fn step(&self, x: &[f64], u: &[f64], noise: &[f64], next: &mut [f64]) {
        let n = x.len();
        let product = |row: &[f64], v: &[f64]| row.iter().zip(v).map(|(m, v)| m * v).sum::<f64>();
        for (i, next) in next.iter_mut().enumerate() {
            let by_state = product(&self.a[i * n..(i + 1) * n], x);
            let by_input = product(&self.b[i * self.inputs..(i + 1) * self.inputs], u);
            *next = by_state + by_input + self.q[i] + noise[i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear_algebra::ExactMatrix;
    use nalgebra::DMatrix;

    #[test]
    fn one_step() {
        let exact = |columns, entries: &[f64]| {
            ExactMatrix::from_decimals(&DMatrix::from_row_slice(2, columns, entries)).unwrap()
        };
        let system =
            LinearSystem::new(exact(2, &[2.0, 1.0, 0.0, 1.0]), exact(1, &[0.5, 1.0]), exact(1, &[8.0, 16.0]));
        let mut next = [0.0; 2];
        Plant::new(&system).step(&[1.0, 3.0], &[2.0], &[100.0, 200.0], &mut next);
        assert_eq!(next, [2.0 + 3.0 + 1.0 + 8.0 + 100.0, 3.0 + 2.0 + 16.0 + 200.0]);
    }
}
