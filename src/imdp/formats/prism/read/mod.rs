//! Reading PRISM's explicit files.

mod assemble;
mod chunks;
mod combined;
mod files;
mod import;
mod labels;
mod loose;
mod parse_chunk;
mod rewards;
mod states;
mod transitions;

pub use combined::import_combined;
pub use files::ExplicitFiles;
pub use import::{import, import_files, import_with_progress};
