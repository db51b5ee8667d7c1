//! Arrays, read entry by entry with the position for messages at hand.

use super::archive::{Archive, MemberReader};
use crate::formats::import::{ImportError, Position};
use std::io::Read;
use std::path::PathBuf;

/// An array in a member of an archive.
pub(super) struct Array {
    source: MemberReader,
    path: PathBuf,
    name: String,
    /// The number of entries read so far.
    read: u64,
}

impl Array {
    /// Opens a member of `count` entries of `width` bytes; none if there is no such member.
    ///
    /// # Errors
    /// [`ImportError`] if the member has another size.
    pub(super) fn open(
        archive: &Archive,
        name: &str,
        width: u64,
        count: u64,
    ) -> Result<Option<Self>, ImportError> {
        let Some(found) = archive.bytes(name) else { return Ok(None) };
        let expected = width.checked_mul(count);
        if expected != Some(found) {
            let expected = format!("{count} entries of {width} bytes, as the index says");
            let at = Position::member(archive.path(), name, None);
            return Err(at.refuse(expected, format!("{found} bytes")));
        }
        let source = archive.read(name)?;
        Ok(source.map(|source| Self {
            source,
            path: archive.path().to_owned(),
            name: name.to_owned(),
            read: 0,
        }))
    }

    /// The bytes of the next entry.
    #[inline]
    pub(super) fn next<const N: usize>(&mut self) -> Result<[u8; N], ImportError> {
        let mut bytes = [0; N];
        self.fill(&mut bytes)?;
        Ok(bytes)
    }

    /// Reads the next entry into `bytes`.
    #[inline]
    pub(super) fn fill(&mut self, bytes: &mut [u8]) -> Result<(), ImportError> {
        match self.source.read_exact(bytes) {
            Ok(()) => {
                self.read += 1;
                Ok(())
            }
            Err(error) => Err(self.at(self.read).refuse("an entry of the array", error.to_string())),
        }
    }

    /// The next entry as two doubles.
    #[inline]
    pub(super) fn next_pair(&mut self) -> Result<(f64, f64), ImportError> {
        let mut bytes = [[0; 8]; 2];
        self.fill(bytes.as_flattened_mut())?;
        Ok((f64::from_le_bytes(bytes[0]), f64::from_le_bytes(bytes[1])))
    }

    /// The next entry, one double, twice.
    #[inline]
    pub(super) fn next_double(&mut self) -> Result<(f64, f64), ImportError> {
        let value = f64::from_le_bytes(self.next()?);
        Ok((value, value))
    }

    /// The next entry as a number.
    #[inline]
    pub(super) fn next_u64(&mut self) -> Result<u64, ImportError> {
        self.next().map(u64::from_le_bytes)
    }

    /// Where an entry is.
    #[cold]
    pub(super) fn at(&self, entry: u64) -> Position {
        Position::member(&self.path, &self.name, Some(entry))
    }

    /// An error about the entry read last.
    #[cold]
    pub(super) fn refuse(&self, expected: impl Into<String>, found: impl Into<String>) -> ImportError {
        self.at(self.read.saturating_sub(1)).refuse(expected, found)
    }
}

/// Offsets `0 = o₀ ≤ o₁ ≤ … = total`; without a member, those of one thing each.
pub(super) struct Offsets {
    array: Option<Array>,
    total: u64,
    last: u64,
}

impl Offsets {
    /// The offsets of `count` things into `total` others.
    ///
    /// # Errors
    /// [`ImportError`] if the member has another size or does not start at 0.
    pub(super) fn open(
        archive: &Archive,
        name: &str,
        count: u64,
        total: u64,
        of_what: &str,
    ) -> Result<Self, ImportError> {
        let entries = count.saturating_add(1);
        let mut array = Array::open(archive, name, 8, entries)?;
        match &mut array {
            Some(array) => {
                let first = array.next_u64()?;
                if first != 0 {
                    return Err(array.refuse("0", first.to_string()));
                }
            }
            None if count != total => {
                let at = Position::member(archive.path(), name, None);
                return Err(at.refuse(format!("where each of {count} {of_what} starts"), "no such member"));
            }
            None => {}
        }
        Ok(Self { array, total, last: 0 })
    }

    /// The next range; the last one is known to end at the total.
    #[inline]
    pub(super) fn next(&mut self, is_last: bool) -> Result<std::ops::Range<u64>, ImportError> {
        let start = self.last;
        self.last = match &mut self.array {
            None => start + 1,
            Some(array) => {
                let end = array.next_u64()?;
                if end < start || end > self.total {
                    return Err(array.refuse(format!("between {start} and {}", self.total), end.to_string()));
                }
                if is_last && end != self.total {
                    return Err(array.refuse(self.total.to_string(), end.to_string()));
                }
                end
            }
        };
        Ok(start..self.last)
    }
}
