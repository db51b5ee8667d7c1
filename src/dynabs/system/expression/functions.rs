//! The names that have a meaning of their own.

use super::graph::Function;

/// The functions of one argument.
pub(super) const FUNCTIONS: [(&str, Function); 13] = [
    ("sin", Function::Sin),
    ("cos", Function::Cos),
    ("tan", Function::Tan),
    ("atan", Function::Atan),
    ("asin", Function::Asin),
    ("acos", Function::Acos),
    ("sinh", Function::Sinh),
    ("cosh", Function::Cosh),
    ("tanh", Function::Tanh),
    ("exp", Function::Exp),
    ("ln", Function::Ln),
    ("sqrt", Function::Sqrt),
    ("abs", Function::Abs),
];
/// The functions of several arguments, with their number.
pub(super) const CHOOSERS: [(&str, usize); 3] = [("min", 2), ("max", 2), ("clip", 3)];

/// Whether a name has a meaning of its own, so that nothing else can have it.
pub(super) fn is_reserved(name: &str) -> bool {
    name == "pi"
        || FUNCTIONS.iter().any(|(own, _)| *own == name)
        || CHOOSERS.iter().any(|(own, _)| *own == name)
}
