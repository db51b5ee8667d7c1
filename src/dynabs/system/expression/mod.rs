//! Expressions such as `x1 + 0.1*x2*cos(x3)`: read, differentiated, evaluated on doubles and on intervals.

mod affine;
mod derivative;
mod error;
mod functions;
mod graph;
mod lexer;
mod number;
mod operations;
mod parser;
mod scope;
mod tape;
#[cfg(test)]
mod tests;

pub use affine::AffineForm;
pub use error::ExpressionError;
pub use graph::{Function, Graph, Node, NodeId};
pub use scope::{NameError, Scope};
pub use tape::Tape;

/// The most nodes that the expressions of one system may have.
const MAX_NODES: usize = 50_000;

/// Reads an expression; `name` is what [`Graph::place`] will call this text.
///
/// # Errors
/// [`ExpressionError`] with the column of the first mistake.
pub fn parse(graph: &mut Graph, scope: &Scope, text: &str, name: &str) -> Result<NodeId, ExpressionError> {
    let number = graph.begin_text(name);
    let root = parser::parse(graph, scope, text, number)?;
    if graph.len() > MAX_NODES {
        let found = format!("expressions of {} operations in all", graph.len());
        return Err(ExpressionError::new(1, found, format!("at most {MAX_NODES}")));
    }
    Ok(root)
}
