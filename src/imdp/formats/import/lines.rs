//! Reading a text file line by line, with the position for messages at hand.

use std::io::{BufRead, Read};
use std::path::Path;

use super::error::{Fault, ImportError};
use super::text::Cursor;

/// Longer lines are refused; a header with a hundred thousand labels is shorter.
const LONGEST_LINE: u64 = 16 << 20;

/// The lines of a file.
#[derive(Debug)]
pub(crate) struct Lines<'a, R> {
    path: &'a Path,
    source: R,
    buffer: Vec<u8>,
    lines_read: u64,
    bytes_read: u64,
}

impl<'a, R: BufRead> Lines<'a, R> {
    /// Reads from `source`, the content of `path`.
    pub(crate) fn new(path: &'a Path, source: R) -> Self {
        Self { path, source, buffer: vec![], lines_read: 0, bytes_read: 0 }
    }

    /// Reads from `source`, the part of `path` that follows `lines` lines.
    pub(crate) fn starting_at(path: &'a Path, source: R, lines: u64) -> Self {
        Self { lines_read: lines, ..Self::new(path, source) }
    }

    /// The number of lines read so far.
    pub(crate) fn lines_read(&self) -> u64 {
        self.lines_read
    }

    /// The number of bytes read so far.
    pub(crate) fn bytes_read(&self) -> u64 {
        self.bytes_read
    }

    /// What follows the lines read so far.
    pub(crate) fn into_inner(self) -> R {
        self.source
    }

    /// Passes over lines that start with `#`: the files that PRISM exports begin with one.
    pub(crate) fn skip_comments(&mut self) -> Result<(), ImportError> {
        loop {
            let ahead = self.source.fill_buf().map_err(|error| ImportError::io(self.path, error))?;
            if ahead.first() != Some(&b'#') {
                return Ok(());
            }
            self.read_line()?;
        }
    }

    /// The next line; none at the end of the file or if only empty lines follow.
    pub(crate) fn next(&mut self) -> Result<Option<Cursor<'_>>, ImportError> {
        self.read_line()?;
        if self.is_blank() {
            let blank = self.lines_read;
            while self.is_blank() {
                self.read_line()?;
            }
            if !self.buffer.is_empty() {
                let expected = "empty lines at the end of the file only";
                return Err(Fault::new(blank - 1, 1, expected, "an empty line").in_file(self.path, 0));
            }
        }
        if self.buffer.is_empty() {
            return Ok(None);
        }
        Ok(Some(Cursor::new(&self.buffer, self.lines_read - 1)))
    }

    /// The next line, which may be empty; none at the end of the file.
    pub(crate) fn next_or_blank(&mut self) -> Result<Option<Cursor<'_>>, ImportError> {
        self.read_line()?;
        Ok((!self.buffer.is_empty()).then(|| Cursor::new(&self.buffer, self.lines_read - 1)))
    }

    fn is_blank(&self) -> bool {
        matches!(self.buffer.as_slice(), b"\n" | b"\r\n" | b"\r")
    }

    fn read_line(&mut self) -> Result<(), ImportError> {
        self.buffer.clear();
        let mut limited = self.source.by_ref().take(LONGEST_LINE);
        let read = limited.read_until(b'\n', &mut self.buffer);
        let read = read.map_err(|error| ImportError::io(self.path, error))? as u64;
        self.bytes_read += read;
        self.lines_read += u64::from(read > 0);
        if read == LONGEST_LINE {
            let expected = format!("lines of less than {} MiB", LONGEST_LINE >> 20);
            return Err(self.refuse(1, expected, "a longer one"));
        }
        Ok(())
    }

    /// An error about the line read last.
    pub(crate) fn refuse(
        &self,
        column: usize,
        expected: impl Into<String>,
        found: impl Into<String>,
    ) -> ImportError {
        let line = self.lines_read.saturating_sub(1);
        Fault::new(line, column, expected, found).in_file(self.path, 0)
    }

    /// The error of a fault that a cursor of this file has found.
    pub(crate) fn place(&self, fault: Fault) -> ImportError {
        fault.in_file(self.path, 0)
    }
}
