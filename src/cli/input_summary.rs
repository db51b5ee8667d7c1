//! What came of a problem whose actions are inputs, for people and programs.

use super::ending::{Ending, value};
use super::summary::{budget, fixed_beforehand};
use super::{CliError, thousands};
use dynabs::abstraction::inputs::{InputAbstraction, InputModel};
use dynabs::guarantee::{Event, Evidence, Guarantee, SampleEvidence, lower_bound_text};
use dynabs::landing::LandingSolution;
use dynabs::problem::{Components, InputNoise, InputProblem};
use dynabs::system::Variable;
use imdp::numeric::shortest_decimal;
use imdp::property::Verdict;
use imdp::solver::{Answer, SolverOptions, Status};
use serde::Serialize;
use std::fmt::Write as _;
use std::process::ExitCode;
use std::time::Duration;

/// The value of the task.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct InputResult {
    /// The least lower bound of all initial cells.
    pub(super) lower: f64,
    /// The greatest upper bound of all initial cells.
    pub(super) upper: f64,
    /// The bounds of the model that files have, if that is looser.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) exported: Option<[f64; 2]>,
    /// The greatest lower bound of all cells that are neither goal nor lost.
    pub(super) best: f64,
    /// The mean lower bound of these cells.
    pub(super) mean: f64,
    /// Whether the threshold is met from all initial cells; `null` if undecided or not asked.
    pub(super) satisfied: Option<bool>,
    /// How the computation ended.
    pub(super) status: String,
    /// The number of steps.
    pub(super) steps: u64,
    /// How long it took.
    pub(super) seconds: f64,
    #[serde(skip)]
    ended: bool,
    /// Whether the threshold is met or missed, or none was given.
    #[serde(skip)]
    decided: bool,
    #[serde(skip)]
    threshold: Option<String>,
}

impl InputResult {
    pub(super) fn new(
        problem: &InputProblem,
        abstraction: &InputAbstraction,
        solution: &LandingSolution,
        time: Duration,
    ) -> Self {
        let initial = abstraction.initial(problem.initial_cell());
        let at = |values: &[f64], cell: &u32| values[*cell as usize];
        let lower = initial.iter().map(|cell| at(&solution.values.lower, cell)).fold(1.0, f64::min);
        let upper = initial.iter().map(|cell| at(&solution.values.upper, cell)).fold(0.0, f64::max);
        let decided = abstraction.decided();
        let verdict = abstraction.verdict(problem, &solution.values);
        let ended =
            matches!(solution.status, Status::HorizonReached | Status::Converged | Status::PrecisionLimit);
        Self {
            lower,
            upper,
            exported: None,
            best: decided.iter().map(|cell| at(&solution.values.lower, cell)).fold(0.0, f64::max),
            mean: decided.iter().map(|cell| at(&solution.values.lower, cell)).sum::<f64>()
                / decided.len().max(1) as f64,
            satisfied: verdict.and_then(Verdict::decided),
            status: solution.status.to_string(),
            steps: solution.iterations,
            seconds: time.as_secs_f64(),
            threshold: problem.threshold().map(|threshold| format!(">={threshold}")),
            ended,
            decided: verdict.map_or(ended, |verdict| verdict != Verdict::Unknown),
        }
    }

    /// Adds the bounds of the model that files have, if that is looser.
    pub(super) fn with_exported(
        self,
        problem: &InputProblem,
        abstraction: &InputAbstraction,
        options: &SolverOptions<'_>,
    ) -> Self {
        if !abstraction.is_relaxed() {
            return self;
        }
        let values = abstraction.exported().solve(options).values;
        let initial = abstraction.initial(problem.initial_cell());
        let lower = initial.iter().map(|&cell| values.lower[cell as usize]).fold(1.0, f64::min);
        let upper = initial.iter().map(|&cell| values.upper[cell as usize]).fold(0.0, f64::max);
        Self { exported: Some([lower, upper]), ..self }
    }

    /// Adds the bounds of a flat model, which is looser.
    ///
    /// # Errors
    /// [`CliError::Failure`] if the model cannot be asked: a mistake in this program.
    pub(super) fn with_flat(self, flat: &InputModel, options: &SolverOptions<'_>) -> Result<Self, CliError> {
        let value = |property| {
            Answer::new(&flat.model, property, options)
                .map_err(|error| CliError::Failure(format!("{property}: {error}")))
        };
        let [lower, upper] = &flat.properties;
        Ok(Self { exported: Some([value(lower)?.lower, value(upper)?.upper]), ..self })
    }

    /// 1 if the threshold is missed, 3 if that is undecided, else 0.
    pub(super) fn exit_code(&self) -> ExitCode {
        match (self.satisfied, self.decided) {
            (Some(false), _) => ExitCode::from(1),
            (_, false) => ExitCode::from(3),
            (_, true) => ExitCode::SUCCESS,
        }
    }

    /// What it came to, for people: the verdict last.
    pub(super) fn text(&self, place: &str, verbose: bool) -> String {
        let ended = format!("{}, {} steps", self.status, self.steps);
        let mut text = String::new();
        // Writing to a string cannot fail.
        if verbose {
            let time = Duration::from_secs_f64(self.seconds);
            let _ = writeln!(text, "  solved: [{:?}, {:?}], {ended}, {time:.1?}", self.lower, self.upper);
        }
        let (best, mean) = (lower_bound_text(self.best), lower_bound_text(self.mean));
        let _ = writeln!(text, "  over cells: best {best}, mean {mean}");
        if let Some(exported) = self.exported {
            let _ = writeln!(text, "  the model in files is looser: its {}", value(exported));
        }
        let ending = Ending {
            verdict: match (self.satisfied, &self.threshold) {
                (Some(true), _) => "true",
                (Some(false), _) => "false",
                (None, Some(_)) => "undecided",
                (None, None) => "",
            },
            bounds: Some([self.lower, self.upper]),
            threshold: self.threshold.as_deref(),
            place,
            status: (!self.ended).then_some(&ended),
        };
        text + &ending.line()
    }
}

/// The size of things, and how the confidence is spent for whoever wants to know everything.
pub(super) fn summary(problem: &InputProblem, abstraction: &InputAbstraction, verbose: bool) -> String {
    let mut text = format!("{} (actions are inputs)\n", problem.name());
    let mut line = |name: &str, value: String| {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  {name:<13}{value}");
    };
    let mode = problem.mode();
    let named = |all: &[Variable]| all.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    line("state", named(mode.states()));
    if mode.num_inputs() > 0 {
        line("input", named(mode.inputs()));
    }
    if let Some(how) = mode.discretisation() {
        line("step", how.to_string());
    }
    let question = abstraction.question();
    let cells = problem.grid().num_cells();
    line(
        "cells",
        format!(
            "{}, in {} of them something is decided",
            thousands(cells.into()),
            thousands(abstraction.decided().len() as u64)
        ),
    );
    line("inputs", thousands(problem.inputs().len() as u64));
    line("choices", thousands(abstraction.num_choices() as u64));
    let axes = question.landing.axes();
    let by_axis = |of: &dyn Fn(usize) -> String| (0..axes.len()).map(of).collect::<Vec<_>>().join(" × ");
    line(
        "lattice",
        format!(
            "{} sub-cells, {} a cell",
            by_axis(&|j| axes[j].len.to_string()),
            by_axis(&|j| axes[j].resolution.to_string())
        ),
    );
    match &abstraction.evidence {
        Evidence::Samples(samples) => {
            line("noise", format!("{}, from {} samples", kind(samples), thousands(samples.number)));
            let guarantee =
                Guarantee { event: Event::of_inputs(problem), evidence: abstraction.evidence.clone() };
            let confidence = guarantee.confidence().map(shortest_decimal).unwrap_or_default();
            let sweep = match samples.sweep {
                1 => String::new(),
                settings => format!(", of {settings} settings together"),
            };
            line("bounds", format!("hold together with confidence {confidence}{sweep}"));
            if verbose {
                line("budget", budget(samples));
                line("unseen mass", format!("at most {:.6}", samples.unseen_mass));
            }
            line("fixed", fixed_beforehand(&guarantee));
        }
        Evidence::Known { unlisted, .. } => {
            let noise = |j: usize| {
                let taps = axes[j].noise.as_ref();
                taps.map_or("none".to_owned(), |taps| format!("{} intervals", taps.lower.len()))
            };
            let known = match problem.noise() {
                InputNoise::Gaussian(_) => "normal, all components together".to_owned(),
                _ => (0..axes.len()).map(noise).collect::<Vec<_>>().join(", "),
            };
            line("noise", format!("known: {known}"));
            line("unlisted", format!("mass at most {} in a component", shortest_decimal(*unlisted)));
        }
        Evidence::Published { .. } => {}
    }
    text
}

/// What samples bound.
fn kind(samples: &SampleEvidence) -> &'static str {
    match samples.components {
        Some(Components::Intervals) => "components ASSUMED to be independent, by intervals",
        Some(Components::Bands) => {
            "components ASSUMED to be independent, by bands for their distribution functions"
        }
        Some(Components::Joint) | None => "all components together",
    }
}
