//! Properties in PRISM's syntax: what is asked of an interval MDP.
//!
//! A text becomes a [`Property`], which says what was written; [`Property::resolve`] adds the kind of model
//! and gives an [`Objective`], which says who maximises and who minimises; [`Objective::query`] adds the
//! model and gives a [`Query`], which names sets of states and is all that a solver needs.
//!
//! | text | asks |
//! |---|---|
//! | `Pmaxmin=? [ F<=8 "goal" ]` | for the value; likewise `Pmaxmax`, `Pminmin`, `Pminmax` |
//! | `(Pmaxmin=? [ !"failed" U "goal" ])>=0.9` | whether the value is at least 0.9; likewise `>`, `<=`, `<` |
//! | `P>=0.9 [ G<=8 x>=-3 & !"failed" ]` | whether this holds for all policies and natures |
//! | `Pmin=? [ X "goal" ]` | for the value of an interval DTMC; likewise `Pmax` |
//!
//! State formulas are made of labels, the variables of the states, `true`, `false`, integers and
//! `! & | => <=> = != < <= > >= + - *`, with the precedence that they have in PRISM. A formula that PRISM
//! would accept and this crate does not is refused by the name of what is not supported.
//!
//! ```
//! use imdp::model::ModelKind;
//! use imdp::property::{Property, Resolution, Verdict};
//!
//! let property: Property = "(Pmaxmin=?[F<=8 \"goal\"])>=0.9".parse()?;
//! assert_eq!(property.to_string(), "(Pmaxmin=? [ F<=8 \"goal\" ])>=0.9");
//! let objective = property.resolve(ModelKind::Imdp)?;
//! assert_eq!(objective.resolution, Resolution::Pmaxmin);
//! assert_eq!(objective.threshold.map(|threshold| threshold.decide(0.95, 0.96)), Some(Verdict::Holds));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod closest_name;
mod columns;
mod compound;
mod constant;
mod definitions;
mod document;
mod error;
mod evaluate;
mod grammar;
mod integer_expression;
mod lexer;
mod objective;
mod operand;
mod parse_error;
mod parser;
mod path_formula;
mod print;
mod probability;
mod query;
mod question;
mod read;
mod resolution;
mod simple;
mod state_formula;
mod threshold;
mod tree;
mod typing;
mod unsupported;

pub use closest_name::closest_name;
pub use compound::Compound;
pub use definitions::Definitions;
pub use document::{Entry, Inquiry, parse_document};
pub use error::PropertyError;
pub use integer_expression::IntegerExpression;
pub use objective::Objective;
pub use parse_error::{ParseError, ParseErrorKind, TextPosition};
pub use path_formula::PathFormula;
pub use query::{Query, QueryKind};
pub use question::{Property, Question};
pub use read::{parse_inquiry, parse_properties, parse_property};
pub use resolution::{Nature, Optimum, Resolution};
pub use state_formula::{Relation, StateFormula};
pub use threshold::{Probability, ProbabilityError, Threshold, ThresholdComparison, Verdict};

pub(crate) use columns::numbers_states;
pub(crate) use constant::{Constant, arithmetic, call, constant};
pub(crate) use simple::{formula, is_formula};
pub(crate) use tree::{
    Asked, AutomatonPath, BinaryOperator, Filter, FilterOperator, Function, Measured, Node, NodeKind,
    Operator, RewardPath, StepBound, StepBounds, Structure, TemporalOperator, UntilOperator,
};

#[cfg(test)]
mod tests;
