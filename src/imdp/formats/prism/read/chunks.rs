//! Cutting a long text into pieces that hold whole choices.

use std::io::{self, Read};

/// How much text a chunk holds, unless one choice is longer.
const CHUNK: usize = 128 << 10;

/// Longer lines are refused: no line of a `.tra` file needs as much.
const LONGEST_LINE: usize = 64 << 10;

/// Reads chunks of whole lines that are cut between choices.
#[derive(Debug)]
pub(super) struct ChunkReader<R> {
    source: R,
    /// The number of leading fields that say which choice a line belongs to.
    key_fields: usize,
    /// What was read beyond the last cut.
    carry: Vec<u8>,
    bytes_read: u64,
    chunk: usize,
}

impl<R: Read> ChunkReader<R> {
    /// Reads from `source`, where `bytes_read` were read already.
    pub(super) fn new(source: R, key_fields: usize, bytes_read: u64) -> Self {
        Self { source, key_fields, carry: vec![], bytes_read, chunk: CHUNK }
    }

    /// The number of bytes read so far.
    pub(super) fn bytes_read(&self) -> u64 {
        self.bytes_read
    }

    /// Up to `count` chunks, none at the end of the text.
    pub(super) fn batch(&mut self, count: usize) -> io::Result<Vec<Vec<u8>>> {
        let mut batch = Vec::with_capacity(count);
        while batch.len() < count {
            let chunk = self.next_chunk()?;
            if chunk.is_empty() {
                break;
            }
            batch.push(chunk);
        }
        Ok(batch)
    }

    fn next_chunk(&mut self) -> io::Result<Vec<u8>> {
        let mut text = std::mem::take(&mut self.carry);
        let mut target = self.chunk;
        loop {
            text.reserve_exact(target.saturating_sub(text.len()));
            let wanted = target.saturating_sub(text.len());
            let read = self.source.by_ref().take(wanted as u64).read_to_end(&mut text)?;
            self.bytes_read += read as u64;
            if read < wanted {
                end_properly(&mut text);
                return Ok(text);
            }
            if let Some(cut) = last_boundary(&text, self.key_fields) {
                self.carry = text[cut..].to_vec();
                text.truncate(cut);
                return Ok(text);
            }
            // One choice fills it all, or one line does.
            if text.len() > LONGEST_LINE && !text[text.len() - LONGEST_LINE..].contains(&b'\n') {
                let problem = format!("a line is longer than {} KiB", LONGEST_LINE >> 10);
                return Err(io::Error::new(io::ErrorKind::InvalidData, problem));
            }
            target *= 2;
        }
    }
}

/// Ends a text with one line end: a missing one is added, empty lines are dropped.
fn end_properly(text: &mut Vec<u8>) {
    if text.last().is_some_and(|&last| last != b'\n') {
        text.push(b'\n');
    }
    while text.ends_with(b"\n\n") || text == b"\n" {
        text.pop();
    }
    while text.ends_with(b"\n\r\n") || text == b"\r\n" {
        text.truncate(text.len() - 2);
    }
}

/// The start of the last complete line's choice, if something comes before it.
fn last_boundary(text: &[u8], key_fields: usize) -> Option<usize> {
    let end = line_start(text, text.len());
    let mut boundary = line_start(text, end.checked_sub(1)?);
    let key = key(&text[boundary..end], key_fields);
    while boundary > 0 {
        let previous = line_start(text, boundary - 1);
        if key.is_none() || !text[previous..].starts_with(key?) {
            return Some(boundary);
        }
        boundary = previous;
    }
    None
}

/// The offset after the last line end before `end`.
fn line_start(text: &[u8], end: usize) -> usize {
    text[..end].iter().rposition(|&byte| byte == b'\n').map_or(0, |at| at + 1)
}

/// The leading fields of a line with the blanks after them.
fn key(line: &[u8], fields: usize) -> Option<&[u8]> {
    let blank = line.iter().enumerate().filter(|(_, byte)| **byte == b' ').nth(fields - 1)?.0;
    Some(&line[..=blank])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chunks(text: &str, key_fields: usize, size: usize) -> Vec<String> {
        let mut reader = ChunkReader::new(text.as_bytes(), key_fields, 0);
        reader.chunk = size;
        let batch = reader.batch(1000).unwrap();
        batch.into_iter().map(|chunk| String::from_utf8(chunk).unwrap()).collect()
    }

    #[test]
    fn choices_stay_together() {
        let text = "0 0 1\n0 0 2\n0 1 1\n0 1 2\n0 1 3\n1 0 1";
        for size in 1..60 {
            let pieces = chunks(text, 2, size);
            assert_eq!(pieces.concat(), format!("{text}\n"), "{size}");
            for piece in pieces {
                let follows = text.find(&piece[..5]).unwrap();
                assert!([0, 12, 30].contains(&follows), "{size}: {piece:?}");
            }
        }
    }

    #[test]
    fn empty_lines_at_the_end_are_dropped() {
        assert_eq!(chunks("0 1\n\n\n", 1, 100), ["0 1\n"]);
        assert_eq!(chunks("0 1\r\n\r\n\r\n", 1, 100), ["0 1\r\n"]);
        assert_eq!(chunks("\n", 1, 100), [""; 0]);
        assert_eq!(chunks("", 1, 100), [""; 0]);
    }

    #[test]
    fn endless_lines_are_refused() {
        let line = "0".repeat(CHUNK * 2);
        let mut reader = ChunkReader::new(line.as_bytes(), 2, 0);
        assert_eq!(reader.batch(1).unwrap_err().kind(), io::ErrorKind::InvalidData);
    }
}
