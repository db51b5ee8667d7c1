//! Numbers of targets, which cannot be taken for those of rows, states or cells.

/// A point that actions steer to, numbered from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TargetId(pub u32);

impl TargetId {
    /// The target with this place in a table; there are at most 2³² − 1 of them.
    pub const fn from_index(index: usize) -> Self {
        Self(index as u32)
    }

    /// The place in a table that has one entry for each target.
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}
