//! Linear programs over `{x : G x ≤ g}`, in exact arithmetic.

use crate::linear_algebra::ExactMatrix;
use imdp::numeric::Rational;
use num_traits::{One, Signed, Zero};

/// The variable that phase one makes as small as possible: `G x − t ≤ g`.
const SHORTAGE: usize = 0;

/// A simplex dictionary: every basic variable as an affine function of the non-basic ones, which are 0.
///
/// Bland's rule (*Math. of OR* 2, 1977) makes every search terminate; rationals make it exact.
struct Dictionary {
    /// `rows[i] = [constant, coefficient of each non-basic variable …]`: first the variables that may not become
    /// negative, one per half-space; then the coordinates of `x`.
    rows: Vec<Vec<Rational>>,
    /// The variable that each row stands for.
    basic: Vec<usize>,
    /// The variable that each column stands for.
    nonbasic: Vec<usize>,
    /// How many rows are of variables that may not become negative.
    half_spaces: usize,
}

impl Dictionary {
    /// Variables: `t` is 0, `x = x⁺ − x⁻` are `1..=2p`, the slack of row `i` is `2p + 1 + i`.
    fn new(normals: &ExactMatrix, offsets: &[Rational]) -> Self {
        let (m, p) = (normals.rows(), normals.columns());
        let slacks = (0..m).map(|i| {
            let plus = (0..p).map(|j| -normals.get(i, j));
            let minus = (0..p).map(|j| normals.get(i, j).clone());
            [offsets[i].clone(), Rational::one()].into_iter().chain(plus).chain(minus).collect()
        });
        let coordinates = (0..p).map(|j| {
            let mut row = vec![Rational::zero(); 2 * p + 2];
            (row[j + 2], row[j + 2 + p]) = (Rational::one(), -Rational::one());
            row
        });
        Self {
            rows: slacks.chain(coordinates).collect(),
            basic: (2 * p + 1..2 * p + 1 + m + p).collect(),
            nonbasic: (SHORTAGE..=2 * p).collect(),
            half_spaces: m,
        }
    }

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

    /// Increases the variable of `column` until some variable becomes 0, which it is exchanged with; `None` if that
    /// never happens.
    fn increase(&mut self, column: usize) -> Option<()> {
        let leaving = (0..self.half_spaces)
            .filter(|&row| self.rows[row][column + 1].is_negative())
            .min_by_key(|&row| (-&self.rows[row][0] / &self.rows[row][column + 1], self.basic[row]))?;
        self.pivot(leaving, column);
        Some(())
    }

    /// The column of the first variable, but for `t`, whose coefficient in `row` is as wanted.
    fn entering(&self, row: usize, wanted: fn(&Rational) -> bool) -> Option<usize> {
        (0..self.nonbasic.len())
            .filter(|&column| self.nonbasic[column] != SHORTAGE && wanted(&self.rows[row][column + 1]))
            .min_by_key(|&column| self.nonbasic[column])
    }

    /// Makes all constants of half-spaces non-negative with `t = 0`, if that can be.
    ///
    /// Phase one: minimise `t ≥ 0`; feasible iff the optimum is 0.
    fn make_feasible(&mut self) -> bool {
        let worst = (0..self.half_spaces).min_by(|&i, &j| self.rows[i][0].cmp(&self.rows[j][0]));
        let Some(worst) = worst.filter(|&worst| self.rows[worst][0].is_negative()) else { return true };
        self.pivot(worst, SHORTAGE);
        while let Some(shortage) = self.basic.iter().position(|&variable| variable == SHORTAGE) {
            if self.rows[shortage][0].is_zero() {
                // It leaves where it is, with any other: nothing moves.
                if let Some(column) = self.entering(shortage, |entry| !entry.is_zero()) {
                    self.pivot(shortage, column);
                }
                return true;
            }
            let Some(column) = self.entering(shortage, Rational::is_negative) else { return false };
            // `t` itself decreases, so some row always limits the step.
            if self.increase(column).is_none() {
                return false;
            }
        }
        true
    }

    /// The least (or greatest) value of coordinate `j`; `None` if there is none.
    fn extreme(&mut self, j: usize, worse: fn(&Rational) -> bool) -> Option<Rational> {
        let row = self.half_spaces + j;
        while let Some(column) = self.entering(row, worse) {
            self.increase(column)?;
        }
        Some(self.rows[row][0].clone())
    }
}

/// Whether some `x` satisfies `G x ≤ g`.
pub(super) fn is_feasible(normals: &ExactMatrix, offsets: &[Rational]) -> bool {
    Dictionary::new(normals, offsets).make_feasible()
}

/// The least and greatest value of every coordinate over `{x : G x ≤ g}`; `None` if it is empty or unbounded.
pub(super) fn bounding_box(normals: &ExactMatrix, offsets: &[Rational]) -> Option<Vec<(Rational, Rational)>> {
    let mut dictionary = Dictionary::new(normals, offsets);
    if !dictionary.make_feasible() {
        return None;
    }
    let extremes = |j| {
        let least = dictionary.extreme(j, Rational::is_negative)?;
        Some((least, dictionary.extreme(j, Rational::is_positive)?))
    };
    (0..normals.columns()).map(extremes).collect()
}
