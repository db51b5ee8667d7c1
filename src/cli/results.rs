//! Answers as they are printed: a table for people, objects for programs.

use dynabs::guarantee::Claim;
use imdp::property::{Property, Verdict};
use imdp::solver::{Answer, Status};
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;
use std::process::ExitCode;
use std::time::Duration;

/// The answer to one property.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PropertyResult {
    /// The property in PRISM's syntax.
    pub property: String,
    /// The least lower bound of all initial states.
    pub lower: f64,
    /// The greatest upper bound of all initial states.
    pub upper: f64,
    /// For thresholds: whether they hold in all initial states; `null` if undecided or not asked.
    pub satisfied: Option<bool>,
    /// How the computation ended.
    pub status: String,
    /// The number of iterations.
    pub steps: u64,
    /// How long it took.
    pub seconds: f64,
    /// For models of a run: what the answer claims of the system.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub guarantee: Option<Claim>,
    /// Whether the question was answered: it ended by itself and no threshold lies between the bounds.
    #[serde(skip, default)]
    decided: bool,
}

impl PropertyResult {
    /// Summarises an answer.
    pub fn new(property: &Property, answer: &Answer, time: Duration) -> Self {
        let status = answer.solution.status;
        let ended = matches!(status, Status::HorizonReached | Status::Converged);
        Self {
            property: property.to_string(),
            lower: answer.lower,
            upper: answer.upper,
            satisfied: answer.satisfied(),
            status: status.to_string(),
            steps: answer.solution.iterations,
            seconds: time.as_secs_f64(),
            guarantee: None,
            decided: match answer.verdict {
                None => ended,
                Some(verdict) => verdict != Verdict::Unknown,
            },
        }
    }
}

/// 1 if a property is false, else 3 if one is undecided, else 0.
pub(super) fn exit_code(results: &[PropertyResult]) -> ExitCode {
    if results.iter().any(|result| result.satisfied == Some(false)) {
        ExitCode::from(1)
    } else if results.iter().any(|result| !result.decided) {
        ExitCode::from(3)
    } else {
        ExitCode::SUCCESS
    }
}

/// The results as a table.
pub(super) fn table(results: &[PropertyResult]) -> String {
    let mut text = String::new();
    for result in results {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", result.property);
        let width = result.upper - result.lower;
        let digits = if width > 0.0 { (2.0 - width.log10()).clamp(6.0, 15.0) as usize } else { 12 };
        let caveat = result.guarantee.as_ref().and_then(|claim| claim.caveat.as_ref());
        let verdict = match (result.satisfied, result.decided) {
            // Never a bare `true` where a reader may take it for more.
            (Some(true), _) if caveat.is_some() => "true at grouped instants only   ".to_owned(),
            (Some(satisfied), _) => format!("{satisfied}   "),
            (None, true) => String::new(),
            (None, false) => "undecided   ".to_owned(),
        };
        let _ = writeln!(
            text,
            "  {verdict}value in [{:.digits$}, {:.digits$}] at the initial state   {}, {} steps, {:.1?}",
            result.lower,
            result.upper,
            result.status,
            result.steps,
            Duration::from_secs_f64(result.seconds),
        );
        if let Some(claim) = &result.guarantee {
            let covered = if claim.covered { "covered" } else { "not covered" };
            let caveat = caveat.map_or(String::new(), |caveat| format!("; {caveat}"));
            let _ = writeln!(text, "  {covered}: {}{caveat}", claim.text);
        }
    }
    text
}
