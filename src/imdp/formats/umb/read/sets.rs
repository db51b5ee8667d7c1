//! Sets of states, one bit per state.

use super::super::member::bitset_bytes;
use super::archive::Archive;
use crate::formats::import::{ImportError, Position};
use crate::model::StateSet;
use std::io::Read;

/// Reads the set in a member that must exist.
///
/// # Errors
/// [`ImportError`] if it does not, has another size, or has states that the model has not.
pub(super) fn read_set(archive: &Archive, name: &str, states: u64) -> Result<StateSet, ImportError> {
    let at = |entry| Position::member(archive.path(), name, entry);
    let Some(found) = archive.bytes(name) else {
        return Err(at(None).refuse("one bit per state, as the index says", "no such member"));
    };
    if found != bitset_bytes(states) && found != states.div_ceil(8) {
        let expected = format!("{} bytes, one bit for each of {states} states", bitset_bytes(states));
        return Err(at(None).refuse(expected, format!("{found} bytes")));
    }
    let mut bytes = vec![];
    if let Some(mut source) = archive.read(name)? {
        source
            .read_to_end(&mut bytes)
            .map_err(|error| at(None).refuse("one bit per state", error.to_string()))?;
    }
    if bytes.len() as u64 != found {
        return Err(at(None).refuse(format!("{found} bytes"), format!("{} bytes", bytes.len())));
    }
    let mut set = StateSet::with_capacity(states as usize);
    for (i, byte) in bytes.into_iter().enumerate().filter(|(_, byte)| *byte != 0) {
        for state in (0..8).filter(|bit| byte >> bit & 1 == 1).map(|bit| 8 * i + bit) {
            if state as u64 >= states {
                let expected = format!("no state from {states} on, the number of states");
                return Err(at(Some(state as u64)).refuse(expected, "one"));
            }
            set.insert(state);
        }
    }
    Ok(set)
}
