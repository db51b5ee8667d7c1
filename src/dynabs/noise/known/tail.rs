//! Upper tails of the distributions that are symmetric about their center.

use super::Distribution;
use crate::system::Interval;
use imdp::numeric::Rational;

/// `P(η ≥ mean + distance)` of a symmetric distribution, for `distance ≥ 0`.
pub(super) fn upper_tail(of: &Distribution, distance: &Rational) -> Option<Interval> {
    let exact = |x: &Rational| Interval::enclosing(x, x);
    let two = Interval::point(2.0);
    let tail = match of {
        // erfc(√(z² / 2σ²)) / 2
        Distribution::Gaussian { variance, .. } => {
            let square = distance * distance / (variance + variance);
            complementary_error_function(exact(&square).sqrt()) / two
        }
        Distribution::Laplace { scale, .. } => (-exact(&(distance / scale))).exp() / two,
        Distribution::Logistic { scale, .. } => {
            let one = Interval::point(1.0);
            one / (one + exact(&(distance / scale)).exp())
        }
        Distribution::StudentT { scale, degrees, .. } => student_tail(&(distance / scale), *degrees),
        _ => return None,
    };
    Some(tail.meet(Interval::new(0.0, 0.5)))
}

/// It falls, and the library's is correctly rounded.
fn complementary_error_function(x: Interval) -> Interval {
    let (low, high) = (core_math::erfc(x.upper()), core_math::erfc(x.lower()));
    Interval::new(low.next_down().max(0.0), high.next_up())
}

/// Student's tail for whole degrees of freedom: a finite sum (Abramowitz and Stegun 26.7.3 and 26.7.4).
///
/// With `tan θ = t/√ν`, `P(|T| < t)` is for even `ν`: `sin θ (1 + ½ cos² θ + … + (1·3⋯(ν−3))/(2·4⋯(ν−2)) cos^{ν−2} θ)`,
/// for odd `ν`: `(2/π) (θ + sin θ (cos θ + ⅔ cos³ θ + … + (2·4⋯(ν−3))/(1·3⋯(ν−2)) cos^{ν−2} θ))`.
fn student_tail(t: &Rational, degrees: u32) -> Interval {
    let nu = Rational::from_integer(degrees.into());
    let exact = |x: &Rational| Interval::enclosing(x, x);
    let sum = &nu + t * t;
    let cos_squared = exact(&(&nu / &sum));
    let sin = exact(&(t * t / &sum)).sqrt();
    let is_even = degrees.is_multiple_of(2);
    let mut term = if is_even { Interval::point(1.0) } else { cos_squared.sqrt() };
    let mut series = Interval::ZERO;
    let mut factor = if is_even { 1 } else { 2 };
    for _ in 0..if is_even { degrees / 2 } else { (degrees - 1) / 2 } {
        series = series + term;
        let ratio = Interval::point(f64::from(factor)) / Interval::point(f64::from(factor + 1));
        term = term * cos_squared * ratio;
        factor += 2;
    }
    let inside = if is_even {
        sin * series
    } else {
        let angle = exact(&(t * t / &nu)).sqrt().atan();
        (angle + sin * series) * Interval::point(2.0) / Interval::PI
    };
    (Interval::point(1.0) - inside).max(Interval::ZERO) / Interval::point(2.0)
}
