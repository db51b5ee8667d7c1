//! What an expression can be evaluated on: doubles and intervals.

use super::graph::Function;
use crate::system::Interval;
use core_math as cr;

/// A value that expressions can be evaluated on.
pub(super) trait Number:
    Copy
    + std::ops::Add<Output = Self>
    + std::ops::Sub<Output = Self>
    + std::ops::Mul<Output = Self>
    + std::ops::Div<Output = Self>
    + std::ops::Neg<Output = Self>
{
    /// A number, given as the nearest double and as an enclosure.
    fn constant(nearest: f64, enclosure: Interval) -> Self;
    /// `xⁿ`.
    fn power(self, n: i32) -> Self;
    /// `xʸ` for positive `x`.
    fn power_real(self, exponent: Self) -> Self;
    /// The smaller one.
    fn min(self, other: Self) -> Self;
    /// The larger one.
    fn max(self, other: Self) -> Self;
    /// `negative` where `self < 0`, `positive` where `self > 0`.
    fn select(self, negative: Self, positive: Self) -> Self;
    /// A function of it.
    fn call(self, function: Function) -> Self;
}

impl Number for f64 {
    fn constant(nearest: f64, _: Interval) -> Self {
        nearest
    }

    fn power(self, n: i32) -> Self {
        // Repeated squaring in one fixed order: `powi` may differ between platforms.
        let (mut result, mut square, mut rest) = (1.0, self, n.unsigned_abs());
        while rest > 0 {
            if rest % 2 == 1 {
                result *= square;
            }
            square *= square;
            rest /= 2;
        }
        if n < 0 { 1.0 / result } else { result }
    }

    fn power_real(self, exponent: Self) -> Self {
        cr::pow(self, exponent)
    }

    fn min(self, other: Self) -> Self {
        f64::min(self, other)
    }

    fn max(self, other: Self) -> Self {
        f64::max(self, other)
    }

    fn select(self, negative: Self, positive: Self) -> Self {
        if self < 0.0 { negative } else { positive }
    }

    fn call(self, function: Function) -> Self {
        match function {
            Function::Sin => cr::sin(self),
            Function::Cos => cr::cos(self),
            Function::Tan => cr::tan(self),
            Function::Atan => cr::atan(self),
            Function::Asin => cr::asin(self),
            Function::Acos => cr::acos(self),
            Function::Sinh => cr::sinh(self),
            Function::Cosh => cr::cosh(self),
            Function::Tanh => cr::tanh(self),
            Function::Exp => cr::exp(self),
            Function::Ln => cr::log(self),
            Function::Sqrt => self.sqrt(),
            Function::Abs => self.abs(),
        }
    }
}

impl Number for Interval {
    fn constant(_: f64, enclosure: Interval) -> Self {
        enclosure
    }

    fn power(self, n: i32) -> Self {
        Interval::power(self, n)
    }

    fn power_real(self, exponent: Self) -> Self {
        Interval::power_real(self, exponent)
    }

    fn min(self, other: Self) -> Self {
        Interval::min(self, other)
    }

    fn max(self, other: Self) -> Self {
        Interval::max(self, other)
    }

    fn select(self, negative: Self, positive: Self) -> Self {
        if self.upper() < 0.0 {
            negative
        } else if self.lower() > 0.0 {
            positive
        } else {
            negative.hull(positive)
        }
    }

    fn call(self, function: Function) -> Self {
        match function {
            Function::Sin => self.sin(),
            Function::Cos => self.cos(),
            Function::Tan => self.tan(),
            Function::Atan => self.atan(),
            Function::Asin => self.asin(),
            Function::Acos => self.acos(),
            Function::Sinh => self.sinh(),
            Function::Cosh => self.cosh(),
            Function::Tanh => self.tanh(),
            Function::Exp => self.exp(),
            Function::Ln => self.ln(),
            Function::Sqrt => self.sqrt(),
            Function::Abs => self.abs(),
        }
    }
}
