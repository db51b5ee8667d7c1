//! Reading PRISM's explicit files.

mod assemble;
mod chunks;
mod import;
mod labels;
mod parse_chunk;
mod states;
mod transitions;

pub use import::{import, import_with_progress};
