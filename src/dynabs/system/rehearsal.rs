//! Trying a law on states that it may have to keep, to find a better one.

use super::{Demands, LinearSystem, Shares};
use nalgebra::{DMatrix, DVector};

/// What rounding may change; more than that is a difference.
const TOLERANCE: f64 = 1e-9;

/// A system with inputs scaled to `[−1, 1]` and states to cells, and what may be demanded of it.
pub(super) struct Rehearsal {
    a: DMatrix<f64>,
    b: DMatrix<f64>,
    /// What the inputs in the middle of their ranges have to be changed by: `B ũ = r`, with weights.
    demands: Vec<(DVector<f64>, f64)>,
}

impl Rehearsal {
    /// For the inputs with these middles and half widths.
    pub(super) fn new(system: &LinearSystem, (middle, half): (&[f64], &[f64]), demands: &Demands) -> Self {
        let (a, b, q) = (system.a().to_f64(), system.b().to_f64(), system.q().to_f64());
        let cell = &demands.cell;
        let drift = &b * DVector::from_column_slice(middle) + q.column(0);
        let needs = demands.holds.iter().map(|(x, weight)| {
            let x = DVector::from_column_slice(x);
            let need = &x - &a * &x - &drift;
            (DVector::from_fn(x.len(), |j, _| need[j] / cell[j]), *weight)
        });
        Self {
            demands: needs.collect(),
            a: DMatrix::from_fn(a.nrows(), a.ncols(), |j, k| a[(j, k)] * cell[k] / cell[j]),
            b: DMatrix::from_fn(b.nrows(), b.ncols(), |j, i| b[(j, i)] * half[i] / cell[j]),
        }
    }

    /// Equal shares about the middle, unless others clearly meet more.
    pub(super) fn best(&self) -> Shares {
        Shares::even(self.b.ncols()).improved(|shares| Some(self.worth(shares)))
    }

    /// The weight of all demands that are met, less a little for what is missing at the others: the way uphill.
    fn worth(&self, Shares { weights, shifts }: &Shares) -> f64 {
        let (n, p) = self.b.shape();
        let weighted = DMatrix::from_fn(p, n, |i, j| weights[i] * self.b[(j, i)]);
        let Some(inverse) = (&self.b * &weighted).try_inverse() else { return f64::NEG_INFINITY };
        let right_inverse = weighted * inverse;
        let of_cell = &right_inverse * &self.a;
        let shift = DVector::from_column_slice(shifts);
        let offset = &shift - &right_inverse * (&self.b * &shift);
        let taken: Vec<f64> = (0..p).map(|i| of_cell.row(i).iter().map(|gain| gain.abs()).sum()).collect();
        self.demands.iter().fold(0.0, |sum, (demand, weight)| {
            let input = &right_inverse * demand + &offset;
            let beyond = (0..p).map(|i| input[i].abs() + taken[i] - 1.0).fold(0.0, f64::max);
            sum + weight * if beyond <= TOLERANCE { 1.0 } else { -1e-3 * beyond.min(1.0) }
        })
    }
}
