//! Reading UMB: arrays are streamed side by side, so memory follows the distinct rows.

mod actions;
mod archive;
mod array;
mod import;
mod index;
mod rewards;
mod sets;
mod transitions;
mod valuations;

pub use import::{import, import_with_progress};
