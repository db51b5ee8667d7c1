//! Work that several processes share, on one machine or on many.
//!
//! All processes of a crew do the same with the same input and get the same. Only the longest loops are divided: each process
//! does its own [`Share`] and gets those of the others, so that every one of them has the whole again. What a process
//! computes does not hang on how many there are, so neither does any result.
//!
//! How they talk to each other is not known here: see [`Ranks`]. As threads are those of the ambient pool, a crew is that of
//! the thread that [joined](join) it. Loops that run within other threads are not divided.

mod input;
mod notice;
mod share;

pub use input::require_same;
pub use notice::Notice;
pub use share::{Exchanged, Share};
use std::cell::RefCell;
use std::fmt;
use std::rc::Rc;

/// How the processes of a crew talk to each other; all of them call the same methods in the same order.
///
/// What cannot be sent ends all processes.
pub trait Ranks: fmt::Debug {
    /// The number of this process, from 0.
    fn rank(&self) -> usize;

    /// The number of processes.
    fn size(&self) -> usize;

    /// The notices of all processes, by rank.
    fn notices(&self, own: Notice) -> Vec<Notice>;

    /// Fills `array[ends[r - 1]..ends[r]]` with what process `r` has there, for every `r`.
    fn complete_doubles(&self, array: &mut [f64], ends: &[usize]);

    /// The same for whole numbers.
    fn complete_integers(&self, array: &mut [u32], ends: &[usize]);

    /// Ends all processes, because their notices show that they no longer do the same.
    fn disband(&self, notices: &[Notice]) -> !;
}

thread_local! {
    static CREW: RefCell<Option<Rc<dyn Ranks>>> = const { RefCell::new(None) };
}

/// This thread shares its work with these processes until they are [dismissed](dismiss); a crew of one is none.
pub fn join(ranks: Rc<dyn Ranks>) {
    CREW.set(Some(ranks).filter(|ranks| ranks.size() > 1));
}

/// From now on this thread works alone, without waiting for anybody.
pub fn leave() {
    CREW.set(None);
}

/// The number of processes that share the work of this thread.
pub fn size() -> usize {
    crew().map_or(1, |ranks| ranks.size())
}

/// Waits until all processes are here; from now on each works alone. Returns whether this one is the first, which writes the files.
pub fn dismiss() -> bool {
    let Some(ranks) = CREW.take() else { return true };
    agree(&*ranks, Notice::Dismissed);
    ranks.rank() == 0
}

/// The greatest of what all processes say, where each may have seen something else: the time, an interrupt.
pub(crate) fn greatest(own: u8) -> u8 {
    let Some(ranks) = crew() else { return own };
    let notices = ranks.notices(Notice::Limit { reason: own });
    let reason = |notice: &Notice| match notice {
        Notice::Limit { reason } => Some(*reason),
        _ => None,
    };
    match notices.iter().map(reason).collect::<Option<Vec<u8>>>() {
        Some(reasons) => reasons.into_iter().max().unwrap_or(own),
        None => ranks.disband(&notices),
    }
}

fn crew() -> Option<Rc<dyn Ranks>> {
    CREW.with_borrow(Option::clone)
}

/// Makes sure that all processes are about to do the same.
fn agree(ranks: &dyn Ranks, own: Notice) {
    let notices = ranks.notices(own);
    if notices.iter().any(|&notice| notice != own) {
        ranks.disband(&notices);
    }
}
