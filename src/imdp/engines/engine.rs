//! What engines have in common.

use super::{EngineQuestion, Reply, RunLimits, Subject};

/// A solver of other people.
pub trait Engine {
    /// Its name.
    fn name(&self) -> &'static str;

    /// When it stops without a bound on the steps, in words.
    fn stopping(&self) -> String;

    /// How much a value may still change in one step when it stops without a bound on the steps.
    fn settled(&self, value: f64) -> f64;

    /// Asks every question; one reply for each.
    fn ask(&self, subject: &Subject<'_>, questions: &[EngineQuestion], limits: &RunLimits<'_>) -> Vec<Reply>;
}
