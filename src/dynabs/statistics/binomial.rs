//! Tails of the binomial distribution, bounded from above.
//!
//! Errors are counted in units `u = 2⁻⁵³`. The standard operations err by at most `u` of their result;
//! `ln` and `ln_1p` are trusted to `4 u`, which every common mathematical library keeps several times over.
//! Terms in `u²` are left to the slack of the constants: all counts are at most 10⁷, so `10⁷ u < 10⁻⁸`.

use imdp::numeric::UNIT_ROUNDOFF;
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

/// The error of Stirling's formula for `ln n!`, `n ≥ 1` (DLMF 5.11.1), up to `1.3 u`.
///
/// The series alternates and is cut off after five terms, so it errs by less than the sixth: by
/// `691 / 360360 · 16⁻¹¹ < 1.1·10⁻¹⁶ = u` for `n ≥ 16`; rounding adds a few units of values below 0.1.
fn stirling_error(n: u64) -> f64 {
    if let Some(&error) = STIRLING_ERROR.get(n as usize) {
        return error;
    }
    let x = n as f64;
    let s = 1.0 / (x * x);
    (1.0 / 12.0 - s * (1.0 / 360.0 - s * (1.0 / 1260.0 - s * (1.0 / 1680.0 - s / 1188.0)))) / x
}

/// A success probability `p` and `q = 1 − p`: the smaller is exactly the double, the larger is rounded.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chance {
    pub(super) p: f64,
    pub(super) q: f64,
}

impl Chance {
    /// `p` near `1 / (1 + e⁻ᶻ)`; which double exactly does not matter.
    pub(super) fn from_log_odds(z: f64) -> Self {
        let smaller = 1.0 / (1.0 + z.abs().exp());
        let larger = 1.0 - smaller;
        if z < 0.0 { Self { p: smaller, q: larger } } else { Self { p: larger, q: smaller } }
    }

    fn ln_p(self) -> f64 {
        if self.p < self.q { self.p.ln() } else { (-self.q).ln_1p() }
    }
}

/// A number that is known up to `± error`.
#[derive(Clone, Copy, Debug)]
struct Approximate {
    value: f64,
    error: f64,
}

/// `x ln(x / m) + m − x ≥ 0`, without cancellation where `x ≈ m`; `x` is exact, `m` known to `2 u`.
fn deviance(x: f64, m: f64) -> Approximate {
    let distance = (x - m).abs();
    // The derivative by m is (m − x) / m: the error of m costs at most 2 u |x − m|.
    let inherited = 3.0 * UNIT_ROUNDOFF * distance;
    if distance >= 0.1 * (x + m) {
        // The quotient costs u x, logarithm and product 5 u x |ln|, the sums u (D + x) and u D. From
        // D ≥ 0 follows x |ln(x/m)| ≤ D + x + m: together below 7 u (D + x + m).
        let value = x * (x / m).ln() + m - x;
        return Approximate { value, error: 8.0 * UNIT_ROUNDOFF * (value + x + m) + inherited };
    }
    // With v = (x − m) / (x + m), |v| < 0.1: ln(x / m) = 2 artanh v, expanded. x − m is exact (Sterbenz);
    // the first term errs by 3 u of itself, the others, below 4 % of it, by a few u more, and each of at
    // most ten sums by u: together below 15 u.
    let v = (x - m) / (x + m);
    let mut sum = (x - m) * v;
    let mut power = 2.0 * x * v;
    for j in 1..20 {
        power *= v * v;
        let next = sum + power / f64::from(2 * j + 1);
        if next == sum {
            break;
        }
        sum = next;
    }
    Approximate { value: sum, error: 16.0 * UNIT_ROUNDOFF * sum + inherited }
}

/// `ln P(X = k)` for `X ~ Bin(n, p)`, `1 ≤ k ≤ n`, by the saddle-point expansion (Loader, *Fast and Accurate
/// Computation of Binomial Probabilities*, 2000).
fn ln_mass(k: u64, n: u64, chance: Chance) -> Approximate {
    let (kf, nf) = (k as f64, n as f64);
    if k == n {
        let value = nf * chance.ln_p();
        return Approximate { value, error: 8.0 * UNIT_ROUNDOFF * value.abs() };
    }
    let rest = (n - k) as f64;
    // One of p and q is exact, the other rounded: n p and n q are known to 2 u.
    let (below, above) = (deviance(kf, nf * chance.p), deviance(rest, nf * chance.q));
    let correction = stirling_error(n) - stirling_error(k) - stirling_error(n - k);
    let width = 0.5 * (2.0 * PI * kf * (rest / nf)).ln();
    let value = correction - below.value - above.value - width;
    // `correction` errs by 5 u. `width` errs by 3 u from its argument and 4 u of itself. As k (n−k)/n ≥ ½,
    // all terms but the correction, which is below ¼, have one sign: no sum exceeds |value| + ½.
    let error = below.error + above.error + 12.0 * UNIT_ROUNDOFF * (2.0 + value.abs());
    Approximate { value, error }
}

/// `P(X ≥ k)` for `X ~ Bin(n, p)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct UpperTail {
    /// An upper bound of its logarithm; infinite if it exceeds the mass at `k` more than 10³⁰⁸ times.
    pub(super) ln: f64,
    /// The bound exceeds the logarithm by at most twice this.
    pub(super) error: f64,
    /// The derivative of the logarithm by `ln(p / q)`, not rigorous.
    pub(super) slope: f64,
}

/// `P(X ≥ k)` for `X ~ Bin(n, p)`, `1 ≤ k ≤ n`: the mass at `k` times a series `S` of ratios.
///
/// `S = 1 + r₀ + r₀ r₁ + …` with `r_i = (n−k−i)/(k+i+1) · p/q`, all positive and falling. As
/// `dP(X ≥ k)/dp = (k/p) P(X = k)` (DLMF 8.17.1 and 8.17.5), the
/// logarithm has the derivative `k q / S` by `ln(p/q)`.
pub(super) fn upper_tail(k: u64, n: u64, chance: Chance) -> UpperTail {
    let mass = ln_mass(k, n, chance);
    let odds = chance.p / chance.q;
    let (rest, kf) = ((n - k) as f64, k as f64);
    let (mut term, mut sum, mut i) = (1.0f64, 1.0f64, 0.0f64);
    while i < rest {
        let ratio = (rest - i) / (kf + i + 1.0) * odds;
        term *= ratio;
        sum += term;
        i += 1.0;
        // Ratios fall, so what is left out is below term · ratio / (1 − ratio). The 10⁻⁹ keeps the rounding
        // of the ratio out of 1 − ratio. An infinite sum is an upper bound as well.
        if (ratio < 1.0 - 1e-9 && term * ratio <= 1e-17 * sum * (1.0 - ratio)) || sum > f64::MAX {
            break;
        }
    }
    let series = sum.ln();
    // A ratio errs by 4 u, a term thus by at most 5 i u, and each of i sums by u of the sum: 6 i u in all. The
    // remainder is below 10⁻¹⁷ < u, the logarithm errs by 4 u of itself, putting together by u of each.
    let rounding = 7.0 * i + 2.0 + 8.0 * series + 4.0 * mass.value.abs();
    let error = mass.error + UNIT_ROUNDOFF * rounding;
    UpperTail { ln: mass.value + series + error, error, slope: kf * chance.q / sum }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use statrs::distribution::{Binomial, DiscreteCDF};

    fn log_odds(p: f64) -> f64 {
        (p / (1.0 - p)).ln()
    }

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
    fn tail_of_a_coin() {
        // P(X ≥ 3) of four fair tosses is 5/16.
        let expected = (5.0f64 / 16.0).ln();
        let tail = upper_tail(3, 4, Chance::from_log_odds(0.0));
        assert!(tail.ln >= expected && tail.ln <= expected + 2.0 * tail.error + 1e-16);
    }

    proptest! {
        /// Where statrs is at home (no far tail), it is an independent witness.
        #[test]
        fn tails_agree_with_statrs(n in 2u64..500, share in 0.05f64..0.95, p in 0.05f64..0.95) {
            let k = ((n as f64 * share) as u64).clamp(1, n - 1);
            let chance = Chance::from_log_odds(log_odds(p));
            let witness = Binomial::new(chance.p, n).unwrap().sf(k - 1);
            if witness > 1e-10 && witness < 1.0 - 1e-10 {
                prop_assert!((upper_tail(k, n, chance).ln - witness.ln()).abs() < 1e-9);
            }
        }

        #[test]
        fn the_slope_is_the_derivative(n in 2u64..500, share in 0.0f64..1.0, z in -4.0f64..4.0) {
            let k = ((n as f64 * share) as u64).clamp(1, n);
            let at = |z| upper_tail(k, n, Chance::from_log_odds(z));
            prop_assume!(at(z + 1e-5).ln < f64::INFINITY);
            let difference = (at(z + 1e-5).ln - at(z - 1e-5).ln) / 2e-5;
            prop_assert!((at(z).slope - difference).abs() < 1e-5 * (1.0 + difference.abs()));
        }
    }
}
