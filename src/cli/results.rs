//! Answers as they are printed: a table for people, objects for programs.

use super::ending::{Ending, value};
use dynabs::guarantee::Claim;
use imdp::compare::{InitialResult, RecordedResult};
use imdp::evaluation::Evaluation;
use imdp::model::{IntervalMdp, StateId};
use imdp::property::{Compound, Property, Question, Verdict};
use imdp::solver::{Answer, Inexact, Status};
use serde::Serialize;
use std::fmt::Write as _;
use std::process::ExitCode;
use std::time::Duration;

/// The answer to one property.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PropertyResult {
    /// What is recorded of it.
    #[serde(flatten)]
    pub recorded: RecordedResult,
    /// For models of a run: what the answer claims of the system.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub guarantee: Option<Claim>,
    /// Whether the question was answered: it ended by itself and no threshold lies between the bounds.
    #[serde(skip)]
    decided: bool,
    /// Whether the computation ended by itself.
    #[serde(skip)]
    ended: bool,
    /// What the value is compared with.
    #[serde(skip)]
    threshold: Option<String>,
}

/// JSON has no infinity: it is written as PRISM does, in quotation marks.
pub(crate) fn number(value: f64) -> serde_json::Value {
    match value.is_infinite() {
        true => if value > 0.0 { "Infinity" } else { "-Infinity" }.into(),
        false => value.into(),
    }
}

impl PropertyResult {
    /// Summarises an answer about a model.
    pub fn new(property: &Property, answer: &Answer, model: &IntervalMdp, time: Duration) -> Self {
        let in_state = |state: StateId| InitialResult {
            state,
            lower: Some(answer.values.lower[state.index()]),
            upper: Some(answer.values.upper[state.index()]),
            satisfied: answer.verdict_of(state).and_then(Verdict::decided),
        };
        let verdict = answer.verdict;
        let (status, steps) = (answer.solution.status, answer.solution.iterations);
        let result = Self::of_states(property.to_string(), model, in_state, verdict, (status, steps, time));
        let threshold = match &property.question {
            Question::Value(_) => None,
            Question::Verdict(_, threshold) | Question::ForAll(threshold) => Some(threshold.to_string()),
        };
        Self { threshold, ..result.undecided_because(answer.inexact) }
    }

    /// Summarises an expression.
    pub(crate) fn of_evaluation(
        compound: &Compound,
        evaluation: &Evaluation,
        model: &IntervalMdp,
        time: Duration,
    ) -> Self {
        let in_state = |state: StateId| {
            let bounds = evaluation.bounds(state);
            InitialResult {
                state,
                lower: bounds.map(|bounds| bounds.0),
                upper: bounds.map(|bounds| bounds.1),
                satisfied: evaluation.verdict(state).and_then(Verdict::decided),
            }
        };
        let verdicts: Option<Vec<Verdict>> =
            model.initial().ones().map(|state| evaluation.verdict(StateId::from_index(state))).collect();
        let ending = (evaluation.status, evaluation.iterations, time);
        let verdict = verdicts.map(Verdict::in_all);
        Self::of_states(compound.to_string(), model, in_state, verdict, ending)
            .undecided_because(evaluation.inexact)
    }

    /// The same, with the reason why exact arithmetic did not decide it.
    fn undecided_because(mut self, reason: Option<Inexact>) -> Self {
        // What was stopped says so.
        let reason = reason.filter(|reason| !self.decided && *reason != Inexact::Stopped);
        self.recorded.undecided = reason.map(|reason| {
            format!("the threshold lies between the bounds, and {reason}; a smaller --epsilon may decide it")
        });
        self
    }

    fn of_states(
        property: String,
        model: &IntervalMdp,
        in_state: impl Fn(StateId) -> InitialResult,
        verdict: Option<Verdict>,
        (status, steps, time): (Status, u64, Duration),
    ) -> Self {
        let initial: Vec<InitialResult> =
            model.initial().ones().map(|state| in_state(StateId::from_index(state))).collect();
        let ended = matches!(status, Status::HorizonReached | Status::Converged);
        let recorded = RecordedResult {
            property,
            lower: initial.iter().filter_map(|result| result.lower).reduce(f64::min),
            upper: initial.iter().filter_map(|result| result.upper).reduce(f64::max),
            satisfied: verdict.and_then(Verdict::decided),
            status: Some(status.to_string()),
            steps: Some(steps),
            seconds: Some(time.as_secs_f64()),
            initial: if initial.len() > 1 { initial } else { vec![] },
            undecided: None,
            error: None,
        };
        let decided = verdict.map_or(ended, |verdict| verdict != Verdict::Unknown);
        Self { recorded, guarantee: None, decided, ended, threshold: None }
    }

    /// A property without an answer.
    pub(crate) fn failed(property: &str, error: String) -> Self {
        let recorded = RecordedResult {
            property: property.to_owned(),
            status: Some("failed".to_owned()),
            steps: Some(0),
            seconds: Some(0.0),
            error: Some(error),
            ..RecordedResult::default()
        };
        Self { recorded, guarantee: None, decided: false, ended: false, threshold: None }
    }

    /// Bounds on the value, if it is a probability.
    pub(super) fn bounds(&self) -> [f64; 2] {
        [self.recorded.lower.unwrap_or(0.0), self.recorded.upper.unwrap_or(1.0)]
    }
}

/// 2 if a property has no answer, else 1 if one is false, else 3 if one is undecided, else 0.
pub(super) fn exit_code(results: &[PropertyResult]) -> ExitCode {
    if results.iter().any(|result| result.recorded.error.is_some()) {
        ExitCode::from(2)
    } else if results.iter().any(|result| result.recorded.satisfied == Some(false)) {
        ExitCode::from(1)
    } else if results.iter().any(|result| !result.decided) {
        ExitCode::from(3)
    } else {
        ExitCode::SUCCESS
    }
}

/// So many initial states are listed at most.
const LISTED: usize = 10;

/// The results as a table: what there is to know about each, and its verdict last.
pub(super) fn table(results: &[PropertyResult], verbose: bool) -> String {
    results.iter().map(|result| result.text(verbose)).collect()
}

impl PropertyResult {
    fn text(&self, verbose: bool) -> String {
        let result = &self.recorded;
        let mut text = format!("{}\n", result.property);
        if result.error.is_some() {
            return text + "  not answered\n";
        }
        // Writing to a string cannot fail.
        let bounds = result.lower.zip(result.upper).map(|(lower, upper)| [lower, upper]);
        let ended =
            format!("{}, {} steps", result.status.as_deref().unwrap_or("unknown"), result.steps.unwrap_or(0));
        if verbose {
            let time = Duration::from_secs_f64(result.seconds.unwrap_or(0.0));
            let digits = bounds.map_or(String::new(), |bounds| format!("{}, ", all_digits(bounds)));
            let _ = writeln!(text, "  solved: {digits}{ended}, {time:.1?}");
        }
        for InitialResult { state, lower, upper, satisfied } in result.initial.iter().take(LISTED) {
            let verdict = satisfied.map_or(String::new(), |satisfied| format!("{satisfied}   "));
            let value = lower.zip(*upper).map_or(String::new(), |(lower, upper)| value([lower, upper]));
            let _ = writeln!(text, "    state {state}: {}", format!("{verdict}{value}").trim_end());
        }
        if result.initial.len() > LISTED {
            let more = result.initial.len() - LISTED;
            let _ = writeln!(text, "    and {more} more; --values writes those of all states");
        }
        let caveat = self.guarantee.as_ref().and_then(|claim| claim.caveat.as_ref());
        if let Some(claim) = &self.guarantee {
            let covered = if claim.covered { "covered" } else { "not covered" };
            let caveat = caveat.map_or(String::new(), |caveat| format!("; {caveat}"));
            let _ = writeln!(text, "  {covered}: {}{caveat}", claim.text);
        }
        if let Some(reason) = &result.undecided {
            let _ = writeln!(text, "  {reason}");
        }
        let place = match result.initial.len() {
            0 => "at the initial state".to_owned(),
            count => format!("at {count} initial states"),
        };
        let ending = Ending {
            verdict: match (result.satisfied, self.decided) {
                // Never a bare `true` where a reader may take it for more.
                (Some(true), _) if caveat.is_some() => "true at grouped instants only",
                (Some(true), _) => "true",
                (Some(false), _) => "false",
                (None, true) => "",
                (None, false) => "undecided",
            },
            bounds,
            threshold: self.threshold.as_deref(),
            place: &place,
            status: (!self.ended).then_some(&ended),
        };
        text + &ending.line()
    }
}

/// Bounds with as many digits as they are worth.
fn all_digits([lower, upper]: [f64; 2]) -> String {
    let width = upper - lower;
    let digits = if width > 0.0 { (2.0 - width.log10()).clamp(6.0, 15.0) as usize } else { 12 };
    format!("[{lower:.digits$}, {upper:.digits$}]")
}

#[cfg(test)]
mod tests {
    use super::*;
    use imdp::formats::Format;
    use imdp::solver::SolverOptions;

    #[test]
    fn what_is_undecided_says_why() {
        let scratch = tempfile::tempdir().unwrap();
        let path = scratch.path().join("m.tra");
        std::fs::write(&path, "2 2 3\n0 0 0 [0.4,0.6]\n0 0 1 [0.4,0.6]\n1 0 1 1\n").unwrap();
        std::fs::write(path.with_extension("lab"), "0=\"init\" 1=\"goal\"\n0: 0\n1: 1\n").unwrap();
        let model = Format::Prism.import(&path, &()).unwrap().model;
        let property: Property = "(Pmaxmin=? [ F<=1 \"goal\" ])>=0.4".parse().unwrap();
        let result = |exact_work| {
            let options = SolverOptions { exact_work, ..SolverOptions::default() };
            let answer = Answer::new(&model, &property, &options).unwrap();
            PropertyResult::new(&property, &answer, &model, Duration::ZERO)
        };
        let undecided = result(0);
        let text = table(std::slice::from_ref(&undecided), false);
        assert!(
            text.lines().last().unwrap().starts_with("  undecided   value ")
                && text.contains("against >=0.4 at")
                && text.contains("exact arithmetic would take too long"),
            "{text}"
        );
        assert!(undecided.recorded.satisfied.is_none() && undecided.recorded.undecided.is_some());
        let decided = result(1 << 20);
        assert_eq!((decided.recorded.satisfied, decided.recorded.undecided), (Some(true), None));
    }
}
