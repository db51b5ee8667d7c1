//! Which noise a simulation has.

use super::CliError;
use crate::other_samples::OtherSamplesArguments;
use clap::Args;
use dynabs::controller::Noise;
use dynabs::problem::{GaussianNoise, NoiseSource, SamplesFile, StepNoise};
use dynabs::run::Run;
use std::path::Path;

/// The noise of a simulation.
#[derive(Clone, Debug, Args)]
pub(crate) struct NoiseArguments {
    /// `gaussian` (the model's distribution, or --covariance), `samples` (the model's, drawn with
    /// replacement), or a CSV file of other samples. Default: gaussian if the model has one, else samples.
    #[arg(long, value_name = "gaussian|samples|FILE")]
    noise: Option<String>,

    /// The covariance of Gaussian noise of one original step, as JSON, instead of the model's noise.
    #[arg(long, value_name = "[[...],...]")]
    covariance: Option<String>,

    /// The mean that goes with --covariance, as JSON; 0 if absent.
    #[arg(long, value_name = "[...]", requires = "covariance")]
    mean: Option<String>,

    #[command(flatten)]
    other_samples: OtherSamplesArguments,
}

impl NoiseArguments {
    /// Whether some noise was asked for.
    pub(super) fn is_given(&self) -> bool {
        self.noise.is_some() || self.covariance.is_some()
    }
}

/// A noise and what to say about it.
pub(super) struct ChosenNoise {
    pub(super) noise: Noise,
    pub(super) said: SaidOfNoise,
}

/// What to say about a noise.
pub(super) struct SaidOfNoise {
    pub(super) name: String,
    /// Why it is no independent check of the promise, or not the whole story.
    pub(super) notes: Vec<String>,
}

/// The noise that was asked for, or the best that the model knows.
///
/// # Errors
/// [`CliError::Input`] if the model has none of that kind, or file or covariance are malformed.
pub(super) fn noise(arguments: &NoiseArguments, run: &Run) -> Result<ChosenNoise, CliError> {
    let own = run.problem.noise();
    let samples = own.samples();
    let is_gaussian = samples.is_some_and(|own| matches!(own.of_one_step, StepNoise::Gaussian(_)));
    let chosen = match (arguments.noise.as_deref(), &arguments.covariance) {
        (None | Some("gaussian"), Some(covariance)) => {
            let noise = given_gaussian(covariance, arguments.mean.as_deref(), run)?;
            ChosenNoise::new(noise, format!("Gaussian, covariance {covariance}"))
        }
        (Some(other), Some(_)) => {
            return Err(CliError::Input(format!(
                "--covariance: found --noise {other}; expected --noise gaussian"
            )));
        }
        (None, None) if samples.is_none() => {
            ChosenNoise::new(Noise::of_plant(own), "of the known distribution".into())
        }
        (None | Some("gaussian"), None) if is_gaussian => {
            ChosenNoise::new(Noise::of_plant(own), "Gaussian, the model's".into())
        }
        (Some("gaussian"), None) => {
            return Err(CliError::Input(
                "--noise gaussian: found a model with samples only; expected a model with a distribution, or --covariance"
                    .into(),
            ));
        }
        (None | Some("samples"), None) => {
            let own = samples.ok_or_else(|| {
                CliError::Input(
                    "--noise samples: found a model whose noise is known; expected one of samples, or no --noise".into(),
                )
            })?;
            let noise =
                match &own.of_one_step {
                    // Drawn once more, step by step.
                    StepNoise::Gaussian(gaussian) => Noise::StepSamples(gaussian.sample(
                        own.samples.len() * run.problem.group_steps(),
                        own.seed().unwrap_or_default(),
                    )),
                    _ => Noise::of(own),
                };
            let name = format!("the model's {} samples, drawn with replacement", own.samples.len());
            let note = "these are the samples that the promise rests on: this is no independent check of it";
            ChosenNoise { noise, said: SaidOfNoise { name, notes: vec![note.into()] } }
        }
        (Some(file), None) => {
            let noise = given_samples(Path::new(file), arguments.other_samples, run)?;
            ChosenNoise::new(noise, format!("samples of {file}, drawn with replacement"))
        }
    };
    Ok(chosen.with_notes(run.problem.group_steps()))
}

impl ChosenNoise {
    fn new(noise: Noise, name: String) -> Self {
        Self { noise, said: SaidOfNoise { name, notes: vec![] } }
    }

    fn with_notes(mut self, group_steps: usize) -> Self {
        if group_steps > 1 && !self.noise.is_stepwise() {
            self.said.notes.push(format!(
                "samples of {group_steps} steps together come with the last of these steps: states in between are those \
                 without noise"
            ));
        }
        self
    }
}

fn given_gaussian(covariance: &str, mean: Option<&str>, run: &Run) -> Result<Noise, CliError> {
    let malformed = |option: &str, text: &str, expected: &str| {
        CliError::Input(format!("{option}: found \"{text}\"; expected {expected}"))
    };
    let expected = "a matrix in JSON such as [[1,0],[0,1]]";
    let parsed =
        serde_json::from_str(covariance).map_err(|_| malformed("--covariance", covariance, expected))?;
    let mean = mean.map(|text| {
        serde_json::from_str(text).map_err(|_| malformed("--mean", text, "a list in JSON such as [0,0]"))
    });
    let given = GaussianNoise { mean: mean.transpose()?, covariance: parsed };
    let gaussian = given.distribution(run.problem.step_system().state_dimension());
    Ok(Noise::Gaussian(gaussian.map_err(|error| error.in_file("--covariance"))?))
}

fn given_samples(file: &Path, how: OtherSamplesArguments, run: &Run) -> Result<Noise, CliError> {
    if !file.exists() {
        return Err(CliError::Input(format!(
            "--noise: found no file {}; expected gaussian, samples, or a CSV file",
            file.display()
        )));
    }
    let source = NoiseSource::from(SamplesFile {
        name: file.display().to_string(),
        path: file.into(),
        of: how.of(),
        decimal: how.decimal_mark(&run.document),
    });
    let noise = source.obtain(run.problem.step_system(), run.problem.group_steps());
    Ok(Noise::of(&noise.map_err(|error| error.in_file("--noise"))?))
}
