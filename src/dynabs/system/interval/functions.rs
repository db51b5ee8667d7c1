//! The elementary functions on intervals.
//!
//! CORE-MATH (Sibidanov, Zimmermann, Glondu, ARITH 2022) rounds correctly to nearest, so the double below and
//! the double above a computed value enclose the exact one. Where a value is a double itself (by the theorem
//! of Lindemann and Weierstrass only at 0, or 1 for the logarithm) it is not widened.

use super::Interval;
use super::rounding::{sqrt_down, sqrt_up};
use core_math as cr;

/// Beyond this, a sine or cosine is taken to be anywhere in `[−1, 1]`.
const LARGEST_ANGLE: f64 = 1e9;

/// The double below `f(x)`, or the value itself where it is exact.
fn down(f: fn(f64) -> f64, exact: Option<(f64, f64)>, x: f64) -> f64 {
    match exact {
        Some((at, value)) if x == at => value,
        _ => f(x).next_down(),
    }
}

/// The double above `f(x)`, or the value itself where it is exact.
fn up(f: fn(f64) -> f64, exact: Option<(f64, f64)>, x: f64) -> f64 {
    match exact {
        Some((at, value)) if x == at => value,
        _ => f(x).next_up(),
    }
}

impl Interval {
    /// An increasing function that is an exact double at most at one point.
    fn increasing(self, f: fn(f64) -> f64, exact: Option<(f64, f64)>) -> Self {
        Self::new(down(f, exact, self.lower), up(f, exact, self.upper))
    }

    /// `√x`; everything if an element is negative.
    pub fn sqrt(self) -> Self {
        if self.lower < 0.0 {
            return Self::EVERYTHING;
        }
        Self::new(sqrt_down(self.lower), sqrt_up(self.upper))
    }

    /// `eˣ`.
    pub fn exp(self) -> Self {
        let bounds = self.increasing(cr::exp, Some((0.0, 1.0)));
        Self { lower: bounds.lower.max(0.0), upper: bounds.upper }
    }

    /// The natural logarithm; everything if an element is not positive.
    pub fn ln(self) -> Self {
        if self.lower <= 0.0 {
            return Self::EVERYTHING;
        }
        self.increasing(cr::log, Some((1.0, 0.0)))
    }

    /// `xʸ = exp(y ln x)` for positive `x`; everything if an element `x` is not positive.
    pub fn power_real(self, exponent: Self) -> Self {
        if self.lower <= 0.0 || !self.is_bounded() || !exponent.is_bounded() {
            return Self::EVERYTHING;
        }
        // Monotone in x for fixed y and in y for fixed x: extremes are at corners.
        let corners = [
            cr::pow(self.lower, exponent.lower),
            cr::pow(self.lower, exponent.upper),
            cr::pow(self.upper, exponent.lower),
            cr::pow(self.upper, exponent.upper),
        ];
        let lower = corners.iter().copied().fold(f64::INFINITY, f64::min).next_down().max(0.0);
        let upper = corners.iter().copied().fold(0.0, f64::max).next_up();
        Self::new(lower, upper)
    }

    /// `sin x`.
    pub fn sin(self) -> Self {
        // sin has its extremes at (k + ½)π: a maximum for even k.
        self.oscillating(cr::sin, Some((0.0, 0.0)), 0.5)
    }

    /// `cos x`.
    pub fn cos(self) -> Self {
        self.oscillating(cr::cos, Some((0.0, 1.0)), 0.0)
    }

    /// A function with maximum 1 at `(k + shift)π` for even `k`, minimum −1 there for odd `k`, monotone between.
    fn oscillating(self, f: fn(f64) -> f64, exact: Option<(f64, f64)>, shift: f64) -> Self {
        let whole = Self { lower: -1.0, upper: 1.0 };
        if !(self.lower > -LARGEST_ANGLE && self.upper < LARGEST_ANGLE) {
            return whole;
        }
        // The extremes that may lie inside: outward rounding can only add one.
        let turns = self / Self::PI - Self::point(shift);
        let (first, last) = (turns.lower.ceil(), turns.upper.floor());
        let lower = down(f, exact, self.lower).min(down(f, exact, self.upper));
        let upper = up(f, exact, self.lower).max(up(f, exact, self.upper));
        let meets = |parity: f64| {
            let first = if first.rem_euclid(2.0) == parity { first } else { first + 1.0 };
            first <= last
        };
        let lower = if meets(1.0) { -1.0 } else { lower.max(-1.0) };
        let upper = if meets(0.0) { 1.0 } else { upper.min(1.0) };
        Self { lower, upper }
    }

    /// `tan x`; everything if a pole lies inside.
    pub fn tan(self) -> Self {
        if !(self.lower > -LARGEST_ANGLE && self.upper < LARGEST_ANGLE) {
            return Self::EVERYTHING;
        }
        let poles = self / Self::PI - Self::point(0.5);
        if poles.lower.ceil() <= poles.upper.floor() {
            return Self::EVERYTHING;
        }
        self.increasing(cr::tan, Some((0.0, 0.0)))
    }

    /// `arctan x`.
    pub fn atan(self) -> Self {
        self.increasing(cr::atan, Some((0.0, 0.0)))
    }

    /// `arcsin x`; everything if an element is outside `[−1, 1]`.
    pub fn asin(self) -> Self {
        if self.lower < -1.0 || self.upper > 1.0 {
            return Self::EVERYTHING;
        }
        self.increasing(cr::asin, Some((0.0, 0.0)))
    }

    /// `arccos x`; everything if an element is outside `[−1, 1]`.
    pub fn acos(self) -> Self {
        if self.lower < -1.0 || self.upper > 1.0 {
            return Self::EVERYTHING;
        }
        let exact = Some((1.0, 0.0));
        Self::new(down(cr::acos, exact, self.upper).max(0.0), up(cr::acos, exact, self.lower))
    }

    /// `sinh x`.
    pub fn sinh(self) -> Self {
        self.increasing(cr::sinh, Some((0.0, 0.0)))
    }

    /// `cosh x`.
    pub fn cosh(self) -> Self {
        let magnitude = self.abs().increasing(cr::cosh, Some((0.0, 1.0)));
        Self { lower: magnitude.lower.max(1.0), upper: magnitude.upper }
    }

    /// `tanh x`.
    pub fn tanh(self) -> Self {
        let bounds = self.increasing(cr::tanh, Some((0.0, 0.0)));
        Self { lower: bounds.lower.max(-1.0), upper: bounds.upper.min(1.0) }
    }
}
