//! Intervals of reals that enclose every result, whatever is rounded on the way.

mod functions;
mod rounding;
#[cfg(test)]
mod tests;

use imdp::numeric::{Rational, to_f64_down, to_f64_up};
use rounding::{add_down, add_up, div_down, div_up, mul_down, mul_up, power_down, power_up};

/// A non-empty closed interval `[lower, upper]` of reals; its ends may be infinite but never NaN.
///
/// Every operation encloses all results of the operands' elements: lower ends are rounded down, upper ends
/// up, by at most one unit in the last place for `+ − · / √`. An operation that is undefined somewhere in its
/// operands (a division by an interval that contains 0, a logarithm of one that reaches 0) gives
/// [`EVERYTHING`](Self::EVERYTHING).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    lower: f64,
    upper: f64,
}

impl Interval {
    /// All reals.
    pub const EVERYTHING: Self = Self { lower: f64::NEG_INFINITY, upper: f64::INFINITY };
    /// `π`, between two neighbouring doubles.
    pub const PI: Self =
        Self { lower: std::f64::consts::PI, upper: f64::from_bits(std::f64::consts::PI.to_bits() + 1) };
    /// The number 0.
    pub const ZERO: Self = Self { lower: 0.0, upper: 0.0 };

    /// `[lower, upper]`; everything if that is not an interval.
    pub fn new(lower: f64, upper: f64) -> Self {
        if lower <= upper && lower < f64::INFINITY && upper > f64::NEG_INFINITY {
            Self { lower, upper }
        } else {
            Self::EVERYTHING
        }
    }

    /// The interval that is one number; everything if it is not finite.
    pub fn point(x: f64) -> Self {
        if x.is_finite() { Self { lower: x, upper: x } } else { Self::EVERYTHING }
    }

    /// The tightest interval that contains `x`.
    pub fn of_rational(x: &Rational) -> Self {
        Self::enclosing(x, x)
    }

    /// The tightest interval that contains `lower` and `upper`.
    pub fn enclosing(lower: &Rational, upper: &Rational) -> Self {
        Self::new(to_f64_down(lower), to_f64_up(upper))
    }

    /// The lower end.
    pub fn lower(self) -> f64 {
        self.lower
    }

    /// The upper end.
    pub fn upper(self) -> f64 {
        self.upper
    }

    /// Whether both ends are finite.
    pub fn is_bounded(self) -> bool {
        self.lower.is_finite() && self.upper.is_finite()
    }

    /// Whether the interval is a single number.
    pub fn is_point(self) -> bool {
        self.lower == self.upper
    }

    /// Whether `x` is an element.
    pub fn contains(self, x: f64) -> bool {
        self.lower <= x && x <= self.upper
    }

    /// Whether every element of `other` is one of this.
    pub fn encloses(self, other: Self) -> bool {
        self.lower <= other.lower && other.upper <= self.upper
    }

    /// `upper − lower`, rounded up.
    pub fn width(self) -> f64 {
        add_up(self.upper, -self.lower)
    }

    /// A finite element near the middle.
    pub fn middle(self) -> f64 {
        match (self.lower.is_finite(), self.upper.is_finite()) {
            (true, true) => (self.lower / 2.0 + self.upper / 2.0).clamp(self.lower, self.upper),
            (true, false) => self.lower,
            (false, true) => self.upper,
            (false, false) => 0.0,
        }
    }

    /// The lower end as an interval; everything if it is infinite.
    pub fn lower_end(self) -> Self {
        Self::point(self.lower)
    }

    /// The upper end as an interval; everything if it is infinite.
    pub fn upper_end(self) -> Self {
        Self::point(self.upper)
    }

    /// The smallest interval with the elements of both.
    pub fn hull(self, other: Self) -> Self {
        Self { lower: self.lower.min(other.lower), upper: self.upper.max(other.upper) }
    }

    /// The common elements of two enclosures of one value or set, so there are some.
    ///
    /// Should there be none nevertheless, this interval stays as it is.
    pub fn meet(self, other: Self) -> Self {
        let (lower, upper) = (self.lower.max(other.lower), self.upper.min(other.upper));
        if lower <= upper { Self { lower, upper } } else { self }
    }

    /// `xⁿ` for all elements `x`.
    pub fn power(self, n: i32) -> Self {
        if n < 0 {
            // |n| fits: the graph of expressions admits no exponent near the ends of i32.
            return Self::point(1.0) / self.power(n.saturating_neg());
        }
        let exponent = n.unsigned_abs();
        let magnitude = |x: f64, up: bool| {
            if up { power_up(x.abs(), exponent) } else { power_down(x.abs(), exponent) }
        };
        if exponent % 2 == 1 {
            let signed = |x: f64, up: bool| {
                if x < 0.0 { -magnitude(x, !up) } else { magnitude(x, up) }
            };
            return Self::new(signed(self.lower, false), signed(self.upper, true));
        }
        let (near, far) = self.abs().ends();
        Self::new(magnitude(near, false), magnitude(far, true))
    }

    /// `|x|` for all elements `x`.
    pub fn abs(self) -> Self {
        if self.lower >= 0.0 {
            self
        } else if self.upper <= 0.0 {
            -self
        } else {
            Self { lower: 0.0, upper: self.upper.max(-self.lower) }
        }
    }

    /// `min(x, y)` for all pairs of elements.
    pub fn min(self, other: Self) -> Self {
        Self { lower: self.lower.min(other.lower), upper: self.upper.min(other.upper) }
    }

    /// `max(x, y)` for all pairs of elements.
    pub fn max(self, other: Self) -> Self {
        Self { lower: self.lower.max(other.lower), upper: self.upper.max(other.upper) }
    }

    fn ends(self) -> (f64, f64) {
        (self.lower, self.upper)
    }
}

impl std::ops::Neg for Interval {
    type Output = Self;

    fn neg(self) -> Self {
        Self { lower: -self.upper, upper: -self.lower }
    }
}

impl std::ops::Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { lower: add_down(self.lower, other.lower), upper: add_up(self.upper, other.upper) }
    }
}

impl std::ops::Sub for Interval {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl std::ops::Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let ((a, b), (c, d)) = (self.ends(), other.ends());
        if a >= 0.0 && c >= 0.0 {
            return Self { lower: mul_down(a, c), upper: mul_up(b, d) };
        }
        let lower = mul_down(a, c).min(mul_down(a, d)).min(mul_down(b, c)).min(mul_down(b, d));
        let upper = mul_up(a, c).max(mul_up(a, d)).max(mul_up(b, c)).max(mul_up(b, d));
        Self { lower, upper }
    }
}

impl std::ops::Div for Interval {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        if other.contains(0.0) {
            return Self::EVERYTHING;
        }
        let ((a, b), (c, d)) = (self.ends(), other.ends());
        let lower = div_down(a, c).min(div_down(a, d)).min(div_down(b, c)).min(div_down(b, d));
        let upper = div_up(a, c).max(div_up(a, d)).max(div_up(b, c)).max(div_up(b, d));
        Self { lower, upper }
    }
}
