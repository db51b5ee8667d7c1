//! Whether an input is in `U`, decided exactly.

use crate::geometry::Polytope;
use imdp::numeric::{from_dyadic, rounding_factor, to_f64};
use num_traits::{Signed, Zero};
use serde::Serialize;

/// The set `U = {u : G u ≤ g}` of one step, for inputs in doubles.
#[derive(Clone, Debug)]
pub struct InputCheck {
    set: Polytope,
    normals: Vec<f64>,
    offsets: Vec<f64>,
}

/// An input outside `U`: a mistake in this program wherever it occurs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Violation {
    /// The number of the simulated run.
    pub run: u64,
    /// The original step in which the input would have been applied.
    pub step: u64,
    /// The state at the last grouped instant.
    pub state: Vec<f64>,
    /// The input.
    pub input: Vec<f64>,
    /// Which half-space of `U` it leaves.
    pub half_space: usize,
    /// By how much, `G_i u − g_i`.
    pub excess: f64,
}

impl InputCheck {
    /// The check for a set.
    pub fn new(set: &Polytope) -> Self {
        let offsets = set.offsets().iter().map(to_f64).collect();
        let normals = crate::controller::law::by_rows(&set.normals().to_f64());
        Self { set: set.clone(), normals, offsets }
    }

    /// The first half-space that `u` leaves, with `G_i u − g_i`; `None` if it is in `U`.
    pub fn violation(&self, u: &[f64]) -> Option<(usize, f64)> {
        let p = u.len();
        let factor = rounding_factor(p + 3);
        (self.offsets.iter().enumerate()).find_map(|(i, offset)| {
            let row = &self.normals[i * p..(i + 1) * p];
            let (value, magnitude) =
                row.iter().zip(u).fold((0.0, offset.abs()), |(value, magnitude), (g, u)| {
                    (value + g * u, magnitude + (g * u).abs())
                });
            let clearly_inside = value + factor * magnitude <= *offset;
            if clearly_inside { None } else { self.exact_excess(i, u).map(|excess| (i, excess)) }
        })
    }

    /// `G_i u − g_i` if it is positive, or infinity if `u` is not finite.
    fn exact_excess(&self, i: usize, u: &[f64]) -> Option<f64> {
        let mut excess = -&self.set.offsets()[i];
        for (j, &u) in u.iter().enumerate() {
            let normal = self.set.normals().get(i, j);
            match from_dyadic(u) {
                _ if normal.is_zero() && !u.is_nan() => {}
                Some(u) => excess += normal * u,
                None => return Some(f64::INFINITY),
            }
        }
        excess.is_positive().then(|| to_f64(&excess))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use imdp::numeric::from_decimal;

    #[test]
    fn the_border_is_exact() {
        let side = |x| vec![from_decimal(x).unwrap(); 2];
        let check = InputCheck::new(&Polytope::from_box(&side(-0.1), &side(0.3)));
        // The double nearest to 0.1 is above 1/10, that nearest to 0.3 below 3/10.
        assert_eq!(check.violation(&[-0.1f64.next_down(), 0.3]), None);
        assert!(
            check.violation(&[0.0, 0.3f64.next_up()]).is_some_and(|(i, excess)| i == 1 && excess < 1e-16)
        );
        assert!(check.violation(&[-0.1, 0.0]).is_some_and(|(i, excess)| i == 2 && excess < 1e-17));
        assert_eq!(check.violation(&[f64::NAN, 0.0]), Some((0, f64::INFINITY)));
        assert!(check.violation(&[0.0, f64::INFINITY]).is_some());
    }
}
