//! Why reading stops in a line.

use crate::formats::import::{Fault, ImportError};
use crate::model::MemoryError;

/// What ends the reading of a line.
pub(super) enum Stopped {
    Fault(Box<Fault>),
    Import(ImportError),
}

impl From<MemoryError> for Stopped {
    fn from(error: MemoryError) -> Self {
        Self::Import(error.into())
    }
}

impl From<Box<Fault>> for Stopped {
    fn from(fault: Box<Fault>) -> Self {
        Self::Fault(fault)
    }
}
