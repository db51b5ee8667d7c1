//! Known distributions in the plane: samples, and the exact probability of a box.

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha12Rng;
use statrs::distribution::{Continuous, ContinuousCDF, Normal};

/// A distribution of the noise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Noise {
    /// Independent normal components.
    Gaussian,
    /// Uniform on a box.
    Uniform,
    /// Independent components with Student's t distribution, 2 degrees of freedom: infinite variance.
    HeavyTailed,
    /// Two humps with equal chances, on a diagonal.
    Bimodal,
    /// Jointly normal with correlation 0.8.
    Correlated,
}

const MEAN: [f64; 2] = [0.1, -0.05];
const SCALE: [f64; 2] = [0.4, 0.3];
/// What the humps are apart from their center, and how wide they are, in units of the scale.
const HUMP: (f64, f64) = (1.0, 0.4);
const CORRELATION: f64 = 0.8;
/// Gauss–Legendre nodes and weights on [−1, 1], 8 of them.
const NODES: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

impl Noise {
    pub const ALL: [Self; 5] =
        [Self::Gaussian, Self::Uniform, Self::HeavyTailed, Self::Bimodal, Self::Correlated];

    /// Independent samples, one after the other.
    pub fn draw(self, samples: usize, seed: u64) -> Vec<f64> {
        let mut rng = ChaCha12Rng::seed_from_u64(seed);
        (0..samples)
            .flat_map(|_| {
                self.standard(&mut rng)
                    .into_iter()
                    .zip(place())
                    .map(|(z, (m, s))| m + s * z)
                    .collect::<Vec<_>>()
            })
            .collect()
    }

    fn standard(self, rng: &mut impl Rng) -> [f64; 2] {
        let normal = |rng: &mut dyn Rng| unit().inverse_cdf(rng.random_range(f64::MIN_POSITIVE..1.0));
        match self {
            Self::Gaussian => [normal(rng), normal(rng)],
            Self::Uniform => [rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0)],
            Self::HeavyTailed => [0; 2].map(|_| {
                let u: f64 = rng.random_range(f64::MIN_POSITIVE..1.0);
                (2.0 * u - 1.0) / (2.0 * u * (1.0 - u)).sqrt()
            }),
            Self::Bimodal => {
                let side = if rng.random_bool(0.5) { HUMP.0 } else { -HUMP.0 };
                [side + HUMP.1 * normal(rng), side + HUMP.1 * normal(rng)]
            }
            Self::Correlated => {
                let (x, y) = (normal(rng), normal(rng));
                [x, CORRELATION * x + (1.0 - CORRELATION * CORRELATION).sqrt() * y]
            }
        }
    }

    /// The probability of the box with these corners.
    pub fn measure(self, lower: [f64; 2], upper: [f64; 2]) -> f64 {
        let place = place();
        let standardize = |x: [f64; 2]| [0, 1].map(|j| (x[j] - place[j].0) / place[j].1);
        let (a, b) = (standardize(lower), standardize(upper));
        let product = |cdf: &dyn Fn(f64) -> f64| (cdf(b[0]) - cdf(a[0])) * (cdf(b[1]) - cdf(a[1]));
        match self {
            Self::Gaussian => product(&|x| unit().cdf(x)),
            Self::Uniform => product(&|x| (0.5 * (x + 1.0)).clamp(0.0, 1.0)),
            Self::HeavyTailed => product(&student),
            Self::Bimodal => {
                let hump = |side: f64| product(&|x| unit().cdf((x - side) / HUMP.1));
                0.5 * (hump(HUMP.0) + hump(-HUMP.0))
            }
            Self::Correlated => correlated(a, b),
        }
    }
}

fn place() -> [(f64, f64); 2] {
    [(MEAN[0], SCALE[0]), (MEAN[1], SCALE[1])]
}

fn unit() -> Normal {
    Normal::new(0.0, 1.0).unwrap()
}

/// The distribution function of Student's t with 2 degrees of freedom.
fn student(x: f64) -> f64 {
    if x.is_infinite() { 0.5 + 0.5 * x.signum() } else { 0.5 + 0.5 * x / (2.0 + x * x).sqrt() }
}

/// Integrates the conditional probability of the second component, in pieces of at most ¼.
fn correlated(a: [f64; 2], b: [f64; 2]) -> f64 {
    let rest = (1.0 - CORRELATION * CORRELATION).sqrt();
    let conditional = |x: f64| {
        let cdf = |y: f64| unit().cdf((y - CORRELATION * x) / rest);
        unit().pdf(x) * (cdf(b[1]) - cdf(a[1]))
    };
    // Beyond 9 standard deviations there is less than 1e-18.
    let (from, to) = (a[0].max(-9.0), b[0].min(9.0));
    if from >= to {
        return 0.0;
    }
    let pieces = ((to - from) * 4.0).ceil();
    let half = 0.5 * (to - from) / pieces;
    (0..pieces as usize)
        .map(|i| {
            let middle = from + (2.0 * i as f64 + 1.0) * half;
            NODES
                .iter()
                .map(|&(x, w)| w * half * (conditional(middle - half * x) + conditional(middle + half * x)))
                .sum::<f64>()
        })
        .sum()
}
