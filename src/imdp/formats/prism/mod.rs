//! PRISM's explicit files: transitions (`.tra`), states (`.sta`), labels (`.lab`) and rewards (`.srew`, `.trew`).
//!
//! Reading is strict: what PRISM lets pass silently (intervals that admit no distribution, probabilities
//! above 1, duplicate destinations, wrong counts) is refused with file, line and column. Equal rows are
//! shared while reading, so memory follows the distinct rows and not the transitions. Writing streams every
//! transition from the shared rows.

mod read;
mod write;

pub use read::{ExplicitFiles, import, import_combined, import_files, import_with_progress};
pub use write::{MAX_COUNT, RAISED_LOWER_BOUND, RewardFile, TraWriter, check_names, write_lab, write_sta};
