//! Whether a system of linear inequalities has a solution, in exact arithmetic.

use crate::linear_algebra::ExactMatrix;
use imdp::numeric::Rational;
use num_traits::{One, Signed, Zero};

/// A simplex dictionary: every basic variable as an affine function of the non-basic ones.
struct Dictionary {
    /// `rows[i] = [constant, coefficient of each non-basic variable …]`.
    rows: Vec<Vec<Rational>>,
    /// The variable that each row stands for.
    basic: Vec<usize>,
    /// The variable that each column stands for.
    nonbasic: Vec<usize>,
}

impl Dictionary {
    /// Exchanges the basic variable of `row` with the non-basic variable of `column` (counted from 0).
    fn pivot(&mut self, row: usize, column: usize) {
        let mut solved = std::mem::take(&mut self.rows[row]);
        let scale = -solved[column + 1].recip();
        solved[column + 1] = -Rational::one();
        for entry in &mut solved {
            *entry *= &scale;
        }
        for other in self.rows.iter_mut().filter(|other| !other.is_empty()) {
            let factor = std::mem::replace(&mut other[column + 1], Rational::zero());
            if !factor.is_zero() {
                for (entry, change) in other.iter_mut().zip(&solved) {
                    *entry += &factor * change;
                }
            }
        }
        self.rows[row] = solved;
        std::mem::swap(&mut self.basic[row], &mut self.nonbasic[column]);
    }
}

/// Whether some `x` satisfies `G x ≤ g`.
///
/// Phase one of the simplex method: minimise `t ≥ 0` subject to `G x − t ≤ g`; feasible iff the
/// optimum is 0. Bland's rule (*Math. of OR* 2, 1977) makes it terminate; rationals make it exact.
pub(super) fn is_feasible(normals: &ExactMatrix, offsets: &[Rational]) -> bool {
    let (m, p) = (normals.rows(), normals.columns());
    let Some(worst) = (0..m).min_by(|&i, &j| offsets[i].cmp(&offsets[j])) else { return true };
    if !offsets[worst].is_negative() {
        return true;
    }
    // Variables: t is 0, x = x⁺ − x⁻ are 1..=2p, the slack of row i is 2p + 1 + i.
    let rows = (0..m).map(|i| {
        let plus = (0..p).map(|j| -normals.get(i, j));
        let minus = (0..p).map(|j| normals.get(i, j).clone());
        [offsets[i].clone(), Rational::one()].into_iter().chain(plus).chain(minus).collect()
    });
    let mut dictionary = Dictionary {
        rows: rows.collect(),
        basic: (2 * p + 1..2 * p + 1 + m).collect(),
        nonbasic: (0..=2 * p).collect(),
    };
    dictionary.pivot(worst, 0);
    while let Some(objective) = dictionary.basic.iter().position(|&variable| variable == 0) {
        if dictionary.rows[objective][0].is_zero() {
            return true;
        }
        let entering = (0..dictionary.nonbasic.len())
            .filter(|&column| dictionary.rows[objective][column + 1].is_negative())
            .min_by_key(|&column| dictionary.nonbasic[column]);
        let Some(entering) = entering else { return false };
        let leaving =
            (0..m).filter(|&row| dictionary.rows[row][entering + 1].is_negative()).min_by_key(|&row| {
                let row_entries = &dictionary.rows[row];
                (-&row_entries[0] / &row_entries[entering + 1], dictionary.basic[row])
            });
        // `t` itself decreases, so some row always limits the step.
        let Some(leaving) = leaving else { return true };
        dictionary.pivot(leaving, entering);
    }
    true
}
