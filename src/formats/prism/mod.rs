//! PRISM's explicit format: `.tra`, `.sta`, `.lab`.

mod write_lab;
mod write_sta;
mod write_tra;

pub use write_lab::write_lab;
pub use write_sta::write_sta;
pub use write_tra::{MAX_COUNT, RAISED_LOWER_BOUND, TraWriter};
