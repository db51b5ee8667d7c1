//! The checker.

use super::bounds::Bounds;
use super::one_step::{ExactRows, NO_CHOICE, SideProof};
use super::ranks::check_ranks;
use super::task::Task;
use super::{Rejection, Side};
use crate::certificate::{Certificate, Evidence, FileDigest, Inductive, Step};
use crate::model::{IntervalMdp, StateId};
use crate::numeric::{Rational, one_minus_down, one_minus_up};
use crate::property::{PropertyError, QueryKind, Resolution, Threshold, Verdict};
use num_traits::One;

/// What an accepted certificate proves, and how much was checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Proved {
    /// The value is at least this in every initial state.
    pub lower: f64,
    /// The value is at most this in every initial state.
    pub upper: f64,
    /// For thresholds: whether they hold in all initial states.
    pub verdict: Option<Verdict>,
    /// The number of states.
    pub states: u64,
    /// The number of steps that were checked; one for inductive bounds.
    pub steps: u64,
    /// The number of expectations of rows that were computed.
    pub rows: u64,
}

/// Checks a certificate against a model and the digests of the files it was read from.
///
/// # Errors
/// [`Rejection`] says what does not follow, in which step and state.
pub fn check(
    certificate: &Certificate,
    model: &IntervalMdp,
    files: &[FileDigest],
) -> Result<Proved, Rejection> {
    check_model(&certificate.files, certificate.states, model, files)?;
    let refused = |error: PropertyError| Rejection::Property { error: error.to_string() };
    let objective = certificate.property.resolve(model.kind()).map_err(refused)?;
    let query = objective.query(model).map_err(refused)?;
    let task = Task::new(model, query.kind, query.resolution);
    let rows = ExactRows::new(model, &task.moving)?;
    let mut proof = Proof::new(&task, &rows);
    let steps = proof.check(&certificate.evidence)?;
    let Certificate { lower, upper, .. } = *certificate;
    let verdict = proof.check_claims(lower, upper, query.complement, objective.threshold.as_ref())?;
    Ok(Proved { lower, upper, verdict, states: certificate.states, steps, rows: proof.evaluated() })
}

/// What evidence proves about an event: bounds on its probability, by state.
#[derive(Clone, Debug)]
pub struct ProvedBounds {
    /// The lower bounds.
    pub lower: Vec<f64>,
    /// The upper bounds.
    pub upper: Vec<f64>,
    /// The number of steps that were checked; one for inductive bounds.
    pub steps: u64,
    /// The number of expectations of rows that were computed.
    pub rows: u64,
}

/// Checks what is said to prove bounds on the probability of an event.
///
/// # Errors
/// [`Rejection`] says what does not follow, in which step and state.
pub fn prove(
    model: &IntervalMdp,
    event: QueryKind,
    resolution: Resolution,
    evidence: &Evidence,
) -> Result<ProvedBounds, Rejection> {
    let task = Task::new(model, event, resolution);
    let rows = ExactRows::new(model, &task.moving)?;
    let mut proof = Proof::new(&task, &rows);
    let steps = proof.check(evidence)?;
    let (rows, Proof { lower, upper, .. }) = (proof.evaluated(), proof);
    Ok(ProvedBounds { lower: lower.values.into_doubles(), upper: upper.values.into_doubles(), steps, rows })
}

/// Checks that a model is the one of a certificate.
///
/// # Errors
/// [`Rejection`] names the file, or the number of states.
pub fn check_model(
    expected: &[FileDigest],
    states: u64,
    model: &IntervalMdp,
    files: &[FileDigest],
) -> Result<(), Rejection> {
    check_files(expected, files)?;
    match model.num_states() as u64 {
        found if found == states => Ok(()),
        found => Err(Rejection::States { found, expected: states }),
    }
}

fn check_files(expected: &[FileDigest], found: &[FileDigest]) -> Result<(), Rejection> {
    // There may be several of a kind, such as files of rewards.
    let digest = |files: &[FileDigest], kind: &str| {
        let all: Vec<&str> =
            files.iter().filter(|file| file.kind == kind).map(|file| &file.sha256[..]).collect();
        if all.is_empty() { "missing".to_owned() } else { all.join(", ") }
    };
    for FileDigest { kind, .. } in expected.iter().chain(found) {
        let (expected, found) = (digest(expected, kind), digest(found, kind));
        if expected != found {
            return Err(Rejection::Model { kind: kind.clone(), found, expected });
        }
    }
    Ok(())
}

struct Proof<'a> {
    task: &'a Task,
    rows: &'a ExactRows<'a>,
    lower: SideProof<'a>,
    upper: SideProof<'a>,
    /// The policy's present choices.
    choices: Vec<u32>,
}

impl<'a> Proof<'a> {
    fn new(task: &'a Task, rows: &'a ExactRows<'a>) -> Self {
        let start = |side| SideProof::new(side, rows, task);
        let choices = vec![NO_CHOICE; rows.model.num_states()];
        Self { task, rows, lower: start(Side::Lower), upper: start(Side::Upper), choices }
    }

    /// How many expectations of rows were computed.
    fn evaluated(&self) -> u64 {
        self.lower.evaluated + self.upper.evaluated
    }

    /// Checks evidence; returns how many steps were checked.
    fn check(&mut self, evidence: &Evidence) -> Result<u64, Rejection> {
        match (evidence, self.task.steps) {
            (Evidence::Steps(steps), Some(horizon)) => self.bounded(steps, horizon),
            (Evidence::Inductive(inductive), None) => self.unbounded(inductive),
            (Evidence::RewardSteps(_) | Evidence::RewardInductive(_), _) => {
                Err(Rejection::Evidence { property: "a probability", evidence: "rewards" })
            }
            (Evidence::Steps(_), None) => {
                Err(Rejection::Evidence { property: "unbounded", evidence: "bounded" })
            }
            (Evidence::Inductive(_), Some(_)) => {
                Err(Rejection::Evidence { property: "bounded", evidence: "unbounded" })
            }
        }
    }

    /// Checks steps one by one; returns how many were checked.
    fn bounded(&mut self, steps: &[Step], horizon: u64) -> Result<u64, Rejection> {
        let found = steps.len() as u64;
        if found > horizon {
            return Err(Rejection::Steps { found, expected: horizon });
        }
        for (k, step) in (1..).zip(steps) {
            self.assign(&step.choices, "choices", Some(k), |proof, s, choice| proof.choices[s] = *choice)?;
            let (mut lower, mut upper) = (self.lower.values.clone(), self.upper.values.clone());
            self.assign(&step.lower, "lower bounds", Some(k), |_, s, value| lower.set(s, *value))?;
            self.assign(&step.upper, "upper bounds", Some(k), |_, s, value| upper.set(s, *value))?;
            self.assign(&step.exact_lower, "exact lower bounds", Some(k), |_, s, value| {
                lower.set_exact(s, value.clone());
            })?;
            self.assign(&step.exact_upper, "exact upper bounds", Some(k), |_, s, value| {
                upper.set_exact(s, value.clone());
            })?;
            self.lower.step(lower, &self.choices, Some(k))?;
            self.upper.step(upper, &self.choices, Some(k))?;
        }
        if found == horizon {
            return Ok(found);
        }
        // From here on nothing changes: every further step is this one.
        self.stay(Some(found + 1))?;
        Ok(found + 1)
    }

    fn unbounded(&mut self, inductive: &Inductive) -> Result<u64, Rejection> {
        let mut lower = Bounds::new(Side::Lower, self.task.indicator());
        let mut upper = Bounds::new(Side::Upper, self.task.indicator());
        self.task.moving.ones().for_each(|s| upper.set(s, 1.0));
        let mut ranks = vec![0; self.choices.len()];
        let Inductive { exact_lower, exact_upper, .. } = inductive;
        self.assign(&inductive.choices, "choices", None, |proof, s, choice| proof.choices[s] = *choice)?;
        self.assign(&inductive.lower, "lower bounds", None, |_, s, value| lower.set(s, *value))?;
        self.assign(&inductive.upper, "upper bounds", None, |_, s, value| upper.set(s, *value))?;
        self.assign(exact_lower, "exact lower bounds", None, |_, s, value| {
            lower.set_exact(s, value.clone())
        })?;
        self.assign(exact_upper, "exact upper bounds", None, |_, s, value| {
            upper.set_exact(s, value.clone())
        })?;
        self.assign(&inductive.ranks, "ranks", None, |_, s, rank| ranks[s] = *rank)?;
        self.lower.values = lower;
        self.upper.values = upper;
        self.stay(None)?;
        check_ranks(self.rows, self.task, &self.lower.values, &self.choices, &ranks)?;
        Ok(1)
    }

    /// Checks that the bounds follow from themselves.
    fn stay(&mut self, step: Option<u64>) -> Result<(), Rejection> {
        for side in [&mut self.lower, &mut self.upper] {
            side.step(side.values.clone(), &self.choices, step)?;
        }
        Ok(())
    }

    /// Enters a list into a table by state; only moving states may be listed, in order.
    fn assign<T>(
        &mut self,
        list: &[(StateId, T)],
        what: &'static str,
        step: Option<u64>,
        mut enter: impl FnMut(&mut Self, usize, &T),
    ) -> Result<(), Rejection> {
        let rejected = |state, expected| Err(Rejection::State { step, state, what, expected });
        let mut previous = None;
        for (state, item) in list {
            let state = *state;
            if previous.replace(state).is_some_and(|previous| previous >= state) {
                return rejected(state, "states in ascending order");
            }
            if !self.task.moving.contains(state.index()) {
                return rejected(state, "states that have something to choose");
            }
            enter(self, state.index(), item);
        }
        Ok(())
    }

    /// Checks the claims about the initial states; for thresholds, returns what follows.
    fn check_claims(
        &self,
        lower: f64,
        upper: f64,
        complement: bool,
        threshold: Option<&Threshold>,
    ) -> Result<Option<Verdict>, Rejection> {
        let mut verdicts = vec![];
        for s in self.rows.model.initial().ones() {
            let (lower_bounds, upper_bounds) = (&self.lower.values, &self.upper.values);
            let (mut low, mut high) = (lower_bounds.double(s), upper_bounds.double(s));
            let mut exact = (lower_bounds.rational(s), upper_bounds.rational(s));
            if complement {
                (low, high) = (one_minus_down(high), one_minus_up(low));
                exact = (Rational::one() - exact.1, Rational::one() - exact.0);
            }
            let state = StateId::from_index(s);
            if !Side::Lower.follows(lower, low) {
                return Err(Rejection::Claim { side: Side::Lower, claimed: lower, proved: low, state });
            }
            if !Side::Upper.follows(upper, high) {
                return Err(Rejection::Claim { side: Side::Upper, claimed: upper, proved: high, state });
            }
            verdicts.extend(threshold.map(|threshold| threshold.decide_exactly(&exact.0, &exact.1)));
        }
        Ok(threshold.map(|_| Verdict::in_all(verdicts)))
    }
}
