//! Arithmetic with bounds, rounded outwards.

use crate::property::BinaryOperator;

/// Bounds on a number.
pub(super) type Interval = (f64, f64);

const EVERYTHING: Interval = (f64::NEG_INFINITY, f64::INFINITY);

/// `+ - * /` of all numbers within the bounds.
pub(super) fn arithmetic(operator: BinaryOperator, (a, b): Interval, (c, d): Interval) -> Interval {
    match operator {
        BinaryOperator::Add => outward(a + c, b + d),
        BinaryOperator::Subtract => outward(a - d, b - c),
        BinaryOperator::Multiply => hull([(a, c), (a, d), (b, c), (b, d)].map(|(x, y)| product(x, y))),
        BinaryOperator::Divide if c > 0.0 || d < 0.0 => hull([a / c, a / d, b / c, b / d]),
        _ => EVERYTHING,
    }
}

/// 0 times infinity is 0: the bound stands for finite numbers as large as one likes.
fn product(x: f64, y: f64) -> f64 {
    if x == 0.0 || y == 0.0 { 0.0 } else { x * y }
}

fn hull(ends: [f64; 4]) -> Interval {
    let lower = ends.into_iter().fold(f64::INFINITY, f64::min);
    let upper = ends.into_iter().fold(f64::NEG_INFINITY, f64::max);
    if ends.into_iter().any(f64::is_nan) { EVERYTHING } else { outward(lower, upper) }
}

/// What is not a number bounds nothing.
fn outward(lower: f64, upper: f64) -> Interval {
    let down = |x: f64| if x.is_nan() { f64::NEG_INFINITY } else { x.next_down() };
    let up = |x: f64| if x.is_nan() { f64::INFINITY } else { x.next_up() };
    // Infinity is meant as it is: what is infinite stays so.
    let lower = if lower == f64::INFINITY { lower } else { down(lower) };
    let upper = if upper == f64::NEG_INFINITY { upper } else { up(upper) };
    (lower, upper)
}

/// Floor, ceiling and the like: functions that do not decrease.
pub(super) fn monotone(function: fn(f64) -> f64, (lower, upper): Interval) -> Interval {
    (function(lower), function(upper))
}

/// The nearest integer, halves upwards; `x + 0.5` would round by itself, away from what is asked where its sum is no double.
pub(super) fn half_up(x: f64) -> f64 {
    let below = x.floor();
    if x - below >= 0.5 { below + 1.0 } else { below }
}

#[cfg(test)]
mod tests {
    use super::half_up;

    #[test]
    fn rounding_is_exact() {
        let large = 4503599627370497.0;
        for (x, expected) in
            [(0.49999999999999994, 0.0), (0.5, 1.0), (-0.5, 0.0), (-0.51, -1.0), (large, large)]
        {
            assert_eq!(half_up(x), expected, "{x}");
        }
        assert_eq!(half_up(f64::INFINITY), f64::INFINITY);
    }
}
