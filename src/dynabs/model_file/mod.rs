//! The model file: a [`Problem`](crate::problem::Problem) or an [`InputProblem`](crate::problem::InputProblem) as JSON, every error with the place it is about.

mod document;
mod dynamics;
mod fields;
mod input_parts;
mod named;
mod parts;
mod schema;
mod task_fields;
mod task_parts;

pub use document::{Document, SetArgument};
pub use parts::StatedProblem;
pub use schema::{json_schema, starter_model};
