//! How inputs share what is to be done where there are more of them than it takes: so that most is expected to be reached.
//!
//! Rehearsals ([`FeedbackLaw::shares`]) ask whether cells can be kept, which says little about ways that lead against the drift.
//! Where there is time for it, shares are compared by what they let expect: the probability of success with nominal noise
//! ([`super::nominal`]), on average over the cells. Samples have no part in it; neither have the initial state and the horizon, which
//! may be chosen when samples are known.

use super::AbstractionError;
use super::enabled::EnabledActions;
use super::nominal::Nominal;
use super::steering::{Steering, demands};
use crate::partition::{CellId, CellKind};
use crate::problem::{Problem, Stabilizer};
use crate::system::{FeedbackLaw, Shares};

/// So many steps are looked at.
const STEPS: u64 = 100;

/// How many numbers may be looked at, in all comparisons,
const MOST_WORK: u64 = 400_000_000;

/// of which there must be so many at least to begin with them.
const LEAST_COMPARISONS: u64 = 50;

/// Where so much is expected by now, nothing better is looked for.
const ENOUGH: f64 = 0.95;

/// The law of a problem, and the conditions under which it is applied.
pub(super) fn steering(problem: &Problem) -> Result<Steering, AbstractionError> {
    let (system, input) = (problem.system(), problem.input());
    let layers = problem.stabilizer().and_then(Stabilizer::feedback).map(|feedback| &feedback.layers);
    let law = |shares: Option<&Shares>| FeedbackLaw::with_shares(system, input, layers, shares);
    let shares = FeedbackLaw::shares(system, input, layers, &demands(problem));
    let shares = shares.map(|shares| better(problem, shares, |shares| law(Some(shares))));
    Ok(Steering::new(problem, law(shares.as_ref()).ok_or(AbstractionError::NotSteerable)?))
}

/// Shares with which more is expected to be reached, beginning with `shares`.
fn better(problem: &Problem, shares: Shares, law: impl Fn(&Shares) -> Option<FeedbackLaw>) -> Shares {
    let ordinary = problem.labels().iter().filter(|(_, kind)| *kind == CellKind::Ordinary);
    let cells: Vec<CellId> = ordinary.map(|(cell, _)| cell).collect();
    let Some(targets) = law(&shares).map(|law| Steering::new(problem, law).targets) else { return shares };
    let nominal = Nominal::new(problem, &targets, 1.0, STEPS);
    if nominal.work(&EnabledActions::default()).saturating_mul(LEAST_COMPARISONS) > MOST_WORK {
        return shares;
    }
    let mut left = MOST_WORK;
    shares.improved(|shares| {
        let Some(law) = law(shares) else { return Some(f64::NEG_INFINITY) };
        let actions = Steering::new(problem, law).enabled(problem, &cells, &());
        left = left.checked_sub(nominal.work(&actions))?;
        let values = nominal.values(&cells, &actions, &());
        let mean = cells.iter().map(|cell| values[cell.index()]).sum::<f64>() / cells.len().max(1) as f64;
        if mean >= ENOUGH {
            left = 0;
        }
        Some(mean)
    })
}
