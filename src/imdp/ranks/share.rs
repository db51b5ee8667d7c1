//! Which part of a loop is that of this process.

use super::{Notice, Ranks, agree, crew};
use std::fmt;
use std::ops::Range;
use std::rc::Rc;

/// Loops with fewer steps than this, in numbers read or written, are not worth a message.
const WORTHWHILE: usize = 1 << 15;

/// The items of a loop, divided among the processes of the crew.
#[derive(Clone)]
pub struct Share {
    /// Nobody to share with, or nothing worth it.
    crew: Option<Rc<dyn Ranks>>,
    /// Where the items of each process end; those of the next begin there.
    ends: Vec<usize>,
    own: Range<usize>,
}

/// Numbers that processes exchange.
pub trait Exchanged: Copy + Default {
    /// [`Ranks::complete_doubles`] or [`Ranks::complete_integers`].
    fn complete(ranks: &dyn Ranks, array: &mut [Self], ends: &[usize]);
}

impl Exchanged for f64 {
    fn complete(ranks: &dyn Ranks, array: &mut [Self], ends: &[usize]) {
        ranks.complete_doubles(array, ends);
    }
}

impl Exchanged for u32 {
    fn complete(ranks: &dyn Ranks, array: &mut [Self], ends: &[usize]) {
        ranks.complete_integers(array, ends);
    }
}

impl Exchanged for u16 {
    fn complete(ranks: &dyn Ranks, array: &mut [Self], ends: &[usize]) {
        let mut wide: Vec<u32> = array.iter().copied().map(u32::from).collect();
        ranks.complete_integers(&mut wide, ends);
        array.iter_mut().zip(wide).for_each(|(short, wide)| *short = wide as Self);
    }
}

impl Share {
    /// Divides `items` evenly, if they take at least some `work` together: so many numbers read or written.
    pub fn new(items: usize, work: usize) -> Self {
        let crew = crew().filter(|_| work >= WORTHWHILE);
        let (rank, size) = crew.as_ref().map_or((0, 1), |ranks| (ranks.rank(), ranks.size()));
        let end = |rank: usize| (items as u128 * rank as u128 / size as u128) as usize;
        Self { crew, ends: (1..=size).map(end).collect(), own: end(rank)..end(rank + 1) }
    }

    /// The items of this process.
    pub fn own(&self) -> Range<usize> {
        self.own.clone()
    }

    /// Whether this process does everything.
    pub fn is_all(&self) -> bool {
        self.crew.is_none()
    }

    /// Gets the numbers of the others, in an array with as many numbers for every item.
    pub fn complete<T: Exchanged>(&self, array: &mut [T]) {
        let items = self.ends.last().copied().unwrap_or(0).max(1);
        let per_item = array.len() / items;
        self.complete_with(array, |item| item * per_item);
    }

    /// Gets the numbers of the others, in an array where the numbers of item `i` begin at `start(i)`.
    pub fn complete_with<T: Exchanged>(&self, array: &mut [T], start: impl Fn(usize) -> usize) {
        let Some(ranks) = &self.crew else { return };
        agree(&**ranks, Notice::Exchange { numbers: array.len() as u64 });
        T::complete(&**ranks, array, &self.ends.iter().map(|&end| start(end)).collect::<Vec<_>>());
    }

    /// What all processes have found, one after the other.
    pub fn join<T: Exchanged>(&self, own: Vec<T>) -> Vec<T> {
        let Some(ranks) = &self.crew else { return own };
        let notices = ranks.notices(Notice::Exchange { numbers: own.len() as u64 });
        let mut ends = Vec::with_capacity(notices.len());
        let mut end = 0;
        for notice in &notices {
            let Notice::Exchange { numbers } = notice else { ranks.disband(&notices) };
            end += *numbers as usize;
            ends.push(end);
        }
        let mut all = vec![T::default(); end];
        let begin = ends[ranks.rank()] - own.len();
        all[begin..begin + own.len()].copy_from_slice(&own);
        drop(own);
        T::complete(&**ranks, &mut all, &ends);
        all
    }
}

impl fmt::Debug for Share {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?} of {}", self.own, self.ends.last().copied().unwrap_or(0))
    }
}
