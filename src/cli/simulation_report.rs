//! What a simulation showed, for people and programs.

use super::simulation_noise::SaidOfNoise;
use super::{CliError, thousands, warn};
use dynabs::controller::{Controller, Frequency, Tally};
use dynabs::guarantee::lower_bound_text;
use dynabs::task::{Aim, Safety};
use imdp::numeric::{Rational, from_decimal, shortest_decimal, to_f64};
use num_traits::One;
use serde::Serialize;
use std::fmt::Write as _;
use std::process::ExitCode;

/// A simulation against the promise.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Report {
    name: String,
    mode: &'static str,
    from: Vec<f64>,
    noise: String,
    #[serde(skip)]
    region: &'static str,
    seed: u64,
    /// The promised probability of success from there.
    bound: f64,
    /// The confidence of the promise; none in reference mode, which promises nothing.
    promise_confidence: Option<f64>,
    /// When the unsafe region is to be avoided.
    safety: Safety,
    /// In the true sets, as promised.
    satisfied: Frequency,
    /// With everything unsafe avoided at every original step.
    satisfied_at_every_step: Frequency,
    /// In goal cells.
    reached: Frequency,
    contradiction: bool,
    counts: Tally,
    inputs_checked: u64,
    group_steps: u64,
    seconds: f64,
    notes: Vec<String>,
}

/// What was simulated and what it came to.
pub(super) struct Simulated {
    pub(super) from: Vec<f64>,
    pub(super) seed: u64,
    /// Of the Clopper–Pearson intervals.
    pub(super) confidence: f64,
    pub(super) tally: Tally,
    pub(super) seconds: f64,
}

impl Report {
    pub(super) fn new(name: &str, controller: &Controller, noise: SaidOfNoise, simulated: Simulated) -> Self {
        let (guarantee, bound) = (controller.guarantee(), controller.bound_at(&simulated.from));
        let Simulated { from, seed, confidence, tally, seconds } = simulated;
        // Of the decimal that was written: 0.01 for 0.99.
        let alpha = from_decimal(confidence).map_or(0.01, |p| to_f64(&(Rational::one() - p)));
        let safety = guarantee.event.safety;
        let satisfied = tally.satisfaction(safety, alpha);
        Self {
            name: name.to_owned(),
            mode: guarantee.mode(),
            from,
            region: match (&guarantee.event.task, guarantee.event.aim) {
                (Some(_), _) => "by the whole run",
                (None, Aim::Reach) => "in the goal region",
                (None, Aim::Stay | Aim::End) => "in the safe region",
            },
            noise: noise.name,
            seed,
            bound,
            promise_confidence: guarantee.confidence(),
            safety,
            satisfied,
            satisfied_at_every_step: tally.satisfaction(Safety::EveryStep, alpha),
            reached: tally.reaching(safety, alpha),
            contradiction: satisfied.contradicts(bound),
            inputs_checked: tally.steps * controller.group_steps() as u64,
            counts: tally,
            group_steps: guarantee.event.group_steps,
            seconds,
            notes: noise.notes,
        }
    }

    pub(super) fn text(&self) -> String {
        let from: Vec<_> = self.from.iter().map(|&x| shortest_decimal(x)).collect();
        let mut text = format!(
            "{} ({} mode): {} runs from ({})\n",
            self.name,
            self.mode,
            thousands(self.counts.runs),
            from.join(", ")
        );
        let mut line = |name: &str, value: String| {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "  {name:<12}{value}");
        };
        line("noise", self.noise.clone());
        let promise = match self.promise_confidence {
            Some(confidence) => format!("with confidence {confidence}"),
            None => "in reference mode: not a guarantee".to_owned(),
        };
        line("promised", format!("at least {} {promise}", lower_bound_text(self.bound)));
        let when = match (self.group_steps, self.safety) {
            (1, _) => "",
            (_, Safety::EveryStep) => ", safe at every step",
            (_, Safety::GroupedInstants) => ", safe at grouped instants",
        };
        line("satisfied", format!("{} {}{when}", frequency(&self.satisfied), self.region));
        line("reached", format!("{} in goal cells{when}", frequency(&self.reached)));
        if self.group_steps > 1 && self.safety == Safety::GroupedInstants {
            let every = frequency(&self.satisfied_at_every_step);
            line("every step", format!("{every} safe at every step: this is not promised"));
        }
        let counts = &self.counts;
        let ends = [
            ("reached", counts.reached),
            ("unsafe", counts.r#unsafe),
            ("outside", counts.outside),
            ("no action", counts.no_action),
            ("horizon over", counts.over),
            ("given up", counts.unfinished),
        ];
        let ends: Vec<_> = (ends.iter().filter(|(_, count)| *count > 0))
            .map(|(name, count)| format!("{name} {}", thousands(*count)))
            .collect();
        line("ended", ends.join(", "));
        let (checked, violations) = (thousands(self.inputs_checked), thousands(counts.violations));
        line("inputs", format!("{checked} checked, {violations} outside U"));
        if self.group_steps > 1 {
            line(
                "in between",
                format!(
                    "{} runs met something unsafe between grouped instants",
                    thousands(counts.unsafe_between)
                ),
            );
        }
        line("time", format!("{:.2} s", self.seconds));
        for note in &self.notes {
            line("note", note.clone());
        }
        text
    }

    /// Says on stderr what should not be.
    pub(super) fn warn(&self) {
        if self.contradiction {
            let meaning = match self.promise_confidence {
                Some(_) => {
                    "the samples are among the few that mislead, the noise is not the one they are of, or there is \
                            a mistake in dynabs"
                }
                None => "reference mode promises nothing",
            };
            warn(&format!(
                "warning: the simulation contradicts the promise: at least {} against at most {:.6} with confidence {}\n  \
                 Either {meaning}.\n",
                lower_bound_text(self.bound),
                self.satisfied.upper,
                self.satisfied.confidence
            ));
        }
    }

    /// The exit code.
    ///
    /// # Errors
    /// [`CliError::Failure`] if an input left `U`.
    pub(super) fn outcome(&self) -> Result<ExitCode, CliError> {
        if let Some(first) = &self.counts.first_violation {
            return Err(CliError::Failure(format!(
                "{} inputs were outside U, the first in run {}, step {}: u = {:?} in x = {:?} exceeds half-space {} by {:e}\n  \
                 This is a mistake in dynabs; please report it.",
                self.counts.violations,
                first.run,
                first.step,
                first.input,
                first.state,
                first.half_space,
                first.excess
            )));
        }
        Ok(ExitCode::from(u8::from(self.contradiction)))
    }
}

fn frequency(f: &Frequency) -> String {
    format!("{:.6} in [{:.6}, {:.6}] with confidence {}", f.frequency, f.lower, f.upper, f.confidence)
}
