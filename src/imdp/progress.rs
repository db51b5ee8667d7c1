//! How long work tells how far it is.

/// Receives the progress of a long computation; every method may be called from several threads.
pub trait Progress: Sync {
    /// A phase begins, with `total` units of work.
    fn start(&self, phase: &str, total: u64);
    /// So many more units are done.
    fn advance(&self, units: u64);
    /// The phase is over.
    fn finish(&self);
    /// Whether the user wants the work to end early.
    fn is_interrupted(&self) -> bool {
        false
    }
}

/// Nobody is watching.
impl Progress for () {
    fn start(&self, _: &str, _: u64) {}
    fn advance(&self, _: u64) {}
    fn finish(&self) {}
}
