//! Which cells a sub-cell's noise leads to, and with which weight.

use super::axis::Axis;
use super::taps::Taps;

/// `Σ_k p_k opt(V(i+k), V(i+k+1))` for the sub-cells `i = r q + ρ` of one place `ρ` in a cell, as sums over cells.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Weights {
    /// The weight of cell `q + offset`: both sub-cells are in it.
    pub(super) single: Vec<(i64, f64)>,
    /// The weight of the better or worse of the cells `q + offset` and `q + offset + 1`.
    pub(super) pair: Vec<(i64, f64)>,
}

impl Weights {
    /// The weights of every place in a cell.
    pub(super) fn of(axis: &Axis, taps: &Taps) -> Vec<Self> {
        (0..axis.resolution as i64).map(|place| Self::at(place, axis, taps)).collect()
    }

    fn at(place: i64, axis: &Axis, taps: &Taps) -> Self {
        let r = axis.resolution as i64;
        let mut weights = Self::default();
        for k in 0..taps.lower.len() {
            let mass = taps.mass(k);
            if mass == 0.0 {
                continue;
            }
            let sub_cell = place + taps.first + k as i64;
            let (cell, next) = (sub_cell.div_euclid(r), (sub_cell + 1).div_euclid(r));
            add(if cell == next { &mut weights.single } else { &mut weights.pair }, cell, mass);
        }
        if axis.periodic {
            let n = axis.cells as i64;
            weights.single = wrapped(&weights.single, n);
            weights.pair = wrapped(&weights.pair, n);
        }
        weights
    }
}

/// Adds to the last weight or begins a new one; sums of masses are rounded down.
fn add(weights: &mut Vec<(i64, f64)>, cell: i64, mass: f64) {
    match weights.last_mut() {
        Some((last, weight)) if *last == cell => *weight = (*weight + mass).next_down(),
        _ => weights.push((cell, mass)),
    }
}

/// Offsets modulo the number of cells.
fn wrapped(weights: &[(i64, f64)], cells: i64) -> Vec<(i64, f64)> {
    let mut all: Vec<_> = weights.iter().map(|&(cell, mass)| (cell.rem_euclid(cells), mass)).collect();
    all.sort_by_key(|&(cell, _)| cell);
    let mut merged = Vec::new();
    all.iter().for_each(|&(cell, mass)| add(&mut merged, cell, mass));
    merged
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taps(first: i64, lower: &[f64]) -> Taps {
        Taps { first, lower: lower.to_vec(), upper: lower.to_vec(), elsewhere: 0.0 }
    }

    #[test]
    fn one_sub_cell_a_cell_pairs_neighbours() {
        let taps = taps(-1, &[0.25, 0.75]);
        let axis = Axis::new(4, 1, false, Some(taps.clone()), (0, 3));
        let weights = Weights::of(&axis, &taps);
        assert_eq!(weights[0].pair, [(-1, 0.25), (0, 0.75)]);
        assert!(weights[0].single.is_empty());
    }

    #[test]
    fn finer_lattices_mostly_stay_within_a_cell() {
        let taps = taps(-2, &[0.125, 0.25, 0.25, 0.375]);
        let axis = Axis::new(4, 2, false, Some(taps.clone()), (0, 7));
        let weights = Weights::of(&axis, &taps);
        // From the lower half of a cell: −2 → cell −1, −1 → cells −1 and 0, 0 → cell 0, 1 → cells 0 and 1.
        assert_eq!(weights[0].single, [(-1, 0.125), (0, 0.25)]);
        assert_eq!(weights[0].pair, [(-1, 0.25), (0, 0.375)]);
        assert_eq!(weights[1].single, [(0, 0.25), (1, 0.375)]);
        assert_eq!(weights[1].pair, [(-1, 0.125), (0, 0.25)]);
    }

    #[test]
    fn periodic_offsets_meet() {
        let taps = taps(-2, &[0.25, 0.25, 0.25, 0.25]);
        let axis = Axis::new(3, 1, true, Some(taps.clone()), (0, 0));
        let weights = Weights::of(&axis, &taps);
        assert_eq!(weights[0].pair.len(), 3);
        assert_eq!(weights[0].pair[0], (0, 0.25));
        assert!(weights[0].pair[1].1 <= 0.5 && weights[0].pair[1].1 > 0.499_999);
    }
}
