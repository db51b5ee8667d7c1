//! Where the noise samples come from.

use super::values::{symmetric, vector};
use super::{Diagnostic, NoiseSpec, SampleKind, SamplesSpec};
use crate::Warning;
use crate::linear_algebra::Definiteness;
use crate::noise::{CsvError, Gaussian, NoiseSamples, parse_csv};
use crate::statistics::departures;
use crate::system::LinearSystem;
use imdp::numeric::to_f64;
use std::path::Path;

/// The most samples that quantiles are proven for.
const MAX_SAMPLES: u64 = 10_000_000;

/// Noise samples and how they were obtained.
#[derive(Clone, Debug)]
pub struct NoiseSource {
    /// Samples of the grouped noise.
    pub samples: NoiseSamples,
    /// The noise so far after each step within a group, sample by sample; none if the samples are of grouped steps.
    pub between: Vec<NoiseSamples>,
    /// What is known of the noise of one step.
    pub of_one_step: StepNoise,
    /// The seed, if they were drawn.
    pub seed: Option<u64>,
    /// The file they were read from, as named in the model file, and its content.
    pub file: Option<(String, String)>,
    /// What the user should know.
    pub warnings: Vec<Warning>,
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

impl NoiseSource {
    /// Reads or draws samples of the noise of `d` steps of `system`; files are relative to `directory`.
    ///
    /// # Errors
    /// A [`Diagnostic`] for the first mistake found.
    pub fn new(
        directory: &Path,
        spec: &NoiseSpec,
        system: &LinearSystem,
        d: usize,
    ) -> Result<Self, Diagnostic> {
        noise_source(directory, spec, system, d)
    }
}

fn noise_source(
    directory: &Path,
    spec: &NoiseSpec,
    system: &LinearSystem,
    d: usize,
) -> Result<NoiseSource, Diagnostic> {
    match spec {
        NoiseSpec { samples: Some(samples), gaussian: None, count: None, seed: None } => {
            read_samples(directory, samples, system, d)
        }
        NoiseSpec { samples: None, gaussian: Some(gaussian), count, seed } => {
            let n = system.state_dimension();
            let place = "/noise/gaussian/covariance";
            let covariance = symmetric(place, &gaussian.covariance, n, "n×n for n states")?;
            if covariance.definiteness() == Definiteness::Indefinite {
                return Err(Diagnostic::at(
                    place,
                    "a matrix with a negative eigenvalue",
                    "a positive semidefinite matrix",
                )
                .remedy(
                    "A covariance has no negative direction: check the signs and sizes of its entries.",
                ));
            }
            let zero = vec![0.0; n];
            let mean = gaussian.mean.as_ref().unwrap_or(&zero);
            let what = "one per dimension of the state";
            let mean: Vec<f64> = vector("/noise/gaussian/mean", mean, n, what)?.iter().map(to_f64).collect();
            let count = count
                .ok_or_else(|| Diagnostic::at("/noise/count", "nothing", "the number of samples to draw"))?;
            if count == 0 || count > MAX_SAMPLES {
                let expected = format!("between 1 and {MAX_SAMPLES} samples");
                return Err(Diagnostic::at("/noise/count", count.to_string(), expected));
            }
            let seed = seed.unwrap_or(0);
            let unstable =
                || Diagnostic::at(place, "a matrix without a factor", "a positive semidefinite matrix");
            let gaussian = Gaussian::new(&mean, &covariance).ok_or_else(unstable)?;
            let (samples, between) = grouped(&gaussian.sample(count as usize * d, seed), system, d);
            let of_one_step = StepNoise::Gaussian(gaussian);
            Ok(NoiseSource { samples, between, of_one_step, seed: Some(seed), file: None, warnings: vec![] })
        }
        _ => {
            let fields = [
                ("samples", spec.samples.is_some()),
                ("gaussian", spec.gaussian.is_some()),
                ("count", spec.count.is_some()),
                ("seed", spec.seed.is_some()),
            ];
            let given: Vec<_> = fields.iter().filter(|(_, given)| *given).map(|(name, _)| *name).collect();
            let found = if given.is_empty() { "nothing".to_owned() } else { given.join(", ") };
            Err(Diagnostic::at("/noise", found, "either {samples} or {gaussian, count, seed}"))
        }
    }
}

fn read_samples(
    directory: &Path,
    spec: &SamplesSpec,
    system: &LinearSystem,
    d: usize,
) -> Result<NoiseSource, Diagnostic> {
    let path = directory.join(&spec.file);
    let name = path.display().to_string();
    let text = std::fs::read_to_string(&path).map_err(|error| {
        Diagnostic::at("/noise/samples/file", format!("\"{}\" ({error})", spec.file), "a readable CSV file")
            .remedy("Relative paths start at the directory of the model file.")
    })?;
    let read = parse_csv(&text, system.state_dimension()).map_err(|error| {
        let (place, found, expected) = match &error {
            CsvError::Columns { line, found, expected } => {
                let expected = format!("{expected}, one per dimension of the state");
                (format!("line {line}"), super::values::count(*found, "column"), expected)
            }
            CsvError::Number { line, column, found } => (
                format!("line {line}, column {column}"),
                format!("\"{found}\""),
                "a finite number".to_owned(),
            ),
            CsvError::Empty => (String::new(), "no samples".to_owned(), "one sample per line".to_owned()),
        };
        let remedy = "The file has no header; numbers are separated by commas. Correct or remove the line.";
        Diagnostic::at(place, found, expected).remedy(remedy).in_file(&name)
    })?;
    if read.len() as u64 > MAX_SAMPLES {
        let expected = format!("at most {MAX_SAMPLES}");
        return Err(Diagnostic::at("", format!("{} samples", read.len()), expected).in_file(&name));
    }
    let mut warnings = independence(&name, &read);
    let ((samples, between), of_one_step) = match spec.of {
        SampleKind::Grouped => ((read, vec![]), StepNoise::Unknown),
        SampleKind::Step => {
            let (left_over, samples) = (read.len() % d, read.len());
            if left_over > 0 && samples > d {
                let file = name.clone();
                warnings.push(Warning::LeftOverSamples { file, left_over, samples, group_steps: d });
            }
            (grouped(&read, system, d), StepNoise::Samples(read))
        }
    };
    if samples.is_empty() {
        let found = format!("{} samples of one step", text.lines().count());
        return Err(Diagnostic::at("", found, format!("at least {d}, one group")).in_file(&name));
    }
    let file = Some((spec.file.clone(), text));
    Ok(NoiseSource { samples, between, of_one_step, seed: None, file, warnings })
}

/// The noise of `d` steps together, and the noise so far after each step before the last.
fn grouped(steps: &NoiseSamples, system: &LinearSystem, d: usize) -> (NoiseSamples, Vec<NoiseSamples>) {
    let mut sums = steps.partial_sums(system, d);
    let last = sums.pop().unwrap_or_else(|| steps.clone());
    (last, sums)
}

/// What makes the samples of a file look dependent.
fn independence(file: &str, samples: &NoiseSamples) -> Vec<Warning> {
    let warning = |departure| Warning::NotIndependent { file: file.to_owned(), departure };
    departures(samples.dimension(), samples.values()).into_iter().map(warning).collect()
}
