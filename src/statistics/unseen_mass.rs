//! How much probability can lie where no sample was seen.

use super::clopper_pearson::upper_bound;

/// An upper bound `ε` on `P(η ∉ W)` for the bounding box `W ⊂ ℝⁿ` of `samples` samples:
/// `P(P(η ∉ W) > ε) ≤ level`.
///
/// `ε` solves `Σ_{i<2n} C(N,i) εⁱ (1−ε)^{N−i} = level`: it is the Clopper–Pearson upper bound for `2n − 1`
/// misses. Proof: shrink a box from outside, one of the `2n` sides at a time, until it touches a sample not
/// yet touched; the mass cut off is the sum of `2n` spacings, so `P(W)` is stochastically at least
/// `Beta(N − 2n + 1, 2n)` whatever the distribution (Tukey's statistically equivalent blocks, *Ann. Math.
/// Stat.* 18, 1947; ties only help, since `W` is closed). This is also the scenario bound with `2n` support
/// constraints (Campi and Garatti, *SIAM J. Optim.* 19, 2008).
///
/// 1 if there are fewer than `2n` samples.
pub fn unseen_mass(dimension: usize, samples: u64, level: f64) -> f64 {
    let misses = 2 * dimension as u64 - 1;
    if misses >= samples { 1.0 } else { upper_bound(misses, samples, level) }
}
