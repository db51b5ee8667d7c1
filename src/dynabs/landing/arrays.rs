//! Arrays that are used again.

use std::sync::{Mutex, PoisonError};

/// The arrays of a step, for the next one: to get fresh memory takes longer than to fill it.
#[derive(Debug, Default)]
pub(crate) struct Arrays(Mutex<Vec<Vec<f64>>>);

/// More arrays than a step has at the same time are not kept.
const MOST: usize = 3;

impl Arrays {
    /// An array with some numbers in it.
    pub(super) fn take(&self, len: usize) -> Vec<f64> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let fits = |array: &&Vec<f64>| array.capacity() >= len;
        let best = kept.iter().filter(fits).map(Vec::capacity).min();
        let place = kept.iter().position(|array| Some(array.capacity()) == best);
        let mut array = place.map_or_else(Vec::new, |place| kept.swap_remove(place));
        drop(kept);
        array.resize(len, 0.0);
        array
    }

    /// Keeps an array that is no longer needed; the smallest gives way.
    pub(crate) fn keep(&self, array: Vec<f64>) {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.push(array);
        if kept.len() > MOST {
            kept.sort_by_key(|array| std::cmp::Reverse(array.capacity()));
            kept.truncate(MOST);
        }
    }
}

impl Clone for Arrays {
    fn clone(&self) -> Self {
        Self::default()
    }
}
