//! Writing PRISM's explicit files.

mod labels;
mod names;
mod rewards;
mod states;
mod transitions;

pub use labels::write_lab;
pub use names::check_names;
pub use rewards::RewardFile;
pub use states::write_sta;
pub use transitions::{MAX_COUNT, RAISED_LOWER_BOUND, TraWriter};
