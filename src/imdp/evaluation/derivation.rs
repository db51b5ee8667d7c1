//! Expressions evaluated again with what is proved in place of what is computed.

use super::EvaluationError;
use super::checker::Checker;
use super::expression::Evaluator;
use crate::certificate::{Claim, Derivation, FileDigest};
use crate::model::IntervalMdp;
use crate::property::{Definitions, Inquiry, Verdict, parse_inquiry};
use crate::solver::SolverOptions;
use crate::verify::{Proved, Rejection, Side, check_model};

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
        return Err(problem(
            "found a property, which has certificates of its own; expected an expression".to_owned(),
        ));
    };
    let mut evaluator = Evaluator::new(model, derivation.nature, SolverOptions::default());
    evaluator.checker = Some(Checker::new(&derivation.proofs));
    let values = evaluator.values(&compound.root).map_err(|error| match error {
        EvaluationError::Proof(rejection) => rejection,
        other => problem(other.to_string()),
    })?;
    if evaluator.is_unproved {
        return Err(problem(
            "found an automaton of a file, which may be another by now; expected only what has a proof"
                .to_owned(),
        ));
    }
    let (steps, rows, left) = match &evaluator.checker {
        Some(checker) => (checker.steps, checker.rows, checker.num_left()),
        None => (0, 0, 0),
    };
    if left > 0 {
        return Err(problem(format!("found {left} proofs more than operators; expected one for each")));
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
