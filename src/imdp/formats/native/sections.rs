//! Reading the elements of sections without trusting any length.

use std::io::{self, Read};

use sha2::{Digest, Sha256};

use super::{MAGIC, NativeError, Section, VERSION};
use crate::model::StateSet;

/// The length of the checksum.
const DIGEST: u64 = 32;

/// How much is read at once.
const PIECE: usize = 1 << 16;

/// A reader that hashes what passes and knows how much is left, of the file and of the section.
pub(super) struct Sections<R> {
    source: R,
    hash: Sha256,
    /// What is left before the checksum.
    left: u64,
    section: Section,
    section_left: u64,
}

impl<R: Read> Sections<R> {
    /// Reads the start of a file of `length` bytes.
    pub(super) fn open(source: R, length: u64) -> Result<Self, NativeError> {
        let left = length.saturating_sub(DIGEST);
        let hash = Sha256::new();
        let mut sections = Self { source, hash, left, section: Section::Kind, section_left: left };
        if left < (MAGIC.len() + 4) as u64 || sections.bytes()? != MAGIC {
            return Err(NativeError::NotNative);
        }
        match u32::from_le_bytes(sections.bytes()?) {
            VERSION => {}
            found => return Err(NativeError::Version { found, expected: VERSION }),
        }
        sections.section_left = 0;
        Ok(sections)
    }

    /// Starts the next section, which must be this one; the previous one must be read to its end.
    pub(super) fn start(&mut self, section: Section) -> Result<(), NativeError> {
        self.end()?;
        self.section = section;
        self.section_left = self.left;
        let tag = u32::from_le_bytes(self.bytes()?);
        if tag != section as u32 {
            return Err(self.broken(format!("section {tag} comes in its place")));
        }
        let length = u64::from_le_bytes(self.bytes()?);
        if length > self.left {
            return Err(self.broken(format!("it would take {length} bytes, {} are left", self.left)));
        }
        self.section_left = length;
        Ok(())
    }

    /// Whether another section follows.
    pub(super) fn has_more(&self) -> bool {
        self.left > self.section_left
    }

    fn end(&self) -> Result<(), NativeError> {
        match self.section_left {
            0 => Ok(()),
            left => Err(self.broken(format!("{left} bytes too many"))),
        }
    }

    /// Checks that everything is read and compares the checksum.
    pub(super) fn finish(mut self) -> Result<(), NativeError> {
        self.end()?;
        if self.left > 0 {
            return Err(self.broken(format!("{} bytes follow the last section", self.left)));
        }
        let mut expected = [0; DIGEST as usize];
        self.source.read_exact(&mut expected).map_err(truncated)?;
        if self.hash.finalize()[..] != expected {
            return Err(NativeError::Checksum);
        }
        match self.source.read(&mut [0]) {
            Ok(0) => Ok(()),
            Ok(_) => Err(NativeError::Truncated),
            Err(error) => Err(NativeError::Io(error)),
        }
    }

    /// An error about the section.
    pub(super) fn broken(&self, problem: impl Into<String>) -> NativeError {
        NativeError::Section { section: format!("{:?}", self.section), problem: problem.into() }
    }

    /// Reads a fixed number of bytes.
    pub(super) fn bytes<const N: usize>(&mut self) -> Result<[u8; N], NativeError> {
        let mut bytes = [0; N];
        self.fill(&mut bytes)?;
        Ok(bytes)
    }

    fn fill(&mut self, bytes: &mut [u8]) -> Result<(), NativeError> {
        self.require(bytes.len() as u64)?;
        self.source.read_exact(bytes).map_err(truncated)?;
        self.hash.update(&*bytes);
        self.left -= bytes.len() as u64;
        self.section_left -= bytes.len() as u64;
        Ok(())
    }

    /// Fails unless so many bytes are left: call it before anything of that size is allocated.
    fn require(&self, bytes: u64) -> Result<(), NativeError> {
        if bytes > self.section_left || bytes > self.left {
            return Err(self.broken(format!("{bytes} bytes needed, {} are left", self.section_left)));
        }
        Ok(())
    }

    /// Reads `count` items of `N` bytes.
    pub(super) fn array<T, const N: usize>(
        &mut self,
        count: u64,
        item: impl Fn([u8; N]) -> T,
    ) -> Result<Vec<T>, NativeError> {
        self.require(count.saturating_mul(N as u64))?;
        let mut items = Vec::with_capacity(count as usize);
        let mut bytes_left = count as usize * N;
        let mut piece = vec![0; bytes_left.min(PIECE / N * N)];
        while bytes_left > 0 {
            let piece_len = bytes_left.min(piece.len());
            self.fill(&mut piece[..piece_len])?;
            items.extend(piece[..piece_len].as_chunks::<N>().0.iter().map(|bytes| item(*bytes)));
            bytes_left -= piece_len;
        }
        Ok(items)
    }

    /// Reads the items that fill the section.
    pub(super) fn rest<T, const N: usize>(
        &mut self,
        item: impl Fn([u8; N]) -> T,
    ) -> Result<Vec<T>, NativeError> {
        if !self.section_left.is_multiple_of(N as u64) {
            return Err(self.broken(format!("{} bytes are no multiple of {N}", self.section_left)));
        }
        self.array(self.section_left / N as u64, item)
    }

    /// Reads a number.
    pub(super) fn u32(&mut self) -> Result<u32, NativeError> {
        Ok(u32::from_le_bytes(self.bytes()?))
    }

    /// Reads a name.
    pub(super) fn name(&mut self) -> Result<String, NativeError> {
        let length = self.u32()?;
        let bytes = self.array(u64::from(length), |[byte]: [u8; 1]| byte)?;
        String::from_utf8(bytes).map_err(|_| self.broken("a name is not UTF-8"))
    }

    /// Reads a set of states.
    pub(super) fn set(&mut self, states: usize) -> Result<StateSet, NativeError> {
        let bytes = self.array(states.div_ceil(8) as u64, |[byte]: [u8; 1]| byte)?;
        let mut set = StateSet::with_capacity(states);
        for (at, byte) in bytes.iter().enumerate().filter(|(_, byte)| **byte != 0) {
            for state in (0..8).filter(|bit| byte >> bit & 1 == 1).map(|bit| 8 * at + bit) {
                if state >= states {
                    return Err(self.broken(format!("a set contains state {state} of {states}")));
                }
                set.insert(state);
            }
        }
        Ok(set)
    }
}

fn truncated(error: io::Error) -> NativeError {
    match error.kind() {
        io::ErrorKind::UnexpectedEof => NativeError::Truncated,
        _ => NativeError::Io(error),
    }
}
