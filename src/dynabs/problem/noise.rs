//! Where the noise samples come from: memory, a file, a distribution.

use super::distribution::DistributionParts;
use super::values::{count, symmetric, vector};
use crate::linear_algebra::{Definiteness, ExactMatrix};
use crate::memory::Need;
use crate::noise::{CsvError, DecimalMark, Gaussian, NoiseSamples, parse_csv};
use crate::statistics::departures;
use crate::system::LinearSystem;
use crate::{Diagnostic, Warning};
use imdp::numeric::{Rational, to_f64};
use std::path::PathBuf;

/// The most samples that quantiles are proven for.
const MAX_SAMPLES: u64 = 10_000_000;

/// What is known of the noise, or where samples of it come from.
#[derive(Clone, Debug, PartialEq)]
pub enum NoiseSource {
    /// The distributions of the coordinates of one step's noise are known, which are independent; nothing where there is no noise.
    Components(Vec<Option<DistributionParts>>),
    /// The distribution of one step's noise is known to be normal.
    Gaussian(GaussianNoise),
    /// They are given.
    Samples(GivenSamples),
    /// They are read from a file.
    File(SamplesFile),
    /// They are drawn.
    Drawn(DrawnNoise),
}

/// Samples in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenSamples {
    /// The numbers, sample after sample, `n` each.
    pub values: Vec<f64>,
    /// What one sample is the noise of.
    pub of: SampleKind,
}

/// A CSV file of samples, one of `n` numbers per line; see [`parse_csv`].
#[derive(Clone, Debug, PartialEq)]
pub struct SamplesFile {
    /// The file's name as the user gave it.
    pub name: String,
    /// Where it is.
    pub path: PathBuf,
    /// What one sample is the noise of.
    pub of: SampleKind,
    /// What separates whole numbers from decimals in it.
    pub decimal: DecimalMark,
}

/// Samples that are drawn: the same for the same seed, on every machine.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnNoise {
    /// The distribution of the noise of one step.
    pub distribution: GaussianNoise,
    /// How many samples of the grouped noise to draw (each from `d` draws of one step).
    pub count: u64,
    /// The seed of the draws.
    pub seed: u64,
}

/// A normal distribution of the noise of one step.
#[derive(Clone, Debug, PartialEq)]
pub struct GaussianNoise {
    /// The mean, `n` numbers; 0 if absent.
    pub mean: Option<Vec<f64>>,
    /// The covariance, `n×n`, symmetric and positive semidefinite.
    pub covariance: Vec<Vec<f64>>,
}

/// What a sample is the noise of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampleKind {
    /// Of `d` steps together.
    Grouped,
    /// Of one step; `d` samples are combined into one.
    Step,
}

/// Noise samples and how they were obtained.
#[derive(Clone, Debug)]
pub struct SampledNoise {
    /// Samples of the grouped noise.
    pub samples: NoiseSamples,
    /// The noise so far after each step within a group, sample by sample; none if the samples are of grouped steps.
    pub between: Vec<NoiseSamples>,
    /// What is known of the noise of one step.
    pub of_one_step: StepNoise,
    /// How they were obtained.
    pub origin: NoiseOrigin,
    /// What the user should know.
    pub warnings: Vec<Warning>,
}

/// How samples were obtained.
#[derive(Clone, Debug, PartialEq)]
pub enum NoiseOrigin {
    /// They were given.
    Memory,
    /// They were read.
    File {
        /// The file's name as the user gave it.
        name: String,
        /// Its content.
        text: String,
    },
    /// They were drawn.
    Drawn {
        /// The seed.
        seed: u64,
    },
}

/// What is known of the noise of one step.
#[derive(Clone, Debug)]
pub enum StepNoise {
    /// Its distribution.
    Gaussian(Gaussian),
    /// Samples of it.
    Samples(NoiseSamples),
    /// Nothing: the samples are of grouped steps.
    Unknown,
}

impl From<GivenSamples> for NoiseSource {
    fn from(samples: GivenSamples) -> Self {
        Self::Samples(samples)
    }
}

impl From<SamplesFile> for NoiseSource {
    fn from(file: SamplesFile) -> Self {
        Self::File(file)
    }
}

impl From<DrawnNoise> for NoiseSource {
    fn from(drawn: DrawnNoise) -> Self {
        Self::Drawn(drawn)
    }
}

impl SampledNoise {
    /// The seed, if the samples were drawn.
    pub fn seed(&self) -> Option<u64> {
        match self.origin {
            NoiseOrigin::Drawn { seed } => Some(seed),
            NoiseOrigin::Memory | NoiseOrigin::File { .. } => None,
        }
    }

    /// Name and content of the file that the samples were read from, if they were.
    pub fn file(&self) -> Option<(&str, &str)> {
        match &self.origin {
            NoiseOrigin::File { name, text } => Some((name, text)),
            NoiseOrigin::Memory | NoiseOrigin::Drawn { .. } => None,
        }
    }
}

impl NoiseSource {
    /// Whether it is of one number of steps only: of samples of steps that were grouped before, or of the distribution of one step.
    pub(super) fn is_grouped(&self) -> bool {
        match self {
            Self::Samples(given) => given.of == SampleKind::Grouped,
            Self::File(file) => file.of == SampleKind::Grouped,
            Self::Components(_) | Self::Gaussian(_) => true,
            Self::Drawn(_) => false,
        }
    }

    /// Samples of the noise of `d` steps of `system`.
    ///
    /// # Errors
    /// A [`Diagnostic`] for the first mistake found.
    pub fn obtain(&self, system: &LinearSystem, d: usize) -> Result<SampledNoise, Diagnostic> {
        match self {
            Self::Samples(given) => given.obtain(system, d),
            Self::File(file) => file.obtain(system, d),
            Self::Drawn(drawn) => drawn.obtain(system, d),
            Self::Components(_) | Self::Gaussian(_) => {
                Err(Diagnostic::at("/noise", "a known distribution", "samples of the noise"))
            }
        }
    }
}

impl GaussianNoise {
    /// The distribution of an `n`-dimensional noise.
    ///
    /// # Errors
    /// A [`Diagnostic`] if shapes do not fit or the covariance is indefinite.
    pub fn distribution(&self, n: usize) -> Result<Gaussian, Diagnostic> {
        let (mean, covariance) = self.exact(n)?;
        let mean: Vec<f64> = mean.iter().map(to_f64).collect();
        Gaussian::new(&mean, &covariance).ok_or_else(|| {
            let place = "/noise/gaussian/covariance";
            let found = "entries so far apart that its factor leaves the range of doubles";
            Diagnostic::at(place, found, "entries of comparable sizes")
                .remedy("Measure the state in other units.")
        })
    }

    /// Mean and covariance of an `n`-dimensional noise, as written.
    pub(super) fn exact(&self, n: usize) -> Result<(Vec<Rational>, ExactMatrix), Diagnostic> {
        let place = "/noise/gaussian/covariance";
        let covariance = symmetric(place, &self.covariance, n, "n×n for n states")?;
        if covariance.definiteness() == Definiteness::Indefinite {
            let (found, expected) = ("a matrix with a negative eigenvalue", "a positive semidefinite matrix");
            let remedy = "A covariance has no negative direction: check the signs and sizes of its entries.";
            return Err(Diagnostic::at(place, found, expected).remedy(remedy));
        }
        let zero = vec![0.0; n];
        let mean = self.mean.as_ref().unwrap_or(&zero);
        let mean = vector("/noise/gaussian/mean", mean, n, "one per dimension of the state")?;
        Ok((mean, covariance))
    }
}

impl DrawnNoise {
    fn obtain(&self, system: &LinearSystem, d: usize) -> Result<SampledNoise, Diagnostic> {
        let gaussian = self.distribution.distribution(system.state_dimension())?;
        if self.count == 0 || self.count > MAX_SAMPLES {
            let expected = format!("between 1 and {MAX_SAMPLES} samples");
            return Err(Diagnostic::at("/noise/count", self.count.to_string(), expected));
        }
        // What is drawn, the noise of groups, and that of the steps in between.
        let numbers = self.count * (d * system.state_dimension()) as u64;
        let need = Need { what: "samples", bytes: 40 * numbers, field: "/noise/count" };
        need.check().map_err(|error| Diagnostic::from(&error))?;
        let (samples, between) = sums(&gaussian.sample(self.count as usize * d, self.seed), system, d);
        Ok(SampledNoise {
            samples,
            between,
            of_one_step: StepNoise::Gaussian(gaussian),
            origin: NoiseOrigin::Drawn { seed: self.seed },
            warnings: vec![],
        })
    }
}

impl GivenSamples {
    fn obtain(&self, system: &LinearSystem, d: usize) -> Result<SampledNoise, Diagnostic> {
        let (place, n) = ("/noise/samples", system.state_dimension());
        if self.values.is_empty() || !self.values.len().is_multiple_of(n) {
            let expected = format!("whole samples of {n}, one per dimension of the state");
            return Err(Diagnostic::at(place, count(self.values.len(), "number"), expected));
        }
        if let Some(i) = self.values.iter().position(|x| !x.is_finite()) {
            let found = self.values[i].to_string();
            return Err(Diagnostic::at(format!("{place}/{}/{}", i / n, i % n), found, "a finite number"));
        }
        let given = NoiseSamples::new(n, self.values.clone());
        grouped(given, self.of, (system, d), (place, place), NoiseOrigin::Memory)
    }
}

impl SamplesFile {
    fn obtain(&self, system: &LinearSystem, d: usize) -> Result<SampledNoise, Diagnostic> {
        let name = self.path.display().to_string();
        let text = imdp::files::read_text(&self.path).map_err(|error| {
            let found = format!("\"{}\" ({error})", self.name);
            Diagnostic::at("/noise/samples/file", found, "a readable CSV file")
                .remedy("Relative paths start at the directory of the model file.")
        })?;
        let read = parse_csv(&text, system.state_dimension(), self.decimal)
            .map_err(|error| malformed(&error).in_file(&name))?;
        let origin = NoiseOrigin::File { name: self.name.clone(), text };
        let grouped = grouped(read, self.of, (system, d), ("", &name), origin);
        grouped.map_err(|error| error.in_file(&name))
    }
}

/// What is wrong with a line of the file.
fn malformed(error: &CsvError) -> Diagnostic {
    let (place, found, expected) = match error {
        CsvError::Columns { line, found, expected } => {
            let expected = format!("{expected}, one per dimension of the state");
            (format!("line {line}"), count(*found, "column"), expected)
        }
        CsvError::Number { line, column, found } => {
            (format!("line {line}, column {column}"), format!("\"{found}\""), "a finite number".to_owned())
        }
        CsvError::DecimalComma { line, column, found } => {
            let expected = "a number with a decimal point".to_owned();
            let place = format!("line {line}, column {column}");
            return Diagnostic::at(place, format!("\"{found}\""), expected)
                .remedy("If commas are where decimals begin, say so: \"decimal\": \",\" in /noise/samples.");
        }
        CsvError::Empty => (String::new(), "no samples".to_owned(), "one sample per line".to_owned()),
    };
    let remedy = "Numbers are separated by commas or semicolons; only the first line may have names. Correct or remove the line.";
    Diagnostic::at(place, found, expected).remedy(remedy)
}

/// Samples of groups of `d` steps, from samples of groups or steps; `source` is what warnings call them.
fn grouped(
    read: NoiseSamples,
    of: SampleKind,
    (system, d): (&LinearSystem, usize),
    (place, source): (&str, &str),
    origin: NoiseOrigin,
) -> Result<SampledNoise, Diagnostic> {
    if read.len() as u64 > MAX_SAMPLES {
        let expected = format!("at most {MAX_SAMPLES}");
        return Err(Diagnostic::at(place, format!("{} samples", read.len()), expected));
    }
    let source = || source.to_owned();
    let dependence = |departure| Warning::NotIndependent { source: source(), departure };
    let mut warnings: Vec<Warning> =
        departures(read.dimension(), read.values()).into_iter().map(dependence).collect();
    let ((samples, between), of_one_step) = match of {
        SampleKind::Grouped => ((read, vec![]), StepNoise::Unknown),
        SampleKind::Step => {
            let (samples, left_over) = (read.len(), read.len() % d);
            if samples < d {
                let found = format!("{samples} samples of one step");
                return Err(Diagnostic::at(place, found, format!("at least {d}, one group")));
            }
            if left_over > 0 {
                warnings.push(Warning::LeftOverSamples {
                    source: source(),
                    left_over,
                    samples,
                    group_steps: d,
                });
            }
            (sums(&read, system, d), StepNoise::Samples(read))
        }
    };
    Ok(SampledNoise { samples, between, of_one_step, origin, warnings })
}

/// The noise of `d` steps together, and the noise so far after each step before the last.
fn sums(steps: &NoiseSamples, system: &LinearSystem, d: usize) -> (NoiseSamples, Vec<NoiseSamples>) {
    let mut sums = steps.partial_sums(system, d);
    let last = sums.pop().unwrap_or_else(|| steps.clone());
    (last, sums)
}
