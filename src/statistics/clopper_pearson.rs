//! One-sided Clopper–Pearson bounds, rounded outwards.

use super::binomial::{ln_lower_tail, ln_upper_tail};
use crate::numeric::{one_minus_down, one_minus_up};

/// Brackets end when they are this narrow, relative to their position.
const PRECISION: f64 = 1e-14;

/// A lower confidence bound for a probability: `P(p < lower) ≤ level`.
///
/// With `k` successes in `n` independent trials, the largest `p` with `P(Bin(n, p) ≥ k) ≤ level`
/// (0 if `k = 0`; DLMF 8.17.5 makes it the quantile `I⁻¹(level; k, n−k+1)`). The tail itself is bounded
/// from above and the solution bracketed, so the result never exceeds the exact bound; it falls short of
/// it by less than 1e-9 of it for `n ≤ 10⁷`, `level ≥ 10⁻¹⁵`. Expects `k ≤ n` and `0 < level ≤ ½`; a
/// level of 0 gives 0.
pub fn lower_bound(k: u64, n: u64, level: f64) -> f64 {
    if k == 0 || level.is_nan() || level <= 0.0 {
        0.0
    } else if 2 * k > n {
        one_minus_down(solve_upper(n - k, n, level))
    } else {
        solve_lower(k, n, level)
    }
}

/// An upper confidence bound for a probability: `P(p > upper) ≤ level`.
///
/// With `k` successes in `n` independent trials, the smallest `p` with `P(Bin(n, p) ≤ k) ≤ level`
/// (1 if `k = n`), rounded outwards like [`lower_bound`].
pub fn upper_bound(k: u64, n: u64, level: f64) -> f64 {
    if k == n || level.is_nan() || level <= 0.0 {
        1.0
    } else if 2 * k > n {
        one_minus_up(solve_lower(n - k, n, level))
    } else {
        solve_upper(k, n, level)
    }
}

/// The largest `p` found with `P(Bin(n, p) ≥ k) ≤ level`, for `1 ≤ k ≤ n/2`.
fn solve_lower(k: u64, n: u64, level: f64) -> f64 {
    let target = level.ln().next_down();
    let tail = |p: f64| ln_upper_tail(k, n, p, target + 50.0) - target;
    let mut outside = k as f64 / n as f64;
    if tail(outside) <= 0.0 {
        return outside;
    }
    // P(X ≥ k) ≤ (n choose k) pᵏ: going down geometrically in p must succeed.
    let mut factor = 0.5;
    let mut inside = outside * factor;
    while tail(inside) > 0.0 {
        outside = inside;
        factor *= factor;
        inside *= factor;
        if inside == 0.0 {
            return 0.0;
        }
    }
    bracket(tail, inside, outside)
}

/// The smallest `p` found with `P(Bin(n, p) ≤ k) ≤ level`, for `0 ≤ k ≤ n/2`, `k < n`.
fn solve_upper(k: u64, n: u64, level: f64) -> f64 {
    let target = level.ln().next_down();
    let tail = |p: f64| ln_lower_tail(k, n, p, target + 50.0) - target;
    let mut outside = (k as f64 + 0.1) / n as f64;
    if outside >= 1.0 {
        outside = 0.5;
    }
    let mut step = ((k + 1) as f64).sqrt() / n as f64;
    let mut inside = outside + step;
    while inside < 1.0 && tail(inside) > 0.0 {
        outside = inside;
        step *= 2.0;
        inside += step;
    }
    if inside >= 1.0 {
        // The bound is close to 1: halve the distance to it instead.
        let mut distance = 1.0 - outside;
        loop {
            distance *= 0.5;
            inside = 1.0 - distance;
            if inside >= 1.0 {
                return 1.0;
            }
            if tail(inside) <= 0.0 {
                break;
            }
            outside = inside;
        }
    }
    bracket(tail, inside, outside)
}

/// Narrows a bracket around the zero of a monotone function and returns its end where the function is ≤ 0.
///
/// Regula falsi with the Illinois modification on `(ln p, ln tail)`, where tails are nearly straight;
/// bisection in every fourth round, so that the bracket shrinks whatever the function does. A new point
/// keeps a distance from both ends: when one end is on the zero, the next point encloses it.
fn bracket(excess: impl Fn(f64) -> f64, mut inside: f64, mut outside: f64) -> f64 {
    let (mut f_inside, mut f_outside) = (excess(inside), excess(outside));
    let mut last_was_inside = None;
    for round in 1..400 {
        let (low, high) = (inside.min(outside), inside.max(outside));
        let gap = PRECISION * low;
        if high - low <= 2.0 * gap {
            break;
        }
        let (x, y) = (inside.ln(), outside.ln());
        let secant = (x - f_inside * (y - x) / (f_outside - f_inside)).exp();
        let usable = round % 4 != 0 && secant.is_finite();
        let middle = if usable { secant } else { low + 0.5 * (high - low) }.clamp(low + gap, high - gap);
        let value = excess(middle);
        let is_inside = value <= 0.0;
        if is_inside {
            (inside, f_inside) = (middle, value);
        } else {
            (outside, f_outside) = (middle, value);
        }
        if last_was_inside == Some(is_inside) {
            *(if is_inside { &mut f_outside } else { &mut f_inside }) *= 0.5;
        }
        last_was_inside = Some(is_inside);
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn closed_forms() {
        // k = 0: upper = 1 − level^(1/n); k = n: lower = level^(1/n).
        for (n, level) in [(1u64, 0.5f64), (10, 0.01), (1600, 1e-9), (10_000_000, 1e-15)] {
            let exact = -((level.ln() / n as f64).exp_m1());
            let upper = upper_bound(0, n, level);
            assert!(upper >= exact * (1.0 - 1e-15) && upper <= exact * (1.0 + 1e-10), "{n} {level}");
            let lower = lower_bound(n, n, level);
            assert!((lower - (1.0 - exact)).abs() < 1e-10 && lower <= 1.0 - exact + 1e-15);
            assert_eq!(lower_bound(0, n, level), 0.0);
            assert_eq!(upper_bound(n, n, level), 1.0);
        }
    }

    #[test]
    fn bounds_are_extreme_but_finite() {
        let tiny = lower_bound(1, 10_000_000, 1e-15);
        assert!(tiny > 0.0 && (tiny / 1e-22 - 1.0).abs() < 1e-6, "{tiny:e}");
        // 1 − 10⁻²² is 1 in doubles: rounding outwards may lose what doubles cannot say.
        assert_eq!(upper_bound(9_999_999, 10_000_000, 1e-15), 1.0);
        assert!(upper_bound(0, 1, 1e-15) < 1.0);
    }

    proptest! {
        #[test]
        fn bounds_solve_their_equation(n in 1u64..3000, share in 0.0f64..=1.0, exponent in 0.31f64..15.0) {
            let (k, level) = ((n as f64 * share) as u64, 10f64.powf(-exponent));
            let (lower, upper) = (lower_bound(k, n, level), upper_bound(k, n, level));
            prop_assert!(0.0 <= lower && lower <= k as f64 / n as f64);
            prop_assert!(k as f64 / n as f64 <= upper && upper <= 1.0);
            if 0 < k {
                prop_assert!(ln_upper_tail(k, n, lower, 1.0) <= level.ln() + 1e-9);
                prop_assert!(ln_upper_tail(k, n, lower * (1.0 + 1e-9), 1.0) > level.ln() || lower > 0.999_999);
            }
            if k < n && upper < 0.999_999 {
                prop_assert!(ln_lower_tail(k, n, upper, 1.0) <= level.ln() + 1e-9);
                prop_assert!(ln_lower_tail(k, n, upper * (1.0 - 1e-9), 1.0) > level.ln());
            }
        }
    }
}
