//! Reading PRISM's explicit files.

mod assemble;
mod bounds;
mod chunks;
mod decimal;
mod error;
mod exact_sum;
mod import;
mod labels;
mod lines;
mod parse_chunk;
mod pending_row;
mod row_table;
mod states;
mod text;
mod transitions;

pub use error::{ImportError, Position, Warning};
pub use import::{Imported, import, import_with_progress};
