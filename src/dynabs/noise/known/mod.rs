//! Known distributions of one component of the noise, with rigorous bounds on the mass of every interval.
//!
//! Parameters are the decimals as written. What is rational (uniform, triangular, atoms, tables) is computed as such; the
//! others are symmetric about their center and given by their tail, in interval arithmetic on correctly rounded
//! functions. Intervals are half-open, `[a, b)`, like cells.

mod draw;
mod mass;
mod spread;
mod tail;
mod taps;

use imdp::numeric::Rational;

/// The distribution of one component of the noise.
#[derive(Clone, Debug, PartialEq)]
pub enum Distribution {
    /// The normal distribution.
    Gaussian {
        /// The mean.
        mean: Rational,
        /// The variance, positive.
        variance: Rational,
    },
    /// The density `exp(−|x − mean| / scale) / (2 scale)`.
    Laplace {
        /// The mean.
        mean: Rational,
        /// The scale, positive.
        scale: Rational,
    },
    /// The distribution function `1 / (1 + exp(−(x − mean) / scale))`.
    Logistic {
        /// The mean.
        mean: Rational,
        /// The scale, positive.
        scale: Rational,
    },
    /// `mean + scale · T` with `T` of Student's distribution.
    StudentT {
        /// The center.
        mean: Rational,
        /// The scale, positive.
        scale: Rational,
        /// The degrees of freedom, at least 1.
        degrees: u32,
    },
    /// The uniform distribution on an interval.
    Uniform {
        /// Its lower end.
        lower: Rational,
        /// Its upper end, above the lower one.
        upper: Rational,
    },
    /// The triangular density on an interval.
    Triangular {
        /// Its lower end.
        lower: Rational,
        /// Where the density is greatest.
        mode: Rational,
        /// Its upper end, above the lower one.
        upper: Rational,
    },
    /// Finitely many values and their probabilities, which sum to 1; values ascend.
    Atoms(Vec<(Rational, Rational)>),
    /// A distribution function that is linear between points `(x, F(x))`; both ascend, from 0 to 1.
    Table(Vec<(Rational, Rational)>),
    /// One of several, with weights that sum to 1.
    Mixture(Vec<(Rational, Distribution)>),
    /// Another distribution, given that its value is in `[lower, upper)`.
    Truncated {
        /// The other one.
        of: Box<Distribution>,
        /// The lower end.
        lower: Rational,
        /// The upper end.
        upper: Rational,
    },
}
