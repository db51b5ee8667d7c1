//! Polytopes `{u : G u ≤ g}`.

use super::linear_program::{bounding_box, is_feasible};
use crate::linear_algebra::ExactMatrix;
use imdp::numeric::Rational;
use num_traits::{One, Signed, Zero};

/// The set `{u ∈ ℝᵖ : G u ≤ g}`, with `G` of shape `m×p` and `g` of length `m`, in exact decimals.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Polytope {
    normals: ExactMatrix,
    offsets: Vec<Rational>,
}

impl Polytope {
    /// `{u : G u ≤ g}`; `g` needs one entry per row of `G`.
    pub fn new(normals: ExactMatrix, offsets: Vec<Rational>) -> Self {
        assert_eq!(normals.rows(), offsets.len(), "one offset per half-space");
        Self { normals, offsets }
    }

    /// The box `{u : lower ≤ u ≤ upper}`, as `2p` half-spaces.
    pub fn from_box(lower: &[Rational], upper: &[Rational]) -> Self {
        let p = lower.len();
        let normals = ExactMatrix::from_fn(2 * p, p, |i, j| match (i % p == j, i < p) {
            (false, _) => Rational::zero(),
            (true, true) => Rational::one(),
            (true, false) => -Rational::one(),
        });
        let offsets = upper.iter().cloned().chain(lower.iter().map(|x| -x)).collect();
        Self { normals, offsets }
    }

    /// The dimension `p` of the space.
    pub fn dimension(&self) -> usize {
        self.normals.columns()
    }

    /// `G`, `m×p`.
    pub fn normals(&self) -> &ExactMatrix {
        &self.normals
    }

    /// `g`, length `m`.
    pub fn offsets(&self) -> &[Rational] {
        &self.offsets
    }

    /// The product `U × U × … × U` of `copies` factors: the inputs of as many steps in a row.
    pub fn power(&self, copies: usize) -> Self {
        let (m, p) = (self.normals.rows(), self.dimension());
        let normals = ExactMatrix::from_fn(m * copies, p * copies, |i, j| {
            if i / m == j / p { self.normals.get(i % m, j % p).clone() } else { Rational::zero() }
        });
        let offsets = (0..m * copies).map(|i| self.offsets[i % m].clone()).collect();
        Self { normals, offsets }
    }

    /// Whether 0 belongs to the set: `g ≥ 0`.
    pub fn contains_origin(&self) -> bool {
        !self.offsets.iter().any(Signed::is_negative)
    }

    /// Whether the set has no point at all, decided exactly.
    pub fn is_empty(&self) -> bool {
        !self.contains_origin() && !is_feasible(&self.normals, &self.offsets)
    }

    /// The least and greatest value of every coordinate, exactly; `None` if the set is empty or unbounded.
    pub fn bounding_box(&self) -> Option<Vec<(Rational, Rational)>> {
        bounding_box(&self.normals, &self.offsets)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use imdp::numeric::from_decimal;
    use nalgebra::DMatrix;

    fn exact(values: &[f64]) -> Vec<Rational> {
        values.iter().map(|&x| from_decimal(x).unwrap()).collect()
    }

    fn polytope(rows: usize, normals: &[f64], offsets: &[f64]) -> Polytope {
        let normals = DMatrix::from_row_slice(rows, normals.len() / rows, normals);
        Polytope::new(ExactMatrix::from_decimals(&normals).unwrap(), exact(offsets))
    }

    #[test]
    fn boxes() {
        let unit = Polytope::from_box(&exact(&[-1.0, 14.0]), &exact(&[1.0, 28.0]));
        assert!(!unit.contains_origin() && !unit.is_empty());
        assert!(Polytope::from_box(&exact(&[1.0]), &exact(&[0.5])).is_empty());
        assert!(!Polytope::from_box(&exact(&[0.5]), &exact(&[0.5])).is_empty());
        assert_eq!(unit.power(3).dimension(), 6);
        assert!(!unit.power(3).is_empty());
    }

    #[test]
    fn emptiness_is_decided_on_the_border() {
        // The half-planes x + y ≥ 0.3, x ≤ 0.1, y ≤ 0.2 meet in one point, and in none when 0.2 shrinks.
        let normals = [-1.0, -1.0, 1.0, 0.0, 0.0, 1.0];
        assert!(!polytope(3, &normals, &[-0.3, 0.1, 0.2]).is_empty());
        assert!(polytope(3, &normals, &[-0.3, 0.1, 0.1999999999999999]).is_empty());
        // An unbounded strip away from the origin.
        assert!(!polytope(2, &[1.0, 1.0, -1.0, -1.0], &[3.0, -2.0]).is_empty());
        assert!(polytope(2, &[1.0, 1.0, -1.0, -1.0], &[2.0, -3.0]).is_empty());
    }

    #[test]
    fn bounding_boxes_are_exact() {
        let bounds = |set: Polytope| {
            set.bounding_box().map(|pairs| pairs.into_iter().flat_map(|(a, b)| [a, b]).collect())
        };
        let unit = Polytope::from_box(&exact(&[-1.0, 14.0]), &exact(&[1.0, 28.0]));
        assert_eq!(bounds(unit), Some(exact(&[-1.0, 1.0, 14.0, 28.0])));
        // The triangle with corners (0.1, 0.2), (0.3, 0.2), (0.1, 0.4): x + y ≤ 0.5.
        let triangle = [1.0, 1.0, -1.0, 0.0, 0.0, -1.0];
        assert_eq!(bounds(polytope(3, &triangle, &[0.5, -0.1, -0.2])), Some(exact(&[0.1, 0.3, 0.2, 0.4])));
        // One point, no point, a strip.
        assert_eq!(bounds(polytope(3, &triangle, &[0.3, -0.1, -0.2])), Some(exact(&[0.1, 0.1, 0.2, 0.2])));
        assert_eq!(bounds(polytope(3, &triangle, &[0.2, -0.1, -0.2])), None);
        assert_eq!(bounds(polytope(2, &[1.0, 0.0, -1.0, 0.0], &[3.0, 2.0])), None);
    }
}
