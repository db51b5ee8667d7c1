//! PRISM's explicit files: transitions (`.tra`), states (`.sta`) and labels (`.lab`).
//!
//! Reading is strict: what PRISM lets pass silently (intervals that admit no distribution, probabilities
//! above 1, duplicate destinations, wrong counts) is refused with file, line and column. Equal rows are
//! shared while reading, so memory follows the distinct rows and not the transitions.

mod assemble;
mod bounds;
mod chunks;
mod decimal;
mod error;
mod exact_sum;
mod import;
mod lines;
mod parse_chunk;
mod pending_row;
mod read_lab;
mod read_sta;
mod read_tra;
mod row_table;
mod text;

pub use error::{ImportError, Position, Warning};
pub use import::{Imported, import, import_with_progress};
