//! Where runs stand.

/// The number of a memory, from 0.
pub type Memory = u32;

/// Where a run of the system stands with its task.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Standing {
    /// The task has failed.
    Failed,
    /// It is open, and this is the memory.
    Open(Memory),
    /// It is done.
    Reached,
}
