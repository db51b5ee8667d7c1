//! Tails of the binomial distribution, bounded from above.

use std::f64::consts::PI;

/// `ln n! − ln(√(2πn) (n/e)ⁿ)` for `1 ≤ n ≤ 15` (index 0 is unused).
const STIRLING_ERROR: [f64; 16] = [
    0.0,
    0.081_061_466_795_327_26,
    0.041_340_695_955_409_29,
    0.027_677_925_684_998_34,
    0.020_790_672_103_765_093,
    0.016_644_691_189_821_193,
    0.013_876_128_823_070_748,
    0.011_896_709_945_891_77,
    0.010_411_265_261_972_096,
    0.009_255_462_182_712_733,
    0.008_330_563_433_362_87,
    0.007_573_675_487_951_841,
    0.006_942_840_107_209_53,
    0.006_408_994_188_004_207,
    0.005_951_370_112_758_848,
    0.005_554_733_551_962_801,
];

/// The error of Stirling's formula for `ln n!`, `n ≥ 1` (DLMF 5.11.1).
fn stirling_error(n: u64) -> f64 {
    if let Some(&error) = STIRLING_ERROR.get(n as usize) {
        return error;
    }
    let x = n as f64;
    let s = 1.0 / (x * x);
    (1.0 / 12.0 - s * (1.0 / 360.0 - s * (1.0 / 1260.0 - s * (1.0 / 1680.0 - s / 1188.0)))) / x
}

/// `x ln(x / m) + m − x ≥ 0`, without cancellation where `x ≈ m`.
fn deviance(x: f64, m: f64) -> f64 {
    if (x - m).abs() >= 0.1 * (x + m) {
        return x * (x / m).ln() + m - x;
    }
    // With v = (x − m) / (x + m): ln(x / m) = 2 artanh v, expanded.
    let v = (x - m) / (x + m);
    let mut sum = (x - m) * v;
    let mut power = 2.0 * x * v;
    for j in 1.. {
        power *= v * v;
        let next = sum + power / f64::from(2 * j + 1);
        if next == sum {
            break;
        }
        sum = next;
    }
    sum
}

/// A number known to a relative error, in logarithms: the truth is at most `ln + error`.
struct Bounded {
    ln: f64,
    error: f64,
}

/// `ln P(X = k)` for `X ~ Bin(n, p)`, by the saddle-point expansion (Loader, *Fast and Accurate
/// Computation of Binomial Probabilities*, 2000).
///
/// The error covers the rounding of `n p` and `n (1 − p)`, which the deviances amplify by their
/// distance from `k` and `n − k`.
fn ln_mass(k: u64, n: u64, p: f64) -> Bounded {
    let q = 1.0 - p;
    let (kf, nf) = (k as f64, n as f64);
    let unit = f64::EPSILON;
    if k == 0 {
        let ln = nf * (-p).ln_1p();
        return Bounded { ln, error: 8.0 * unit * (1.0 + ln.abs()) };
    }
    if k == n {
        let ln = nf * p.ln();
        return Bounded { ln, error: 8.0 * unit * (1.0 + ln.abs()) };
    }
    let rest = (n - k) as f64;
    let (below, above) = (deviance(kf, nf * p), deviance(rest, nf * q));
    let correction = stirling_error(n) - stirling_error(k) - stirling_error(n - k);
    let ln = correction - below - above - 0.5 * (2.0 * PI * kf * (rest / nf)).ln();
    let amplified = (kf - nf * p).abs() + (rest - nf * q).abs();
    let cancelled = if (kf - nf * p).abs() >= 0.1 * (kf + nf * p) { kf + nf * p } else { 0.0 };
    let error = 16.0 * unit * (1.0 + below + above + ln.abs() + amplified + cancelled);
    Bounded { ln, error }
}

/// Sums `1 + r₀ + r₀r₁ + …` for a ratio that falls with every term, and bounds what is left out.
///
/// Returns the logarithm of an upper bound of the sum, or of a lower bound of it that exceeds
/// `enough` already.
fn ln_series(ratio: impl Fn(f64) -> f64, enough: f64) -> f64 {
    let (mut term, mut sum, mut scale) = (1.0f64, 1.0f64, 0.0f64);
    for i in 0u64.. {
        let r = ratio(i as f64);
        term *= r;
        sum += term;
        if r < 1.0 && term * r <= 1e-17 * sum * (1.0 - r) {
            break;
        }
        if sum > 1e200 {
            (term, sum, scale) = (term * 1e-200, sum * 1e-200, scale + 200.0 * std::f64::consts::LN_10);
        }
        if i % 16 == 15 && scale + sum.ln() > enough {
            break;
        }
    }
    // One rounding per product and sum over the terms that matter, which are fewer than 2⁴⁰ in any case:
    // later terms of a falling sequence are relatively exact to (index · 2⁻⁵²) and weigh less and less.
    scale + sum.ln()
}

/// An upper bound of `ln P(X ≥ k)` for `X ~ Bin(n, p)`, `1 ≤ k ≤ n`, `0 < p < 1`.
///
/// Exceeds the true value by about `1e-13 + 1e-15 |k − np|`. The sum is abandoned once it is above
/// `enough`; the result is then only known to be above `enough` too.
pub fn ln_upper_tail(k: u64, n: u64, p: f64, enough: f64) -> f64 {
    let mass = ln_mass(k, n, p);
    let odds = p / (1.0 - p);
    let (rest, k) = ((n - k) as f64, k as f64);
    let series = ln_series(|i| (rest - i).max(0.0) / (k + i + 1.0) * odds, enough - mass.ln);
    mass.ln + series + mass.error + series_error(series, (k - n as f64 * p).abs(), n)
}

/// An upper bound of `ln P(X ≤ k)` for `X ~ Bin(n, p)`, `0 ≤ k < n`, `0 < p < 1`.
///
/// The mirror image of [`ln_upper_tail`].
pub fn ln_lower_tail(k: u64, n: u64, p: f64, enough: f64) -> f64 {
    let mass = ln_mass(k, n, p);
    let odds = (1.0 - p) / p;
    let (rest, k) = ((n - k) as f64, k as f64);
    let series = ln_series(|i| (k - i).max(0.0) / (rest + i + 1.0) * odds, enough - mass.ln);
    mass.ln + series + mass.error + series_error(series, (k - n as f64 * p).abs(), n)
}

/// A bound on the relative rounding error of a series whose sum has this logarithm.
///
/// Term `i` carries `4 i` roundings. The terms of a falling tail decay at least geometrically once past
/// the mode, on the scale `√n`; the weighted mean index is below `√n + distance to the mode`.
fn series_error(ln_sum: f64, distance: f64, n: u64) -> f64 {
    4.0 * f64::EPSILON * (4.0 + ln_sum.abs() + 2.0 * (n as f64).sqrt() + distance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use statrs::distribution::{Binomial, DiscreteCDF};

    #[test]
    fn stirling_error_by_recurrence() {
        // δ(n) − δ(n+1) = (n + ½) ln(1 + 1/n) − 1.
        for n in 1u64..40 {
            let x = n as f64;
            let step = (x + 0.5) * (1.0 / x).ln_1p() - 1.0;
            assert!((stirling_error(n) - stirling_error(n + 1) - step).abs() < 4e-15, "n = {n}");
        }
    }

    #[test]
    fn tails_of_a_coin() {
        // P(X ≥ 3) of four fair tosses is 5/16, P(X ≤ 1) likewise.
        let expected = (5.0f64 / 16.0).ln();
        assert!((ln_upper_tail(3, 4, 0.5, 0.0) - expected).abs() < 1e-12);
        assert!((ln_lower_tail(1, 4, 0.5, 0.0) - expected).abs() < 1e-12);
        assert!(ln_upper_tail(3, 4, 0.5, 0.0) >= expected);
    }

    proptest! {
        /// Where statrs is at home (no far tail), it is an independent witness.
        #[test]
        fn tails_agree_with_statrs(n in 2u64..500, share in 0.05f64..0.95, p in 0.05f64..0.95) {
            let k = ((n as f64 * share) as u64).clamp(1, n - 1);
            let witness = Binomial::new(p, n).unwrap();
            let upper = witness.sf(k - 1);
            if upper > 1e-10 {
                prop_assert!((ln_upper_tail(k, n, p, 1.0) - upper.ln()).abs() < 1e-9);
            }
            let lower = witness.cdf(k);
            if lower > 1e-10 {
                prop_assert!((ln_lower_tail(k, n, p, 1.0) - lower.ln()).abs() < 1e-9);
            }
        }
    }
}
