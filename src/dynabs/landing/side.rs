//! Which bound is computed: the two differ in who gains from what is not known.

/// A bound on a probability of success, and how everything uncertain is resolved for it.
pub trait Side: Copy + Send + Sync + 'static {
    /// What nature makes of a choice between two values.
    fn of(a: f64, b: f64) -> f64;
    /// The value of noise that is not listed.
    const UNLISTED: f64;
    /// The factor that makes a sum of `terms` rounded products of numbers from 0 to 1 a bound.
    fn outward(terms: usize) -> f64;
    /// What a value becomes before it is multiplied: no product may be so small that its rounding is not relative.
    fn above_underflow(value: f64) -> f64;
    /// The sum, rounded so that it stays a bound.
    fn add(a: f64, b: f64) -> f64;
}

/// Values below this are rounded to 0 or up to it: products with masses above [`LEAST_MASS`] are normal numbers.
const LEAST_VALUE: f64 = 1e-200;

/// Masses below this are not listed.
pub(super) const LEAST_MASS: f64 = 1e-100;

/// Never above the value: nature is an adversary and what is not listed fails.
#[derive(Clone, Copy, Debug)]
pub struct Lower;

/// Never below the value of any controller with these inputs: nature helps and what is not listed succeeds.
#[derive(Clone, Copy, Debug)]
pub struct Upper;

impl Side for Lower {
    fn of(a: f64, b: f64) -> f64 {
        if a < b { a } else { b }
    }

    const UNLISTED: f64 = 0.0;

    fn outward(terms: usize) -> f64 {
        1.0 - imdp::numeric::rounding_factor(terms + 3)
    }

    fn above_underflow(value: f64) -> f64 {
        if value < LEAST_VALUE { 0.0 } else { value }
    }

    fn add(a: f64, b: f64) -> f64 {
        if b == 0.0 { a } else { (a + b).next_down().max(0.0) }
    }
}

impl Side for Upper {
    fn of(a: f64, b: f64) -> f64 {
        if a > b { a } else { b }
    }

    const UNLISTED: f64 = 1.0;

    fn outward(terms: usize) -> f64 {
        1.0 + imdp::numeric::rounding_factor(terms + 3)
    }

    fn above_underflow(value: f64) -> f64 {
        if value > 0.0 && value < LEAST_VALUE { LEAST_VALUE } else { value }
    }

    fn add(a: f64, b: f64) -> f64 {
        if b == 0.0 { a } else { (a + b).next_up() }
    }
}
