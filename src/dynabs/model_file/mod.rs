//! The model file: a [`Problem`](crate::problem::Problem) or an [`InputProblem`](crate::problem::InputProblem) as JSON, every error with the place it is about.

mod by_example;
mod continuous_time;
mod document;
mod dynamics;
mod fields;
mod given;
mod input_parts;
mod integer_or;
mod named;
mod parts;
mod schema;
mod set_fields;
mod stabilizer_fields;
mod stabilizer_parts;
mod stated;
mod task_fields;
mod task_parts;

pub use continuous_time::LooksContinuous;
pub use document::{Document, SetArgument};
pub use schema::{json_schema, starter_model};
pub use stated::StatedProblem;
