//! Which bound is computed: the two differ in who gains from what is not known.

use imdp::numeric::{one_minus_down, one_minus_up};
use std::cmp::Ordering;

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
    /// The mass that lower bounds leave.
    fn slack(slack: Slack) -> f64;
    /// What is left of a mass, at least 0.
    fn less(mass: f64, taken: f64) -> f64;
    /// The room of some masses together, for its rounded sum of `terms`.
    fn room(sum: f64, terms: usize) -> f64;
    /// A value known up to an error, as a bound.
    fn shift(value: f64, error: f64) -> f64;
    /// Which of two values nature prefers.
    fn worst_first(a: f64, b: f64) -> Ordering;
}

/// What lower bounds on masses leave of 1, from both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slack {
    /// At least this.
    pub least: f64,
    /// At most this.
    pub most: f64,
}

impl Slack {
    /// What these masses leave.
    pub fn beside(masses: &[f64]) -> Self {
        let down = masses.iter().fold(0.0, |sum: f64, p| if *p > 0.0 { (sum + p).next_down() } else { sum });
        let up = masses.iter().fold(0.0, |sum: f64, p| if *p > 0.0 { (sum + p).next_up() } else { sum });
        Self { least: one_minus_down(up.min(1.0)).max(0.0), most: one_minus_up(down.clamp(0.0, 1.0)) }
    }
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

    fn slack(slack: Slack) -> f64 {
        slack.least
    }

    fn less(mass: f64, taken: f64) -> f64 {
        (mass - taken).next_down().max(0.0)
    }

    fn room(sum: f64, terms: usize) -> f64 {
        sum * (1.0 + imdp::numeric::rounding_factor(terms + 1))
    }

    fn shift(value: f64, error: f64) -> f64 {
        (value - error).next_down()
    }

    fn worst_first(a: f64, b: f64) -> Ordering {
        a.total_cmp(&b)
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

    fn slack(slack: Slack) -> f64 {
        slack.most
    }

    fn less(mass: f64, taken: f64) -> f64 {
        let left = mass - taken;
        if left < 0.0 { 0.0 } else { left.next_up() }
    }

    fn room(sum: f64, terms: usize) -> f64 {
        sum * (1.0 - imdp::numeric::rounding_factor(terms + 1))
    }

    fn shift(value: f64, error: f64) -> f64 {
        (value + error).next_up()
    }

    fn worst_first(a: f64, b: f64) -> Ordering {
        b.total_cmp(&a)
    }
}

/// Positive for whatever listed noise can lead to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Listed;

impl Side for Listed {
    const UNLISTED: f64 = 0.0;

    fn of(a: f64, b: f64) -> f64 {
        Upper::of(a, b)
    }

    fn outward(terms: usize) -> f64 {
        Upper::outward(terms)
    }

    fn above_underflow(value: f64) -> f64 {
        Upper::above_underflow(value)
    }

    fn add(a: f64, b: f64) -> f64 {
        Upper::add(a, b)
    }

    fn slack(slack: Slack) -> f64 {
        Upper::slack(slack)
    }

    fn less(mass: f64, taken: f64) -> f64 {
        Upper::less(mass, taken)
    }

    fn room(sum: f64, terms: usize) -> f64 {
        Upper::room(sum, terms)
    }

    fn shift(value: f64, error: f64) -> f64 {
        Upper::shift(value, error)
    }

    fn worst_first(a: f64, b: f64) -> Ordering {
        Upper::worst_first(a, b)
    }
}
