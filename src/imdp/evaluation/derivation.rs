//! Expressions evaluated again with what is proved in place of what is computed.

use super::EvaluationError;
use super::expression::Evaluator;
use super::product::Product;
use crate::certificate::{Claim, Derivation, Evidence, FileDigest};
use crate::model::{IntervalMdp, RewardStructure, StateSet};
use crate::numeric::Rational;
use crate::property::{Definitions, Inquiry, QueryKind, Resolution, Verdict, parse_inquiry};
use crate::solver::{Acceptance, Event, SolverOptions, ValueBounds};
use crate::verify::{
    OmegaCondition, Proved, ProvedBounds, Rejection, RewardTask, Side, check_model, prove, prove_accepting,
    prove_nothing_missed, prove_rewards,
};
use num_traits::One;

/// Checks the certificate of an expression against a model and the digests of the files it was read from.
///
/// What operators come to is proved by [`crate::verify`], in exact arithmetic and whatever the certificate says, and so is
/// where the runs of a product with an automaton satisfy a path formula; what an expression makes of its operators
/// (comparisons, filters) and the automata of path formulas are those of any evaluation.
///
/// # Errors
/// [`Rejection`] says what does not follow.
pub fn check_derivation(
    derivation: &Derivation,
    model: &IntervalMdp,
    files: &[FileDigest],
) -> Result<Proved, Rejection> {
    check_model(&derivation.files, derivation.states, model, files)?;
    let problem = |problem: String| Rejection::Expression { problem };
    let inquiry = parse_inquiry(&derivation.expression, &Definitions::default());
    let Inquiry::Compound(compound) = inquiry.map_err(|error| problem(error.to_string()))? else {
        return Err(problem("the expression is a property, which has certificates of its own".to_owned()));
    };
    let mut evaluator = Evaluator::new(model, derivation.nature, SolverOptions::default());
    evaluator.checker = Some(Checker { proofs: derivation.proofs.iter(), steps: 0, rows: 0 });
    let values = evaluator.values(&compound.root).map_err(|error| match error {
        EvaluationError::Proof(rejection) => rejection,
        other => problem(other.to_string()),
    })?;
    if evaluator.is_unproved {
        return Err(problem(
            "an automaton of a file has no proof: the file may be another by now".to_owned(),
        ));
    }
    let (steps, rows, left) = match &evaluator.checker {
        Some(checker) => (checker.steps, checker.rows, checker.proofs.len()),
        None => (0, 0, 0),
    };
    if left > 0 {
        return Err(problem(format!("{left} proofs are left over")));
    }
    let proved = values.claim(model);
    let (lower, upper, verdict) = claimed(derivation.claim, proved, model)?;
    Ok(Proved { lower, upper, verdict, states: derivation.states, steps, rows })
}

/// The claim, if it follows from what was proved.
fn claimed(
    claim: Claim,
    proved: Claim,
    model: &IntervalMdp,
) -> Result<(f64, f64, Option<Verdict>), Rejection> {
    let state = crate::model::StateId::from_index(model.initial().ones().next().unwrap_or(0));
    match (claim, proved) {
        (Claim::Between(lower, upper), Claim::Between(low, high)) => {
            if lower > low {
                return Err(Rejection::Claim { side: Side::Lower, claimed: lower, proved: low, state });
            }
            if upper < high {
                return Err(Rejection::Claim { side: Side::Upper, claimed: upper, proved: high, state });
            }
            Ok((lower, upper, None))
        }
        (Claim::Verdict(claimed), Claim::Verdict(proved)) if claimed == proved => {
            Ok((0.0, 1.0, Some(claimed)))
        }
        _ => Err(Rejection::Verdict { claimed: words(claim), proved: words(proved) }),
    }
}

fn words(claim: Claim) -> String {
    match claim {
        Claim::Between(lower, upper) => format!("is a number in [{lower}, {upper}]"),
        Claim::Verdict(Verdict::Holds) => "holds".to_owned(),
        Claim::Verdict(Verdict::Fails) => "fails".to_owned(),
        Claim::Verdict(Verdict::Unknown) => "is undecided".to_owned(),
    }
}

fn condition(acceptance: &Acceptance) -> OmegaCondition<'_> {
    OmegaCondition { finitely: &acceptance.finitely, infinitely: &acceptance.infinitely }
}

/// The proofs that are left, and how much was checked.
pub(super) struct Checker<'a> {
    proofs: std::slice::Iter<'a, Evidence>,
    steps: u64,
    rows: u64,
}

impl<'a> Checker<'a> {
    /// What the next proof proves about the probability of an event.
    pub(super) fn event(
        &mut self,
        model: &IntervalMdp,
        event: &Event<'_>,
        first: u64,
        resolution: Resolution,
    ) -> Result<ValueBounds, EvaluationError> {
        if first > 0 {
            let problem = "there are no proofs about events that begin after some steps".to_owned();
            return Err(Rejection::Expression { problem }.into());
        }
        let kind = match *event {
            Event::Until { safe, goal, steps } => {
                QueryKind::Until { safe: safe.clone(), goal: goal.clone(), steps }
            }
            Event::Next { goal } => QueryKind::Next { goal: goal.clone() },
        };
        let evidence = self.next()?;
        Ok(self.note(prove(model, kind, resolution, evidence)?))
    }

    /// What the next proof proves about an expected reward.
    pub(super) fn rewards(
        &mut self,
        model: &IntervalMdp,
        rewards: &RewardStructure,
        task: &RewardTask<'_>,
        resolution: Resolution,
    ) -> Result<ValueBounds, EvaluationError> {
        if matches!(task, RewardTask::Cumulative { steps: None, discount } if *discount >= Rational::one()) {
            return Err(crate::solver::SolveError::Undiscounted.into());
        }
        let evidence = self.next()?;
        Ok(self.note(prove_rewards(model, rewards, task, resolution, evidence)?))
    }

    /// Checks where runs of a product satisfy the path formula: for certain, and perhaps.
    pub(super) fn goals(
        &self,
        product: &Product,
        [lower, upper]: [&StateSet; 2],
        resolution: Resolution,
    ) -> Result<(), Rejection> {
        let conditions: Vec<_> = product.conditions.iter().map(condition).collect();
        let (model, satisfied) = (&product.model, &product.satisfied);
        prove_accepting(model, &conditions, (lower, satisfied), resolution.nature_maximises())?;
        prove_nothing_missed(model, &conditions, (upper, satisfied))
    }

    fn next(&mut self) -> Result<&'a Evidence, Rejection> {
        let missing = || Rejection::Expression { problem: "a proof is missing".to_owned() };
        self.proofs.next().ok_or_else(missing)
    }

    fn note(&mut self, proved: ProvedBounds) -> ValueBounds {
        self.steps += proved.steps;
        self.rows += proved.rows;
        ValueBounds { lower: proved.lower, upper: proved.upper }
    }
}
