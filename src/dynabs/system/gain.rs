//! A gain for local feedback that makes images small.

use nalgebra::DMatrix;

/// Rounds of one pass over all entries; two or three settle it.
const ROUNDS: usize = 50;

/// A gain `K` (`p×n`) with small `Σ_j Σ_k |A − BK|_jk w_k / w_j`: the widths of the image of a cell with widths `w`, each
/// counted in cells, where feedback may move input `i` by at most `budget_i`: `Σ_k |K_ik| w_k / 2 ≤ budget_i`.
///
/// Every entry in turn takes its best value for the others (a weighted median: the sum is piecewise linear in
/// it); then rows that use too much are scaled down. No optimum is promised and none is needed: any gain is
/// sound.
pub fn narrowing_gain(a: &DMatrix<f64>, b: &DMatrix<f64>, widths: &[f64], budget: &[f64]) -> DMatrix<f64> {
    let (n, p) = (a.nrows(), b.ncols());
    let mut gain = DMatrix::zeros(p, n);
    for _ in 0..ROUNDS {
        let mut changed = false;
        for k in 0..n {
            for i in 0..p {
                let best = best_entry(a, b, widths, &gain, i, k);
                changed |= best != gain[(i, k)];
                gain[(i, k)] = best;
            }
        }
        if !changed {
            break;
        }
    }
    for i in 0..p {
        let used: f64 = (0..n).map(|k| gain[(i, k)].abs() * widths[k] / 2.0).sum();
        if used > budget[i] {
            gain.row_mut(i).scale_mut(budget[i] / used);
        }
    }
    gain
}

/// The `K_ik` that minimises `Σ_j |r_j − B_ji K_ik| / w_j`, where `r` is column `k` of `A − BK` without this entry; the
/// one nearest to 0 if there are several.
fn best_entry(
    a: &DMatrix<f64>,
    b: &DMatrix<f64>,
    widths: &[f64],
    gain: &DMatrix<f64>,
    i: usize,
    k: usize,
) -> f64 {
    let rest = |j: usize| {
        (0..b.ncols())
            .filter(|&other| other != i)
            .fold(a[(j, k)], |sum, other| sum - b[(j, other)] * gain[(other, k)])
    };
    let sum =
        |entry: f64| (0..a.nrows()).map(|j| (rest(j) - b[(j, i)] * entry).abs() / widths[j]).sum::<f64>();
    let breaks = (0..a.nrows()).filter(|&j| b[(j, i)] != 0.0).map(|j| rest(j) / b[(j, i)]);
    breaks.fold(0.0, |best: f64, entry| {
        let (of_best, of_entry) = (sum(best), sum(entry));
        let better = of_entry < of_best * (1.0 - 1e-12)
            || of_entry <= of_best * (1.0 + 1e-12) && entry.abs() < best.abs();
        if better { entry } else { best }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn with_room_a_fully_actuated_system_gets_dead_beat_feedback() {
        let a = DMatrix::from_row_slice(2, 2, &[1.0, 0.5, -0.3, 0.8]);
        let b = DMatrix::from_row_slice(2, 2, &[0.5, 0.0, 0.0, 0.25]);
        let gain = narrowing_gain(&a, &b, &[1.0, 2.0], &[1e3, 1e3]);
        assert!((&a - &b * gain).norm() < 1e-12);
    }

    #[test]
    fn without_room_rows_are_scaled() {
        let a = DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 0.0, 1.0]);
        let b = DMatrix::from_row_slice(2, 1, &[0.5, 1.0]);
        let gain = narrowing_gain(&a, &b, &[0.5, 0.5], &[10.0]);
        assert_eq!((gain[(0, 0)], gain[(0, 1)]), (0.0, 1.0));
        let gain = narrowing_gain(&a, &b, &[0.5, 0.5], &[0.1]);
        assert!((gain[(0, 1)] - 0.4).abs() < 1e-15);
        assert_eq!(narrowing_gain(&a, &DMatrix::zeros(2, 0), &[0.5, 0.5], &[]).len(), 0);
    }
}
