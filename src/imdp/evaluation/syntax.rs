//! What the nodes of path formulas say.

use crate::numeric::to_f64;
use crate::property::{Constant, Node, NodeKind, StepBound, StepBounds, constant};

/// Whether a formula speaks of more than the present state.
pub(super) fn is_path(node: &Node) -> bool {
    match &node.kind {
        NodeKind::Temporal(..) | NodeKind::Until(..) | NodeKind::Automaton(_) => true,
        NodeKind::Operator(_) | NodeKind::Filter(_) => false,
        kind => kind.children().into_iter().any(is_path),
    }
}

/// The first and the last step, if there is one, at which something may happen.
pub(super) fn range(bounds: &StepBounds) -> (u64, Option<u64>) {
    let first = bounds.lower.as_ref().map_or(0, |bound| {
        let plain = StepBound { is_strict: false, ..(**bound).clone() };
        steps(&plain) + u64::from(bound.is_strict)
    });
    (first, bounds.upper.as_ref().map(|bound| steps(bound)))
}

/// The number of steps in `<=k` or `<k`, checked when it was read.
pub(super) fn steps(bound: &StepBound) -> u64 {
    (number(&bound.steps) as u64).saturating_sub(u64::from(bound.is_strict))
}

/// A number that was checked when it was read.
pub(super) fn number(node: &Node) -> f64 {
    constant(node).and_then(Constant::number).map_or(0.0, |value| to_f64(&value))
}
