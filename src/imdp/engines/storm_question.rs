//! Questions in Storm's language.

use super::{EngineQuestion, Handed, QuestionKind};
use crate::model::StateSet;
use crate::property::{Query, QueryKind};

/// A question in Storm's language.
pub(super) struct StormQuestion {
    /// Which question it is.
    pub number: usize,
    pub formula: String,
    pub nature_maximises: bool,
    /// The labels in the formula that the model does not have yet.
    pub labels: Vec<(String, StateSet)>,
    /// Whether there is no bound on the steps: with one Storm has no strategy.
    pub is_unbounded: bool,
    /// Whether the value asked for is 1 minus Storm's.
    pub complement: bool,
}

impl StormQuestion {
    /// # Errors
    /// Why Storm is not asked, in words.
    pub(super) fn new(number: usize, question: &EngineQuestion, handed: Handed<'_>) -> Result<Self, String> {
        let QuestionKind::Event { value, query } = &question.kind else {
            return Err("it is asked about one probability of F, G, U or X only".to_owned());
        };
        let (formula, labels) = match handed {
            // The text of the property as it is, for files that have no labels of ours.
            Handed::AsIs(..) if query.complement => {
                return Err("its G takes the wrong side of nature".to_owned());
            }
            Handed::AsIs(..) => (format!("P{}=? [ {} ]", policy(query), value.path), vec![]),
            Handed::Copy | Handed::Explicit(_) => formula(number, query),
        };
        Ok(Self {
            number,
            formula,
            nature_maximises: query.resolution.nature_maximises(),
            labels,
            is_unbounded: question.steps().is_none(),
            complement: query.complement,
        })
    }
}

fn policy(query: &Query) -> &'static str {
    if query.resolution.policy_maximises() { "max" } else { "min" }
}

/// The event of a query in Storm's language, and the labels in it.
///
/// Sets of states become labels of their own: Storm's format has no variables, and its `G` takes the wrong side
/// of nature, so that what it is asked is the query and not the text of the property.
fn formula(number: usize, query: &Query) -> (String, Vec<(String, StateSet)>) {
    let mut labels = vec![];
    let mut name = |what: &str, set: &StateSet| {
        if set.is_clear() {
            // Labels without states are unknown to Storm.
            return "false".to_owned();
        } else if set.is_full() {
            return "true".to_owned();
        }
        let name = format!("{what}{number}");
        labels.push((name.clone(), set.clone()));
        format!("\"{name}\"")
    };
    let path = match &query.kind {
        QueryKind::Next { goal } => format!("X {}", name("goal", goal)),
        QueryKind::Until { safe, goal, steps } => {
            let bound = steps.map(|steps| format!("<={steps}")).unwrap_or_default();
            format!("{} U{bound} {}", name("safe", safe), name("goal", goal))
        }
    };
    (format!("P{}=? [ {path} ]", policy(query)), labels)
}
