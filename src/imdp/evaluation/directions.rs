//! Who maximises and who minimises, where a property says it of one player only.

use crate::model::{IntervalMdp, ModelKind, StateId};
use crate::property::{Nature, Optimum, Property, PropertyError, Question, Resolution};

/// The property with both directions, where the model or `nature` says what the second one is.
pub fn direct(mut property: Property, model: &IntervalMdp, nature: Option<Nature>) -> Property {
    if let Question::Value(optimum) | Question::Verdict(optimum, _) = &mut property.question
        && let Some(resolution) = other(*optimum, model, nature)
    {
        *optimum = match (model.kind(), resolution.policy_maximises()) {
            (ModelKind::Imdp, _) => Optimum::Both(resolution),
            (ModelKind::Idtmc, true) => Optimum::Max,
            (ModelKind::Idtmc, false) => Optimum::Min,
        };
    }
    property
}

/// Who maximises and who minimises.
pub(super) fn resolution(
    optimum: Optimum,
    model: &IntervalMdp,
    nature: Option<Nature>,
) -> Result<Resolution, PropertyError> {
    match other(optimum, model, nature) {
        Some(resolution) => Ok(resolution),
        None => optimum.resolve(model.kind()),
    }
}

/// What is meant by an optimum of one player or none, if that is clear.
fn other(optimum: Optimum, model: &IntervalMdp, nature: Option<Nature>) -> Option<Resolution> {
    let maximises = match optimum {
        Optimum::Both(_) => return None,
        Optimum::Only => {
            let has_choice = (0..model.num_states() as u32)
                .any(|state| model.choices().num_choices_of(StateId(state)) > 1);
            return (is_point(model) && !has_choice).then_some(Resolution::Pmaxmax);
        }
        Optimum::Max => true,
        Optimum::Min => false,
    };
    if model.kind() == ModelKind::Idtmc {
        return None;
    }
    // Where nature has nothing to choose, both readings are the same.
    let nature = nature.or(is_point(model).then_some(Nature::Cooperative))?;
    Some(match (maximises, nature) {
        (true, Nature::Robust) => Resolution::Pmaxmin,
        (true, Nature::Cooperative) => Resolution::Pmaxmax,
        (false, Nature::Robust) => Resolution::Pminmax,
        (false, Nature::Cooperative) => Resolution::Pminmin,
    })
}

/// Whether all intervals are points.
fn is_point(model: &IntervalMdp) -> bool {
    model.rows().iter().all(|row| row.lower == row.upper)
}
