//! Writing PRISM's explicit files.

mod labels;
mod states;
mod transitions;

pub use labels::write_lab;
pub use states::write_sta;
pub use transitions::{MAX_COUNT, RAISED_LOWER_BOUND, TraWriter};
