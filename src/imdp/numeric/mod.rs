//! Numbers that can be trusted: exact rationals, decimals rounded in one direction.
//!
//! A model file is written in decimals, so every quantity derived from it by `+ − × ÷` (grouped
//! dynamics, right inverses, cell faces) is a rational number. It is computed as such and rounded to
//! a double once, at the end; only measured or transcendental quantities are floating point from the
//! start.

mod decimal;
mod exact;
mod rational;

pub use decimal::{round_decimal_down, round_decimal_up, shortest_decimal};
pub use exact::Exact;
pub(crate) use rational::common_multiple;
pub use rational::{Rational, decimal_parts, from_decimal, from_dyadic, to_f64, to_f64_down, to_f64_up};

/// The unit roundoff of a double, `2⁻⁵³`: `fl(a ∘ b) = (a ∘ b)(1 + δ)` with `|δ| ≤ UNIT_ROUNDOFF`.
pub const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;

/// An upper bound on the relative error of `operations` roundings in a row.
///
/// `γ_m = m u / (1 − m u)` (Higham, *Accuracy and Stability of Numerical Algorithms*, Lemma 3.1),
/// with a factor 2 that also covers the rounding of the expressions in which it is used.
pub fn rounding_factor(operations: usize) -> f64 {
    2.0 * operations as f64 * UNIT_ROUNDOFF
}

/// The largest double that is at most `1 − x`, for `0 ≤ x ≤ 1`.
pub fn one_minus_down(x: f64) -> f64 {
    let rounded = 1.0 - x;
    // 1 − rounded is exact: for rounded ≥ ½ by Sterbenz, and below that rounded is exact itself.
    if 1.0 - rounded < x { rounded.next_down() } else { rounded }
}

/// The smallest double that is at least `1 − x`, for `0 ≤ x ≤ 1`.
pub fn one_minus_up(x: f64) -> f64 {
    let rounded = 1.0 - x;
    if 1.0 - rounded > x { rounded.next_up() } else { rounded }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_traits::One;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn complements_enclose_tightly(x in prop_oneof![0.0f64..=1.0, 0.0f64..1e-15]) {
            let exact = Rational::one() - from_dyadic(x).unwrap();
            prop_assert_eq!(one_minus_down(x), to_f64_down(&exact));
            prop_assert_eq!(one_minus_up(x), to_f64_up(&exact));
        }
    }
}
