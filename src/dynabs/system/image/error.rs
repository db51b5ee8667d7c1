//! Why an image cannot be computed.

use crate::system::Interval;
use crate::system::expression::{Function, Node};

/// The dynamics are not defined for every state of a cell.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "{}the next {state} is undefined for some states of the cell {cell}: found {found}; expected {expected}",
    where_it_is(place.as_ref())
)]
pub struct ImageError {
    /// The name of the state whose next value it is.
    pub state: String,
    /// The name of the text that the operation is written in, and its column from 1, where that is known.
    pub place: Option<(String, u32)>,
    /// The cell, as a product of intervals.
    pub cell: String,
    /// What was found.
    pub found: String,
    /// What is expected.
    pub expected: &'static str,
}

impl ImageError {
    /// What the user can do.
    pub const REMEDY: &'static str =
        "Keep the operand in its domain with max, min or clip, or leave such states out of the partition.";
}

fn where_it_is(place: Option<&(String, u32)>) -> String {
    place.map_or(String::new(), |(text, column)| format!("{text} (column {column}): "))
}

/// What is wrong with an operation whose last operand may be anything in `operand`.
pub(super) fn explained(node: &Node, operand: Interval) -> (String, &'static str) {
    let range = format!("[{}, {}]", operand.lower(), operand.upper());
    match node {
        Node::Divide(..) => (format!("a division by {range}"), "a divisor that is never 0"),
        Node::Power(_, n) if *n < 0 => (format!("a negative power of {range}"), "a base that is never 0"),
        Node::PowerReal(..) => (
            format!("a power with exponent in {range}"),
            "a positive base, or an exponent that is an integer",
        ),
        Node::Call(Function::Ln, _) => (format!("ln of {range}"), "a positive argument"),
        Node::Call(Function::Sqrt, _) => (format!("sqrt of {range}"), "an argument that is never negative"),
        Node::Call(Function::Asin | Function::Acos, _) => {
            (format!("asin or acos of {range}"), "an argument in [-1, 1]")
        }
        Node::Call(Function::Tan, _) => {
            (format!("tan of {range}"), "an argument between two poles of the tangent")
        }
        _ => (format!("a value without bound, computed from {range}"), "values in the range of doubles"),
    }
}
