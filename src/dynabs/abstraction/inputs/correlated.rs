//! Known normal noise with any covariance, as boxes of the lattice.

use crate::landing::{Stencil, Tap};
use crate::noise::known::Distribution;
use crate::problem::JointGaussian;
use imdp::numeric::Rational;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// One noise for each entry of `ζ` that is ever other than 0, for a lattice with these pitches `δ`.
///
/// `ζ_j ∈ [kδ_j, (k+1)δ_j)` moves coordinate `j` by `k` or `k + 1` sub-cells, and coordinate `i > j` by
/// `L_ij ζ_j ∈ L_ij [kδ_j, (k+1)δ_j)`, wherever in their sub-cells they were. Intervals farther than `within` are not
/// listed.
pub(super) fn stencils(noise: &JointGaussian, pitch: &[Rational], within: &[(i64, i64)]) -> Vec<Stencil> {
    let of_entry = |j: usize| {
        let variance = noise.factors.diagonal[j].clone();
        let mean = noise.means[j].clone();
        let distribution = if variance.is_zero() {
            Distribution::Atoms(vec![(mean, Rational::one())])
        } else {
            Distribution::Gaussian { mean, variance }
        };
        let taps = distribution.taps(&pitch[j], within[j]);
        let boxes = (taps.first..).zip(taps.lower.iter().zip(&taps.upper));
        let listed = boxes.filter(|(_, (_, upper))| **upper > 0.0);
        let tap = |(k, (&lower, &upper)): (i64, (&f64, &f64))| {
            let (first, size) = (0..pitch.len()).map(|i| moved(noise, pitch, i, j, k)).unzip();
            Tap { first, size, lower, upper }
        };
        Stencil { taps: listed.map(tap).collect(), elsewhere: taps.slack(), band: None }
    };
    (0..pitch.len()).filter(|&j| noise.is_active(j)).map(of_entry).collect()
}

/// By how many sub-cells interval `k` of `ζ_j` moves coordinate `i`: at least, and by how many different numbers.
fn moved(noise: &JointGaussian, pitch: &[Rational], i: usize, j: usize, k: i64) -> (i64, u32) {
    let slope = noise.factors.lower.get(i, j);
    if slope.is_zero() {
        return (0, 1);
    }
    let factor = slope * &pitch[j] / &pitch[i];
    let at = |k: i64| &factor * Rational::from_integer(k.into());
    // The end of the interval that does not belong to it is the upper one, of what moves the coordinate too if the
    // slope is positive; a point may be on the upper face of its sub-cell.
    let (least, beyond) = if factor.is_positive() {
        (at(k).floor(), at(k + 1).ceil())
    } else {
        (at(k + 1).floor(), at(k).floor() + Rational::one())
    };
    let whole = |x: &Rational, far: i64| x.to_integer().to_i64().unwrap_or(far);
    let first = whole(&least, i64::MIN / 4).clamp(-FAR, FAR);
    let last = whole(&beyond, i64::MAX / 4).clamp(first, first + FAR);
    (first, (last - first + 1) as u32)
}

/// Farther than any lattice.
const FAR: i64 = 1 << 31;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear_algebra::ExactMatrix;
    use crate::noise::Gaussian;
    use imdp::numeric::{from_decimal, to_f64};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha12Rng;
    use rand_distr::{Distribution as _, StandardNormal};

    fn exact(x: f64) -> Rational {
        from_decimal(x).unwrap()
    }

    fn joint(covariance: [[f64; 2]; 2], mean: [f64; 2]) -> JointGaussian {
        let matrix = ExactMatrix::from_fn(2, 2, |i, j| exact(covariance[i][j]));
        let factors = matrix.ldl().unwrap();
        let second = exact(mean[1]) - factors.lower.get(1, 0) * exact(mean[0]);
        let draws = Gaussian::new(&mean, &matrix).unwrap();
        JointGaussian { means: vec![exact(mean[0]), second], factors, draws }
    }

    /// From any point of a closed sub-cell, noise in tap `k` leads to the box of tap `k`; not if boxes are one smaller.
    #[test]
    fn boxes_contain_where_noise_leads() {
        let mut rng = ChaCha12Rng::seed_from_u64(5);
        for (covariance, mean) in [
            ([[1.0, 0.6], [0.6, 1.0]], [0.0, 0.0]),
            ([[1.0, -0.9], [-0.9, 2.0]], [0.3, -0.2]),
            ([[0.5, 1.0], [1.0, 2.0]], [0.0, 0.1]),
            ([[0.0, 0.0], [0.0, 1.0]], [0.7, 0.0]),
        ] {
            let noise = joint(covariance, mean);
            let pitch = [exact(0.5), exact(0.4)];
            let stencils = stencils(&noise, &pitch, &[(-60, 60), (-60, 60)]);
            let delta = pitch.clone().map(|x| to_f64(&x));
            let active: Vec<usize> = (0..2).filter(|&j| noise.is_active(j)).collect();
            let mut outside_smaller = 0;
            for (stencil, &j) in stencils.iter().zip(&active) {
                let mass: f64 = stencil.taps.iter().map(|tap| tap.lower).sum();
                assert!(mass <= 1.0 && mass + stencil.elsewhere >= 1.0 && stencil.elsewhere < 1e-9);
                for _ in 0..4000 {
                    let spread = to_f64(&noise.factors.diagonal[j]).sqrt();
                    let z: f64 = StandardNormal.sample(&mut rng);
                    let zeta = to_f64(&noise.means[j]) + spread * z;
                    let Some(tap) =
                        stencil.taps.iter().find(|t| t.first[j] == (zeta / delta[j]).floor() as i64)
                    else {
                        panic!("{zeta} is in no tap");
                    };
                    for (i, delta) in delta.iter().enumerate().skip(j) {
                        let slope = to_f64(noise.factors.lower.get(i, j));
                        let to = (rng.random::<f64>() + slope * zeta / delta).floor() as i64 - tap.first[i];
                        assert!((0..i64::from(tap.size[i])).contains(&to), "{i} {j}: {to} {tap:?}");
                        outside_smaller += i32::from(to == i64::from(tap.size[i]) - 1 && slope != 0.0);
                    }
                }
            }
            assert!(outside_smaller > 100, "{outside_smaller}");
        }
    }

    #[test]
    fn the_upper_face_counts() {
        // ζ_1 = 1 exactly, from the upper face: with a slope of −1 the second coordinate comes to rest on a face.
        let noise = joint([[1.0, -1.0], [-1.0, 1.0]], [0.0, 0.0]);
        let unit = [exact(1.0), exact(1.0)];
        assert_eq!(moved(&noise, &unit, 0, 0, 1), (1, 2));
        assert_eq!(moved(&noise, &unit, 1, 0, 1), (-2, 3));
        assert_eq!(moved(&noise, &unit, 1, 1, 1), (1, 2));
    }
}
