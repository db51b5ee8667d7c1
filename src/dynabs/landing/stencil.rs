//! Noise that moves several coordinates at once, or whose masses are known by intervals only: boxes around a sub-cell.

/// Where noise takes a sub-cell `i`: with some probability to any sub-cell of the box `i + first … i + first + size − 1`.
#[derive(Clone, Debug, PartialEq)]
pub struct Tap {
    /// The first sub-cell of the box, counted from `i`.
    pub first: Vec<i64>,
    /// The number of sub-cells in every coordinate.
    pub size: Vec<u32>,
    /// A lower bound on the probability.
    pub lower: f64,
    /// An upper bound on the probability.
    pub upper: f64,
}

/// One noise: boxes that exclude each other, with bounds on the probability of each.
#[derive(Clone, Debug, PartialEq)]
pub struct Stencil {
    /// The boxes.
    pub taps: Vec<Tap>,
    /// A bound on the probability of none of them.
    pub elsewhere: f64,
    /// More than the bounds of the boxes say: a band for the distribution function.
    pub band: Option<Band>,
}

/// Bounds on the distribution function of one coordinate's noise at the edges of its taps, which follow one another.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// `F ≥`, at the lower edge of every tap and the upper one of the last.
    pub lower: Vec<f64>,
    /// `F ≤`, there.
    pub upper: Vec<f64>,
    /// Whether whatever is in no tap leads out of the partition.
    pub is_complete: bool,
}

impl Stencil {
    /// The extents of the boxes along a coordinate: the least first and the greatest last sub-cell.
    pub(super) fn extent(&self, j: usize) -> (i64, i64) {
        self.taps.iter().fold((0, 0), |(low, high), tap| {
            (low.min(tap.first[j]), high.max(tap.first[j] + i64::from(tap.size[j]) - 1))
        })
    }

    /// The taps without what a band says.
    pub fn relaxed(&self) -> Self {
        Self { band: None, ..self.clone() }
    }
}

impl Band {
    /// The extremum of the expectation of a function that is `values[k]` in tap `k` and `outside` beyond the taps.
    ///
    /// With `F_e` the distribution function at edge `e` it is `v_∞ + Σ_e F_e (v_{e−1} − v_e)`, and each `F_e` is in its
    /// interval. In particular `Σ p̂_k v_k − c · (total variation of v)` for a band of half-width `c`.
    pub(super) fn extremum<S: super::Side>(&self, values: &[f64]) -> f64 {
        let outside = if self.is_complete { 0.0 } else { S::UNLISTED };
        let (mut gain, mut loss) = (outside, 0.0);
        let mut before = outside;
        for (edge, (low, high)) in self.lower.iter().zip(&self.upper).enumerate() {
            let after = values.get(edge).copied().unwrap_or(outside);
            let difference = before - after;
            // The lower bound takes the little of what falls and the much of what rises.
            if difference > 0.0 {
                gain += difference * S::of(*low, *high);
            } else {
                loss -= difference * S::of(-*low, -*high).abs();
            }
            before = after;
        }
        // Each sum has terms of one sign, each rounded twice: the error is relative to either.
        let error = imdp::numeric::rounding_factor(values.len() + 6) * (gain + loss);
        S::shift(gain - loss, error).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::super::side::{Lower, Upper};
    use super::*;

    #[test]
    fn a_band_costs_its_width_times_the_variation() {
        // Frequencies ¼, ½, ¼ and a band of 0.1 within [0, 1].
        let band =
            Band { lower: vec![0.0, 0.15, 0.65, 0.9], upper: vec![0.1, 0.35, 0.85, 1.0], is_complete: true };
        let values = [0.25, 1.0, 0.5];
        // 0.25 F(1) − … : F_0 (0 − ¼) + F_1 (¼ − 1) + F_2 (1 − ½) + F_3 ½.
        let least = 0.1 * -0.25 + 0.35 * -0.75 + 0.65 * 0.5 + 0.9 * 0.5;
        let most = 0.15 * -0.75 + 0.85 * 0.5 + 0.5;
        let found = (band.extremum::<Lower>(&values), band.extremum::<Upper>(&values));
        assert!(found.0 <= least && found.0 > least - 1e-14, "{found:?} {least}");
        assert!(found.1 >= most && found.1 < most + 1e-14, "{found:?} {most}");
    }
}
