//! What is promised about a controller, in words and numbers.

use crate::controller::Controller;
use crate::model_file::{Probabilities, Problem, Safety};
use crate::partition::CellKind;
use imdp::numeric::{Rational, round_decimal_down, shortest_decimal, to_f64};
use num_traits::One;
use serde::Serialize;

/// The guarantee that comes with a controller.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Promise {
    /// `pac`, or `reference`, in which nothing is promised.
    pub mode: &'static str,
    /// The probability with which the promise holds, over the samples.
    pub confidence: Option<f64>,
    /// The number of samples that it rests on.
    pub samples: u64,
    /// The state it was asked for.
    pub initial_state: Option<Vec<f64>>,
    /// The least probability of success from there; without such a state, from the worst ordinary cell.
    pub bound: f64,
    /// The number of original steps within which the goal is reached; none for unbounded tasks.
    pub horizon: Option<u64>,
    /// Every how many steps inputs are decided.
    pub group_steps: u64,
    /// When the unsafe region is avoided.
    pub safety: Safety,
}

impl Promise {
    /// What is promised about the controller of a problem.
    pub fn new(problem: &Problem, controller: &Controller) -> Self {
        let confidence = match &problem.probabilities {
            Probabilities::Pac { beta, .. } => Some(to_f64(&(Rational::one() - beta))),
            Probabilities::Reference { .. } => None,
        };
        let group_steps = problem.group_steps as u64;
        let ordinary = problem.labels.iter().filter(|(_, kind)| *kind == CellKind::Ordinary);
        Self {
            mode: if confidence.is_some() { "pac" } else { "reference" },
            confidence,
            samples: problem.noise.samples.len() as u64,
            initial_state: problem.initial_state.clone(),
            bound: match problem.initial_cell {
                Some(cell) => controller.bound(cell),
                None => ordinary.map(|(cell, _)| controller.bound(cell)).fold(1.0, f64::min),
            },
            horizon: problem.horizon.map(|steps| steps * group_steps),
            group_steps,
            safety: problem.safety,
        }
    }

    /// The promise as sentences of plain ASCII.
    pub fn sentences(&self) -> Vec<String> {
        let start = match &self.initial_state {
            Some(x) => {
                let numbers: Vec<_> = x.iter().map(|&x| shortest_decimal(x)).collect();
                format!("From the cell of x = ({})", numbers.join(", "))
            }
            None => "From any cell that is not unsafe".to_owned(),
        };
        let within = self.horizon.map_or(String::new(), |steps| format!(" within {steps} steps"));
        let bound = lower_bound_text(self.bound);
        let mut sentences = vec![match self.confidence {
            Some(confidence) => format!(
                "{start} the goal is reached{within}, avoiding the unsafe region and the outside of the \
                 partition, with probability at least {bound}. This holds with confidence {} over the {} noise \
                 samples, for noise that is independent of them and distributed like them.",
                shortest_decimal(confidence),
                self.samples
            ),
            None => format!(
                "{start} the value is {bound}{within}. It was computed in reference mode, to compare with the \
                 published tool: nothing is guaranteed."
            ),
        }];
        if self.group_steps > 1 {
            sentences.push(match self.safety {
                Safety::EveryStep => format!(
                    "Safety is meant at every step, although inputs are decided every {} steps only.",
                    self.group_steps
                ),
                Safety::GroupedInstants => format!(
                    "Safety is checked every {} steps only: the unsafe region may be crossed in between.",
                    self.group_steps
                ),
            });
        }
        sentences
    }
}

/// A lower bound with six digits, rounded down.
pub fn lower_bound_text(bound: f64) -> String {
    shortest_decimal(round_decimal_down(bound, 6))
}
