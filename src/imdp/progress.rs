//! How long work tells how far it is, and hears that it should end.

use std::sync::atomic::{AtomicBool, Ordering};

/// Receives the progress of a long computation; every method may be called from several threads.
pub trait Progress: Sync {
    /// A phase begins, with `total` units of work.
    fn start(&self, phase: &str, total: u64);
    /// So many more units are done.
    fn advance(&self, units: u64);
    /// A computation has done so many iterations, of so many if that is known, and its bounds are so far apart (or still
    /// change by so much).
    fn iterate(&self, iterations: u64, of: Option<u64>, distance: f64) {
        let _ = (iterations, of, distance);
    }
    /// The phase is over.
    fn finish(&self);
    /// Whether the user wants the work to end early.
    fn is_interrupted(&self) -> bool {
        false
    }
}

/// Nobody is watching, but the work ends early when the flag is set.
impl Progress for AtomicBool {
    fn start(&self, _: &str, _: u64) {}
    fn advance(&self, _: u64) {}
    fn finish(&self) {}
    fn is_interrupted(&self) -> bool {
        self.load(Ordering::Relaxed)
    }
}

/// Nobody is watching.
impl Progress for () {
    fn start(&self, _: &str, _: u64) {}
    fn advance(&self, _: u64) {}
    fn finish(&self) {}
}
