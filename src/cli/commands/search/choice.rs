//! The setting that is chosen, compiled once more: as a run to use.

use super::seek::{Candidate, Seeker};
use super::split::Half;
use crate::CliError;
use crate::commands::sweep::figures::{Figure, figure};
use crate::commands::sweep::job::{Job, Purpose};
use crate::commands::sweep::spec::Sweep;
use serde_json::Value;
use std::path::Path;

/// The directory of the choice.
pub(super) const CHOSEN: &str = "chosen";

/// The choice.
pub(super) struct Choice {
    /// Its place among the candidates.
    pub(super) place: usize,
    /// What is promised of it: where samples were split, by those that nobody had looked at.
    pub(super) lower: f64,
    /// The number of samples that promise that and the confidence, where it rests on samples.
    pub(super) confidence: Option<f64>,
    /// Whether other samples promise it than those that it was chosen by.
    pub(super) is_fresh: bool,
}

impl Choice {
    /// Chooses the cheapest candidate with the wanted bound, if one has it, and writes its run.
    ///
    /// # Errors
    /// [`CliError`] if the run cannot be made.
    pub(super) fn make(
        seeker: &Seeker<'_>,
        sweep: &Sweep,
        candidates: &[Candidate],
        fresh: Option<Half>,
        below: &Path,
    ) -> Result<Option<Self>, CliError> {
        let Some(wanted) = seeker.wanted else { return Ok(None) };
        let good = candidates.iter().enumerate().filter_map(|(place, candidate)| {
            let bound = candidate.bound().filter(|bound| bound.lower >= wanted)?;
            Some((bound.cost, place, candidate))
        });
        let Some((_, place, candidate)) = good.min_by_key(|&(cost, place, _)| (cost, place)) else {
            return Ok(None);
        };
        let is_fresh = fresh.is_some();
        let mut setting = candidate.job.setting.clone();
        setting.extend(fresh.unwrap_or_default());
        let job = Job::at(below.join(CHOSEN), &sweep.model, setting)?;
        let result = seeker.result(&job, Purpose::WholeRun)?.map_err(CliError::Failure)?;
        let number = |of| figure(&result, of).and_then(Value::as_f64);
        let lower = number(Figure::Lower).ok_or_else(|| {
            CliError::Failure(format!("{}: it ended without a bound", job.directory.display()))
        })?;
        Ok(Some(Self { place, lower, confidence: number(Figure::Confidence), is_fresh }))
    }
}
