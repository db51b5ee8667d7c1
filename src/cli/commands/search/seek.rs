//! The order in which settings are tried, and when to stop.
//!
//! What a setting costs at least is known before it is solved: cells and samples from its model file, transitions from its
//! compilation. The cheapest is solved first, so the first one with the wanted bound is the choice as soon as nothing that is
//! left can cost less. What is left out besides is left out with a proof: where actions are inputs and there is no feedback, an
//! upper bound holds for every controller with these inputs, however finely it looks at the state; settings that differ in
//! nothing but cells and resolution need not be tried once it is below what is wanted. No other bound says anything of another
//! setting: with targets a finer grid has other actions, and its intervals are wider.

use super::cost::Cost;
use crate::CliError;
use crate::commands::sweep::figures::{Figure, figure};
use crate::commands::sweep::job::{Job, Outcome, Purpose};
use crate::commands::sweep::program::Program;
use crate::commands::sweep::spec::{Extent, Sweep};
use serde_json::{Map, Value};

/// How finely the same system is looked at.
const FINENESS: [&str; 2] = ["/partition/cells", "/partition/resolution"];

/// A setting that may be tried.
pub(super) struct Candidate {
    pub(super) job: Job,
    pub(super) extent: Extent,
    /// Its transitions, choices or bytes, if they are known.
    pub(super) size: Option<u64>,
    pub(super) state: State,
}

/// What became of it.
pub(super) enum State {
    /// It was solved.
    Tried(Bound),
    /// It costs no less than the choice.
    NotNeeded,
    /// No controller with these inputs has what is wanted.
    Excluded {
        /// The setting that shows it.
        by: String,
        /// The bound that no controller exceeds.
        upper: f64,
    },
    /// It has no bound.
    Failed(String),
}

/// What a setting promises, at which cost.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bound {
    pub(super) lower: f64,
    pub(super) cost: u64,
}

impl Candidate {
    /// Its bound, if it was tried.
    pub(super) fn bound(&self) -> Option<Bound> {
        match self.state {
            State::Tried(bound) => Some(bound),
            _ => None,
        }
    }
}

/// Who tries settings.
pub(super) struct Seeker<'a> {
    pub(super) program: &'a Program,
    pub(super) cost: Cost,
    pub(super) wanted: Option<f64>,
    /// Whether what is found holds of all settings together, so that one can say something of another.
    pub(super) together: bool,
    /// Is told of what has been done.
    pub(super) tell: &'a dyn Fn(&str),
}

impl Seeker<'_> {
    /// Tries the settings until nothing that is left can be cheaper than the choice; all of them in the order of their numbers.
    ///
    /// # Errors
    /// [`CliError`] if a process cannot be started.
    pub(super) fn seek(&self, sweep: &Sweep, jobs: Vec<Job>) -> Result<Vec<Candidate>, CliError> {
        let mut open = Vec::new();
        let mut ended = Vec::new();
        for (number, (job, &extent)) in jobs.into_iter().zip(&sweep.extents).enumerate() {
            match self.least(&job, extent)? {
                Ok(least) => open.push((least, number, job, extent)),
                Err(failed) => {
                    ended.push((number, Candidate { job, extent, size: None, state: State::Failed(failed) }))
                }
            }
        }
        open.sort_by_key(|&(least, number, ..)| (least, number));
        let mut cheapest = u64::MAX;
        let mut ceilings = Vec::new();
        for (least, number, job, extent) in open {
            let system = self.same_system(sweep, &job, extent)?;
            let same = |(of, ..): &&(Map<String, Value>, String, f64)| Some(of) == system.as_ref();
            let ceiling = ceilings.iter().find(same);
            let mut size = (self.cost == Cost::Transitions).then_some(least);
            let state = match ceiling {
                _ if least >= cheapest => State::NotNeeded,
                Some((_, by, upper)) => State::Excluded { by: by.clone(), upper: *upper },
                None => match self.result(&job, Purpose::Bound)? {
                    Err(failed) => State::Failed(failed),
                    Ok(result) => {
                        size = self.cost.size(&result);
                        let number = |of| figure(&result, of).and_then(Value::as_f64);
                        if let (Some(system), Some(upper), Some(wanted)) =
                            (system, number(Figure::Upper), self.wanted)
                            && upper < wanted
                        {
                            ceilings.push((system, job.name(), upper));
                        }
                        match (number(Figure::Lower), self.cost.of(extent, &result)) {
                            (Some(lower), Some(cost)) => State::Tried(Bound { lower, cost }),
                            _ => State::Failed("it ended without a bound".to_owned()),
                        }
                    }
                },
            };
            if let State::Tried(Bound { lower, cost }) = state {
                (self.tell)(&format!(
                    "{}: {lower:.6} from {cost} {}\n",
                    job.name(),
                    self.cost.words(extent.takes_inputs)
                ));
                if self.wanted.is_some_and(|wanted| lower >= wanted) {
                    cheapest = cheapest.min(cost);
                }
            }
            ended.push((number, Candidate { job, extent, size, state }));
        }
        ended.sort_by_key(|&(number, _)| number);
        Ok(ended.into_iter().map(|(_, candidate)| candidate).collect())
    }

    /// What a job costs at least, or why it fails.
    fn least(&self, job: &Job, extent: Extent) -> Result<Result<u64, String>, CliError> {
        if let Some(least) = self.cost.beforehand(extent) {
            return Ok(Ok(least));
        }
        let result = self.result(job, Purpose::Size)?;
        Ok(result.and_then(|result| {
            self.cost.of(extent, &result).ok_or_else(|| "it ended without a size".to_owned())
        }))
    }

    /// What a job printed, now or when it was run before; or why it failed.
    pub(super) fn result(&self, job: &Job, purpose: Purpose) -> Result<Result<Value, String>, CliError> {
        if matches!(job.outcome(purpose), Outcome::Open) {
            job.run(self.program, purpose).map_err(|error| CliError::writing(&job.directory, &error))?;
        }
        Ok(match job.outcome(purpose) {
            Outcome::Done(result) => Ok(*result),
            Outcome::Failed(failed) => Err(failed),
            Outcome::Open => Err("it ended without a result".to_owned()),
        })
    }

    /// The system that a job looks at, if an upper bound holds for all controllers of it.
    fn same_system(
        &self,
        sweep: &Sweep,
        job: &Job,
        extent: Extent,
    ) -> Result<Option<Map<String, Value>>, CliError> {
        let has_feedback =
            || Ok::<_, CliError>(sweep.document(&job.setting)?.value.pointer("/feedback").is_some());
        if !self.together || !extent.takes_inputs || has_feedback()? {
            return Ok(None);
        }
        let is_kept = |pointer: &&String| !FINENESS.contains(&pointer.as_str());
        let kept = job.setting.iter().filter(|(pointer, _)| is_kept(pointer));
        Ok(Some(kept.map(|(pointer, value)| (pointer.clone(), value.clone())).collect()))
    }
}
