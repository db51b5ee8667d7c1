//! A tar archive whose members are streamed.

use crate::files::interruption;
use crate::progress::Progress;
use std::io::{self, BufWriter, Write};

/// Arrays are handed on in pieces of this many bytes.
pub(super) const PIECE: usize = 1 << 18;

/// The size of a block of a tar archive.
const BLOCK: u64 = 512;

/// Writes members one after the other, or only counts their bytes.
pub(super) struct TarStream<'a> {
    out: Option<(&'a mut dyn Write, &'a dyn Progress)>,
    bytes: u64,
}

impl<'a> TarStream<'a> {
    /// An archive without members.
    pub(super) fn new(out: &'a mut dyn Write, progress: &'a dyn Progress) -> Self {
        Self { out: Some((out, progress)), bytes: 0 }
    }

    /// Counts the bytes of an archive.
    pub(super) fn counting() -> Self {
        Self { out: None, bytes: 0 }
    }

    /// The number of bytes of the members so far and of the end of the archive.
    pub(super) fn bytes(&self) -> u64 {
        self.bytes + 2 * BLOCK
    }

    /// Adds a member of `bytes` bytes, which `fill` writes in pieces as small as it likes.
    pub(super) fn member(
        &mut self,
        name: &str,
        bytes: u64,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> io::Result<()> {
        let padding = bytes.next_multiple_of(BLOCK) - bytes;
        self.bytes += BLOCK + bytes + padding;
        let Some((out, progress)) = &mut self.out else { return Ok(()) };
        let mut header = tar::Header::new_ustar();
        header.set_path(name)?;
        header.set_size(bytes);
        header.set_mode(0o644);
        header.set_mtime(0);
        header.set_uid(0);
        header.set_gid(0);
        header.set_entry_type(tar::EntryType::Regular);
        header.set_cksum();
        out.write_all(header.as_bytes())?;
        let mut counted = Counted { out: *out, progress: *progress, left: bytes };
        let mut buffered = BufWriter::with_capacity(PIECE, &mut counted);
        fill(&mut buffered)?;
        buffered.flush()?;
        drop(buffered);
        if counted.left > 0 {
            return Err(io::Error::other(format!("{name} is shorter than planned")));
        }
        out.write_all(&vec![0; padding as usize])
    }

    /// Ends the archive.
    pub(super) fn finish(self) -> io::Result<()> {
        match self.out {
            Some((out, _)) => out.write_all(&[0; 2 * BLOCK as usize]),
            None => Ok(()),
        }
    }
}

/// Passes on as many bytes as a member has.
struct Counted<'a> {
    out: &'a mut dyn Write,
    progress: &'a dyn Progress,
    left: u64,
}

impl Write for Counted<'_> {
    fn write(&mut self, buffer: &[u8]) -> io::Result<usize> {
        if self.progress.is_interrupted() {
            return Err(interruption());
        }
        let left = self.left.checked_sub(buffer.len() as u64);
        self.left = left.ok_or_else(|| io::Error::other("a member of the archive is longer than planned"))?;
        self.out.write_all(buffer)?;
        self.progress.advance(buffer.len() as u64);
        Ok(buffer.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
