//! Small dense matrices of exact rationals.

use imdp::numeric::{Rational, from_decimal, to_f64};
use nalgebra::DMatrix;
use num_traits::{One, Signed, Zero};

/// A dense `rows × columns` matrix of exact rationals, stored by rows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExactMatrix {
    rows: usize,
    columns: usize,
    entries: Vec<Rational>,
}

/// The sign of a symmetric matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Definiteness {
    /// `xᵀMx > 0` for all `x ≠ 0`.
    PositiveDefinite,
    /// `xᵀMx ≥ 0` for all `x`, and `= 0` for some `x ≠ 0`.
    PositiveSemidefinite,
    /// `xᵀMx < 0` for some `x`.
    Indefinite,
}

/// The factors of `M = L D Lᵀ` with `L` unit lower triangular and `D` diagonal and non-negative.
#[derive(Clone, Debug)]
pub struct LdlFactors {
    /// `L`, `n×n`, unit lower triangular.
    pub lower: ExactMatrix,
    /// The diagonal of `D`, `n` entries, none negative.
    pub diagonal: Vec<Rational>,
}

impl ExactMatrix {
    /// The matrix with entry `(i, j)` equal to `entry(i, j)`.
    pub fn from_fn(rows: usize, columns: usize, mut entry: impl FnMut(usize, usize) -> Rational) -> Self {
        let entries = (0..rows * columns).map(|k| entry(k / columns, k % columns)).collect();
        Self { rows, columns, entries }
    }

    /// The matrix of the shortest decimals of `m`; `None` if an entry is not finite.
    pub fn from_decimals(m: &DMatrix<f64>) -> Option<Self> {
        let (rows, columns) = m.shape();
        let entries: Option<Vec<_>> =
            (0..rows * columns).map(|k| from_decimal(m[(k / columns, k % columns)])).collect();
        entries.map(|entries| Self { rows, columns, entries })
    }

    /// The column vector of the shortest decimals of `v`; `None` if an entry is not finite.
    pub fn column_from_decimals(v: &[f64]) -> Option<Self> {
        let entries: Option<Vec<_>> = v.iter().map(|&x| from_decimal(x)).collect();
        entries.map(|entries| Self { rows: v.len(), columns: 1, entries })
    }

    /// The `n × n` identity.
    pub fn identity(n: usize) -> Self {
        Self::from_fn(n, n, |i, j| if i == j { Rational::one() } else { Rational::zero() })
    }

    /// The `rows × columns` zero matrix.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self::from_fn(rows, columns, |_, _| Rational::zero())
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// The entry in row `i` and column `j`.
    pub fn get(&self, i: usize, j: usize) -> &Rational {
        &self.entries[i * self.columns + j]
    }

    /// The entries, row by row.
    pub fn entries(&self) -> &[Rational] {
        &self.entries
    }

    /// `self · other`.
    pub fn times(&self, other: &Self) -> Self {
        assert_eq!(self.columns, other.rows, "inner dimensions of a product");
        Self::from_fn(self.rows, other.columns, |i, j| {
            (0..self.columns).fold(Rational::zero(), |sum, k| {
                let (a, b) = (self.get(i, k), other.get(k, j));
                if a.is_zero() || b.is_zero() { sum } else { sum + a * b }
            })
        })
    }

    /// `self + other`.
    pub fn plus(&self, other: &Self) -> Self {
        assert_eq!((self.rows, self.columns), (other.rows, other.columns), "shapes of a sum");
        Self::from_fn(self.rows, self.columns, |i, j| self.get(i, j) + other.get(i, j))
    }

    /// `−self`.
    pub fn negated(&self) -> Self {
        Self::from_fn(self.rows, self.columns, |i, j| -self.get(i, j))
    }

    /// `self − other`.
    pub fn minus(&self, other: &Self) -> Self {
        self.plus(&other.negated())
    }

    /// The transpose.
    pub fn transposed(&self) -> Self {
        Self::from_fn(self.columns, self.rows, |i, j| self.get(j, i).clone())
    }

    /// `[self other]`, side by side.
    pub fn beside(&self, other: &Self) -> Self {
        assert_eq!(self.rows, other.rows, "heights of blocks side by side");
        Self::from_fn(self.rows, self.columns + other.columns, |i, j| {
            if j < self.columns { self.get(i, j).clone() } else { other.get(i, j - self.columns).clone() }
        })
    }

    /// The number of bits that the largest entry takes.
    pub fn bits(&self) -> u64 {
        self.entries.iter().map(|entry| entry.numer().bits() + entry.denom().bits()).max().unwrap_or(0)
    }

    /// The inverse of a square matrix; `None` if it is singular.
    pub fn inverse(&self) -> Option<Self> {
        assert_eq!(self.rows, self.columns, "only square matrices have inverses");
        let n = self.rows;
        let mut block = self.beside(&Self::identity(n));
        block.eliminate();
        let regular = (0..n).all(|i| block.get(i, i).is_one());
        regular.then(|| Self::from_fn(n, n, |i, j| block.get(i, n + j).clone()))
    }

    /// The Moore–Penrose right inverse `Mᵀ (M Mᵀ)⁻¹`; `None` unless the rows are independent.
    ///
    /// For a square matrix this is the inverse.
    pub fn right_inverse(&self) -> Option<Self> {
        if self.rows == self.columns {
            return self.inverse();
        }
        let transposed = self.transposed();
        self.times(&transposed).inverse().map(|gram| transposed.times(&gram))
    }

    /// Reduced row echelon form in place.
    fn eliminate(&mut self) {
        let mut rank = 0;
        for column in 0..self.columns {
            let Some(pivot) = (rank..self.rows).find(|&i| !self.get(i, column).is_zero()) else { continue };
            for j in 0..self.columns {
                self.entries.swap(rank * self.columns + j, pivot * self.columns + j);
            }
            let scale = self.get(rank, column).recip();
            for j in column..self.columns {
                self.entries[rank * self.columns + j] *= &scale;
            }
            for i in (0..self.rows).filter(|&i| i != rank) {
                let factor = self.get(i, column).clone();
                if factor.is_zero() {
                    continue;
                }
                for j in column..self.columns {
                    let change = &factor * self.get(rank, j);
                    self.entries[i * self.columns + j] -= change;
                }
            }
            rank += 1;
            if rank == self.rows {
                break;
            }
        }
    }

    /// The first pair `(i, j)`, `i < j`, with `M_ij ≠ M_ji`, if any.
    pub fn asymmetry(&self) -> Option<(usize, usize)> {
        (0..self.rows)
            .flat_map(|i| (i + 1..self.columns).map(move |j| (i, j)))
            .find(|&(i, j)| self.get(i, j) != self.get(j, i))
    }

    /// `M = L D Lᵀ` for a symmetric positive semidefinite matrix; `None` if it is indefinite.
    ///
    /// Without pivoting: if a pivot of a semidefinite matrix is 0, its whole column must be 0.
    pub fn ldl(&self) -> Option<LdlFactors> {
        let n = self.rows;
        let mut lower = Self::identity(n);
        let mut diagonal: Vec<Rational> = Vec::with_capacity(n);
        for j in 0..n {
            let partial = |i: usize, lower: &Self, diagonal: &[Rational]| {
                (0..j).fold(self.get(i, j).clone(), |sum, k| {
                    sum - lower.get(i, k) * lower.get(j, k) * &diagonal[k]
                })
            };
            let pivot = partial(j, &lower, &diagonal);
            if pivot.is_negative() {
                return None;
            }
            for i in j + 1..n {
                let numerator = partial(i, &lower, &diagonal);
                lower.entries[i * n + j] = match (pivot.is_zero(), numerator.is_zero()) {
                    (true, true) => Rational::zero(),
                    (true, false) => return None,
                    (false, _) => numerator / &pivot,
                };
            }
            diagonal.push(pivot);
        }
        Some(LdlFactors { lower, diagonal })
    }

    /// The sign of a symmetric matrix, decided exactly.
    pub fn definiteness(&self) -> Definiteness {
        match self.ldl() {
            None => Definiteness::Indefinite,
            Some(factors) if factors.diagonal.iter().any(Zero::is_zero) => Definiteness::PositiveSemidefinite,
            Some(_) => Definiteness::PositiveDefinite,
        }
    }

    /// Every entry rounded to the nearest double.
    pub fn to_f64(&self) -> DMatrix<f64> {
        DMatrix::from_fn(self.rows, self.columns, |i, j| to_f64(self.get(i, j)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(rows: usize, columns: usize, entries: &[f64]) -> ExactMatrix {
        ExactMatrix::from_decimals(&DMatrix::from_row_slice(rows, columns, entries)).unwrap()
    }

    #[test]
    fn inverse_is_exact() {
        let a = matrix(2, 2, &[0.1, 0.2, 0.3, 0.4]);
        assert_eq!(a.times(&a.inverse().unwrap()), ExactMatrix::identity(2));
        assert!(matrix(2, 2, &[0.1, 0.2, 0.3, 0.6]).inverse().is_none());
    }

    #[test]
    fn right_inverse_of_a_wide_matrix() {
        let b = matrix(2, 3, &[1.0, 2.0, 0.5, 0.0, 1.0, 1.0]);
        assert_eq!(b.times(&b.right_inverse().unwrap()), ExactMatrix::identity(2));
        assert!(matrix(2, 3, &[1.0, 2.0, 3.0, 2.0, 4.0, 6.0]).right_inverse().is_none());
    }

    #[test]
    fn rank_sees_through_rounding() {
        // 0.1 + 0.2 ≠ 0.3 in doubles; in decimals the rows are dependent.
        assert_eq!(matrix(2, 2, &[0.1, 0.2, 0.3, 0.6]).rank(), 1);
        assert_eq!(matrix(3, 3, &[0.1, 0.0, 0.1, 0.2, 0.0, 0.2, 0.3, 0.0, 0.3]).rank(), 1);
        assert_eq!(matrix(2, 2, &[1e-12, 0.0, 0.0, 1e12]).rank(), 2);
    }

    #[test]
    fn definiteness_is_decided_on_the_border() {
        use Definiteness::*;
        assert_eq!(matrix(2, 2, &[6.0, 1.0, 1.0, 2.0]).definiteness(), PositiveDefinite);
        assert_eq!(matrix(2, 2, &[0.1, 0.3, 0.3, 0.9]).definiteness(), PositiveSemidefinite);
        assert_eq!(matrix(2, 2, &[0.1, 0.3, 0.3, 0.8999999]).definiteness(), Indefinite);
        assert_eq!(matrix(2, 2, &[0.0, 0.0, 0.0, 1.0]).definiteness(), PositiveSemidefinite);
        assert_eq!(matrix(2, 2, &[0.0, 1.0, 1.0, 1.0]).definiteness(), Indefinite);
    }

    #[test]
    fn asymmetry_names_the_entry() {
        assert_eq!(matrix(2, 2, &[1.0, 2.0, 2.0, 1.0]).asymmetry(), None);
        assert_eq!(matrix(2, 2, &[1.0, 2.0, 2.5, 1.0]).asymmetry(), Some((0, 1)));
    }
}
