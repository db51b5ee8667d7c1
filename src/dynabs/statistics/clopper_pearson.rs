//! One-sided Clopper–Pearson bounds, rounded outwards.

use super::binomial::{Chance, upper_tail};
use imdp::numeric::{UNIT_ROUNDOFF, one_minus_down, one_minus_up};

/// Newton's method needs three to six steps; this many are never needed.
const MAX_STEPS: usize = 60;

/// Probabilities from `10⁻²⁸²` to `1 − 10⁻²⁸²`: beyond, doubles lose precision.
const MAX_LOG_ODDS: f64 = 650.0;

/// A lower confidence bound for a probability: `P(p < lower) ≤ level`.
///
/// With `k` successes in `n` independent trials, the largest `p` with `P(Bin(n, p) ≥ k) ≤ level`
/// (0 if `k = 0`; DLMF 8.17.5 makes it the quantile `I⁻¹(level; k, n−k+1)`). The tail itself is bounded
/// from above, so the result never exceeds the exact bound; it falls short of it by less than 1e-11 of
/// `min(p, 1−p)` for `n ≤ 10⁷`, `level ≥ 10⁻¹⁵`, or by what rounding to a double costs. Expects `k ≤ n` and
/// `0 < level ≤ ½`; a level of 0 gives 0.
pub fn lower_bound(k: u64, n: u64, level: f64) -> f64 {
    match largest_chance(k, n, level) {
        None => 0.0,
        Some(chance) if chance.p < chance.q => chance.p,
        Some(chance) => one_minus_down(chance.q),
    }
}

/// An upper confidence bound for a probability: `P(p > upper) ≤ level`.
///
/// With `k` successes in `n` independent trials, the smallest `p` with `P(Bin(n, p) ≤ k) ≤ level`
/// (1 if `k = n`): failures are successes of the opposite kind. Rounded outwards like [`lower_bound`].
pub fn upper_bound(k: u64, n: u64, level: f64) -> f64 {
    match largest_chance(n - k, n, level) {
        None => 1.0,
        Some(chance) if chance.p < chance.q => one_minus_up(chance.p),
        Some(chance) => chance.q,
    }
}

/// The largest `p` found with `P(Bin(n, p) ≥ k) ≤ level`; `None` if that is 0 or next to it.
///
/// Newton's method for `f(z) = ln P(X ≥ k) − ln level` over `z = ln(p/q)`. `f` rises, and it is concave: its
/// derivative is `k q / S`, `q` falls, and the series `S` grows with `p/q`. So a tangent lies above `f`, and
/// wherever a step starts, it ends where `f ≤ 0`; from there on steps go up to the root. Speed rests on
/// this, soundness does not: only a `p` whose tail was bounded by the level is ever returned.
fn largest_chance(k: u64, n: u64, level: f64) -> Option<Chance> {
    if k == 0 || level.is_nan() || level <= 0.0 {
        return None;
    }
    // ln errs by less than one unit in the last place.
    let target = level.ln().next_down();
    let mut z = guess(k as f64, n as f64, target);
    let mut best = None;
    for _ in 0..MAX_STEPS {
        let chance = Chance::from_log_odds(z);
        let tail = upper_tail(k, n, chance);
        let excess = tail.ln - target;
        // What neither the tail nor z can resolve: aim at twice as much below the root, and stop there.
        let blur = tail.error + 4.0 * UNIT_ROUNDOFF * z.abs() * tail.slope;
        if excess <= 0.0 {
            best = Some(chance);
            if excess >= -4.0 * blur {
                break;
            }
        }
        z = (z - (excess + 2.0 * blur) / tail.slope).clamp(-MAX_LOG_ODDS, MAX_LOG_ODDS);
    }
    best
}

/// Where to start: the log-odds of Wilson's score bound with a continuity correction.
///
/// The normal quantile `t` is Abramowitz and Stegun 26.2.23.
fn guess(k: f64, n: f64, ln_level: f64) -> f64 {
    let s = (-2.0 * ln_level).max(0.0).sqrt();
    let t = s
        - (2.515_517 + s * (0.802_853 + s * 0.010_328))
            / (1.0 + s * (1.432_788 + s * (0.189_269 + s * 0.001_308)));
    let (k, half) = (k - 0.5, 0.5 * t * t);
    let spread = t * (k * (n - k) / n + 0.5 * half).sqrt();
    // The two roots of the score equation for p multiply to k² / (n (n + t²)), those for q likewise.
    let (p, q) = (k * k / (k + half + spread), n - k + half + spread);
    (p / n * (n + t * t) / q).ln()
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
            let tail = |k, p: f64| upper_tail(k, n, Chance { p, q: 1.0 - p });
            if 0 < k && lower < 0.999_999 {
                prop_assert!(tail(k, lower).ln <= level.ln());
                prop_assert!(tail(k, lower * (1.0 + 1e-10)).ln > level.ln());
            }
            if k < n && 1e-6 < upper && upper < 0.999_999 {
                prop_assert!(tail(n - k, 1.0 - upper).ln <= level.ln() + 1e-9);
                prop_assert!(tail(n - k, (1.0 - upper) * (1.0 + 1e-9)).ln > level.ln());
            }
        }
    }
}
