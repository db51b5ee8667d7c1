//! Files of others and of ours: what may be read, and how output appears, whole or not at all.
//!
//! *Reading.* Only regular files are inputs, and no more of them than their size says: a FIFO would be waited for,
//! a device never ends.
//!
//! *Writing.* What a command writes is staged in a directory `.dynabs-….part` beside the place where it belongs, put
//! on the disk, and renamed into place. Where several files belong together, renaming the directory to
//! `.dynabs-….files` is the moment from which on all of them count; they are moved from there to their places, and
//! whoever comes next finishes what a killed process did not ([`settle`]). A staging directory is locked while its
//! process lives. What is not locked was left behind, and the next command that writes there removes it.
//!
//! A symbolic link is followed; devices, pipes and links of the kernel to open files (`/dev/stdout`) are written
//! through as they are.

mod directory;
mod input;
mod interruption;
mod left_over;
mod outputs;
mod place;
mod staged;
mod steady;

pub use directory::sync_directory;
pub use input::{is_fault_of_input, open, read, read_text};
pub use interruption::{interruption, is_interruption};
pub use left_over::{claim, clear, settle};
pub use outputs::Outputs;
pub use place::resolve;
pub use staged::{StagedDirectory, abandon_all, rename_new};
pub use steady::steady;
