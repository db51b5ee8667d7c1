//! What the bound would be with more samples.

use super::Reason;
use crate::abstraction::Abstraction;
use crate::problem::Problem;
use imdp::model::IntervalMdp;
use imdp::solver::{Answer, SolverOptions};

/// A bound this near to that of all samples in the world is not the samples' fault.
const NEAR: f64 = 0.01;
/// Intervals are narrowed by these factors, to find the first that is enough.
const FACTORS: [f64; 6] = [0.7, 0.5, 0.35, 0.25, 0.1, 0.05];
/// Narrowed models are solved again, with rows that are stored: with more entries all together, that takes longer and more memory
/// than the model itself, whose rows may be shifts of one another.
const MOST_ENTRIES: usize = 1 << 22;

/// The value with probabilities in the middle of their intervals, and the number of samples that would bring the bound
/// near to it; nothing if there are none, if the model is too large to be narrowed, or if the value is the bound.
pub(super) fn weigh(problem: &Problem, abstraction: &Abstraction, answer: &Answer) -> Option<Reason> {
    let samples = problem.noise().samples()?.samples.len();
    let model = &abstraction.model;
    if model.rows().num_entries() > MOST_ENTRIES {
        return None;
    }
    let value = |model: &IntervalMdp| {
        let options = SolverOptions { epsilon: 1e-4, ..SolverOptions::default() };
        Some(Answer::new(model, &abstraction.property, &options).ok()?.lower)
    };
    let exact = value(&model.narrowed(0.0).ok()?)?;
    if exact - answer.lower < NEAR {
        return None;
    }
    let enough = FACTORS.into_iter().find(|&factor| {
        model.narrowed(factor).ok().and_then(|model| value(&model)).is_some_and(|value| exact - value < NEAR)
    });
    // Intervals narrow like one over the root of the number of samples.
    let needed = enough.map(|factor| (samples as f64 / (factor * factor)).ceil() as u64);
    Some(Reason::Samples { exact, samples, needed })
}
