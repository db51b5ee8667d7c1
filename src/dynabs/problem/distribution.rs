//! A known distribution of one component of the noise, as written.

use super::values::count;
use crate::Diagnostic;
use crate::noise::known::Distribution;
use imdp::numeric::{Rational, from_decimal};
use num_traits::{Signed, Zero};
use schemars::JsonSchema;
use serde::Deserialize;

/// The distribution of one component of the noise of one step; numbers stand for the decimals as written.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum DistributionParts {
    /// The normal distribution: exactly one of variance and deviation.
    Gaussian {
        /// The mean; 0 if absent.
        #[serde(default)]
        mean: f64,
        /// The variance, positive.
        #[serde(default)]
        variance: Option<f64>,
        /// The standard deviation, positive.
        #[serde(default)]
        deviation: Option<f64>,
    },
    /// The density `exp(−|x − mean| / scale) / (2 scale)`.
    Laplace {
        /// The mean; 0 if absent.
        #[serde(default)]
        mean: f64,
        /// The scale, positive.
        scale: f64,
    },
    /// The distribution function `1 / (1 + exp(−(x − mean) / scale))`.
    Logistic {
        /// The mean; 0 if absent.
        #[serde(default)]
        mean: f64,
        /// The scale, positive.
        scale: f64,
    },
    /// `mean + scale · T` with `T` of Student's distribution.
    StudentT {
        /// The center; 0 if absent.
        #[serde(default)]
        mean: f64,
        /// The scale, positive.
        scale: f64,
        /// The degrees of freedom, from 1 to 1000.
        degrees: u32,
    },
    /// The uniform distribution.
    Uniform {
        /// The lower end.
        lower: f64,
        /// The upper end.
        upper: f64,
    },
    /// The triangular density.
    Triangular {
        /// The lower end.
        lower: f64,
        /// Where the density is greatest.
        mode: f64,
        /// The upper end.
        upper: f64,
    },
    /// Finitely many values.
    Atoms {
        /// The values, ascending.
        values: Vec<f64>,
        /// Their weights, positive; divided by their sum.
        weights: Vec<f64>,
    },
    /// A distribution function that is linear between points.
    Table {
        /// Where, strictly ascending.
        x: Vec<f64>,
        /// The distribution function there, ascending from 0 to 1.
        cdf: Vec<f64>,
    },
    /// One of several distributions.
    Mixture {
        /// The distributions.
        of: Vec<DistributionParts>,
        /// Their weights, positive; divided by their sum.
        weights: Vec<f64>,
    },
    /// A distribution, given that the value is in `[lower, upper)`.
    Truncated {
        /// The distribution.
        of: Box<DistributionParts>,
        /// The lower end.
        lower: f64,
        /// The upper end.
        upper: f64,
    },
}

/// The most degrees of freedom of Student's distribution: beyond it is as good as normal.
const MOST_DEGREES: u32 = 1000;

impl DistributionParts {
    /// The distribution, if its numbers make one; `place` is where they are.
    ///
    /// # Errors
    /// A [`Diagnostic`] for the first mistake found.
    pub fn distribution(&self, place: &str) -> Result<Distribution, Diagnostic> {
        let number = |name: &str, x: f64| {
            let at = || Diagnostic::at(format!("{place}/{name}"), x.to_string(), "a finite number");
            from_decimal(x).ok_or_else(at)
        };
        let positive = |name: &str, x: f64| match number(name, x)? {
            exact if exact.is_positive() => Ok(exact),
            _ => Err(Diagnostic::at(format!("{place}/{name}"), x.to_string(), "a positive number")),
        };
        let ends = |lower: f64, upper: f64| match (number("lower", lower)?, number("upper", upper)?) {
            (a, b) if a < b => Ok((a, b)),
            _ => Err(Diagnostic::at(place, format!("lower {lower} and upper {upper}"), "lower < upper")),
        };
        match self {
            Self::Gaussian { mean, variance, deviation } => {
                let mean = number("gaussian/mean", *mean)?;
                let variance = match (variance, deviation) {
                    (Some(variance), None) => positive("gaussian/variance", *variance)?,
                    (None, Some(deviation)) => {
                        let deviation = positive("gaussian/deviation", *deviation)?;
                        &deviation * &deviation
                    }
                    (given, _) => {
                        let found = if given.is_some() { "both" } else { "neither" };
                        return Err(Diagnostic::at(
                            format!("{place}/gaussian"),
                            found,
                            "one of variance and deviation",
                        )
                        .remedy("A component without noise is written null."));
                    }
                };
                Ok(Distribution::Gaussian { mean, variance })
            }
            Self::Laplace { mean, scale } => Ok(Distribution::Laplace {
                mean: number("laplace/mean", *mean)?,
                scale: positive("laplace/scale", *scale)?,
            }),
            Self::Logistic { mean, scale } => Ok(Distribution::Logistic {
                mean: number("logistic/mean", *mean)?,
                scale: positive("logistic/scale", *scale)?,
            }),
            Self::StudentT { degrees, .. } if *degrees == 0 || *degrees > MOST_DEGREES => {
                let expected = format!("a whole number from 1 to {MOST_DEGREES}");
                Err(Diagnostic::at(format!("{place}/student_t/degrees"), degrees.to_string(), expected))
            }
            Self::StudentT { mean, scale, degrees } => Ok(Distribution::StudentT {
                mean: number("student_t/mean", *mean)?,
                scale: positive("student_t/scale", *scale)?,
                degrees: *degrees,
            }),
            Self::Uniform { lower, upper } => {
                ends(*lower, *upper).map(|(lower, upper)| Distribution::Uniform { lower, upper })
            }
            Self::Triangular { lower, mode, upper } => {
                let ((lower, upper), mode) = (ends(*lower, *upper)?, number("triangular/mode", *mode)?);
                if mode < lower || mode > upper {
                    let place = format!("{place}/triangular/mode");
                    return Err(Diagnostic::at(place, "a mode outside", "lower ≤ mode ≤ upper"));
                }
                Ok(Distribution::Triangular { lower, mode, upper })
            }
            Self::Atoms { values, weights } => {
                let place = format!("{place}/atoms");
                let values = ascending(&format!("{place}/values"), values, true)?;
                let weights = shares(&format!("{place}/weights"), weights, values.len())?;
                Ok(Distribution::Atoms(values.into_iter().zip(weights).collect()))
            }
            Self::Table { x, cdf } => {
                let place = format!("{place}/table");
                let x = ascending(&format!("{place}/x"), x, true)?;
                let values = ascending(&format!("{place}/cdf"), cdf, false)?;
                let ends = (cdf.first() == Some(&0.0), cdf.last() == Some(&1.0));
                if x.len() != values.len() || x.len() < 2 || ends != (true, true) {
                    let found = format!("{} for {}", count(values.len(), "number"), count(x.len(), "point"));
                    return Err(Diagnostic::at(format!("{place}/cdf"), found, "one a point, from 0 to 1"));
                }
                Ok(Distribution::Table(x.into_iter().zip(values).collect()))
            }
            Self::Mixture { of, weights } => {
                let place = format!("{place}/mixture");
                let weights = shares(&format!("{place}/weights"), weights, of.len())?;
                let parts =
                    of.iter().enumerate().map(|(i, part)| part.distribution(&format!("{place}/of/{i}")));
                Ok(Distribution::Mixture(
                    weights.into_iter().zip(parts.collect::<Result<Vec<_>, _>>()?).collect(),
                ))
            }
            Self::Truncated { of, lower, upper } => {
                let (lower, upper) = ends(*lower, *upper)?;
                let of = Box::new(of.distribution(&format!("{place}/truncated/of"))?);
                if of.mass(Some(&lower), Some(&upper)).lower() < 1e-6 {
                    let found = "an interval that has nearly no mass";
                    return Err(Diagnostic::at(
                        format!("{place}/truncated"),
                        found,
                        "at least a millionth of it",
                    ));
                }
                Ok(Distribution::Truncated { of, lower, upper })
            }
        }
    }
}

fn ascending(place: &str, values: &[f64], strictly: bool) -> Result<Vec<Rational>, Diagnostic> {
    let exact = |(i, &x): (usize, &f64)| {
        from_decimal(x)
            .ok_or_else(|| Diagnostic::at(format!("{place}/{i}"), x.to_string(), "a finite number"))
    };
    let exact: Vec<Rational> = values.iter().enumerate().map(exact).collect::<Result<_, _>>()?;
    let falls = |pair: &[Rational]| if strictly { pair[0] >= pair[1] } else { pair[0] > pair[1] };
    if exact.is_empty() {
        return Err(Diagnostic::at(place, "an empty list", "at least one number"));
    }
    match exact.windows(2).position(falls) {
        None => Ok(exact),
        Some(i) => {
            Err(Diagnostic::at(format!("{place}/{}", i + 1), values[i + 1].to_string(), "ascending numbers"))
        }
    }
}

/// Weights divided by their sum.
fn shares(place: &str, weights: &[f64], expected: usize) -> Result<Vec<Rational>, Diagnostic> {
    if weights.len() != expected || expected == 0 {
        let expected = count(expected.max(1), "weight");
        return Err(Diagnostic::at(place, count(weights.len(), "weight"), expected));
    }
    let exact = |(i, &x): (usize, &f64)| match from_decimal(x) {
        Some(weight) if weight.is_positive() => Ok(weight),
        _ => Err(Diagnostic::at(format!("{place}/{i}"), x.to_string(), "a positive weight")),
    };
    let exact: Vec<Rational> = weights.iter().enumerate().map(exact).collect::<Result<_, _>>()?;
    let sum = exact.iter().fold(Rational::zero(), |sum, weight| sum + weight);
    Ok(exact.into_iter().map(|weight| weight / &sum).collect())
}
