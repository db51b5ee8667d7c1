//! The lexical elements that text formats have in common.

use super::error::Fault;

/// The largest number of bytes of a token that an error message repeats.
const SHOWN: usize = 40;

/// A reader of a text whose lines all end in `\n`, one element at a time.
pub(crate) struct Cursor<'a> {
    text: &'a [u8],
    at: usize,
    line_start: usize,
    /// Lines completed so far.
    pub line: u64,
}

impl<'a> Cursor<'a> {
    /// At the start of `text`, whose first line is `line`, counted from 0.
    pub(crate) fn new(text: &'a [u8], line: u64) -> Self {
        Self { text, at: 0, line_start: 0, line }
    }

    /// The next byte; past the end, a line end.
    #[inline]
    pub(crate) fn peek(&self) -> u8 {
        self.text.get(self.at).copied().unwrap_or(b'\n')
    }

    /// Whether everything is read.
    #[inline]
    pub(crate) fn at_end(&self) -> bool {
        self.at >= self.text.len()
    }

    /// The offset into the text.
    #[inline]
    pub(crate) fn offset(&self) -> usize {
        self.at
    }

    /// Everything that is not read yet.
    #[inline]
    pub(crate) fn rest(&self) -> &'a [u8] {
        &self.text[self.at..]
    }

    /// Everything read from an offset on.
    #[inline]
    pub(crate) fn since(&self, offset: usize) -> &'a [u8] {
        &self.text[offset..self.at]
    }

    /// Skips bytes that are known to be there and not to end the line.
    #[inline]
    pub(crate) fn advance(&mut self, bytes: usize) {
        self.at += bytes;
    }

    /// Skips `bytes` if they come next.
    #[inline]
    pub(crate) fn skip(&mut self, bytes: &[u8]) -> bool {
        // A few bytes, for which no function is called.
        let rest = self.rest();
        let matches = rest.len() >= bytes.len() && rest.iter().zip(bytes).all(|(own, byte)| own == byte);
        if matches {
            self.at += bytes.len();
        }
        matches
    }

    /// Skips blanks within the line; whether there were any.
    #[inline]
    pub(crate) fn skip_blanks(&mut self) -> bool {
        let start = self.at;
        while matches!(self.peek(), b' ' | b'\t') && !self.at_end() {
            self.at += 1;
        }
        self.at > start
    }

    /// Skips a word if it comes next as a whole.
    pub(crate) fn skip_word(&mut self, word: &str) -> bool {
        let after = self.rest().get(word.len());
        let ends = after.is_none_or(|byte| byte.is_ascii_whitespace());
        ends && self.skip(word.as_bytes())
    }

    /// Goes back to an offset in the current line.
    pub(crate) fn rewind(&mut self, offset: usize) {
        self.at = offset;
    }

    /// Reads one certain byte.
    #[inline]
    pub(crate) fn expect(&mut self, byte: u8, expected: &str) -> Result<(), Box<Fault>> {
        if self.peek() == byte && !self.at_end() {
            self.at += 1;
            return Ok(());
        }
        Err(self.fault_here(expected))
    }

    /// Reads a number below 2⁶⁴ without sign or leading zeros.
    #[inline]
    pub(crate) fn unsigned(&mut self, expected: &str) -> Result<u64, Box<Fault>> {
        let start = self.at;
        let mut value = 0u64;
        while let digit @ b'0'..=b'9' = self.peek() {
            let next = value.checked_mul(10).and_then(|value| value.checked_add(u64::from(digit - b'0')));
            value = next.ok_or_else(|| self.fault_at(start, expected))?;
            self.at += 1;
        }
        let digits = self.at - start;
        if digits == 0 || (digits > 1 && self.text[start] == b'0') {
            return Err(self.fault_at(start, expected));
        }
        Ok(value)
    }

    /// Reads an identifier: a letter or `_`, then letters, digits and `_`.
    pub(crate) fn identifier(&mut self, expected: &str) -> Result<&'a str, Box<Fault>> {
        let start = self.at;
        while matches!(self.peek(), b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'_') {
            self.at += 1;
        }
        match std::str::from_utf8(&self.text[start..self.at]) {
            Ok(name) if name.bytes().next().is_some_and(|first| !first.is_ascii_digit()) => Ok(name),
            _ => Err(self.fault_at(start, expected)),
        }
    }

    /// Whether the line ends here; `\r\n` is a line end too.
    #[inline]
    pub(crate) fn at_line_end(&self) -> bool {
        match self.peek() {
            b'\n' => true,
            b'\r' => self.text.get(self.at + 1).is_none_or(|&next| next == b'\n'),
            _ => false,
        }
    }

    /// Reads the end of the line.
    #[inline]
    pub(crate) fn line_end(&mut self, expected: &str) -> Result<(), Box<Fault>> {
        if !self.at_line_end() {
            return Err(self.fault_here(expected));
        }
        self.at += if self.peek() == b'\r' { 2 } else { 1 };
        self.line_start = self.at;
        self.line += 1;
        Ok(())
    }

    /// The column of an offset in the current line.
    pub(crate) fn column(&self, offset: usize) -> usize {
        offset - self.line_start + 1
    }

    /// A fault about what comes next.
    #[cold]
    pub(crate) fn fault_here(&self, expected: impl Into<String>) -> Box<Fault> {
        self.fault_at(self.at, expected)
    }

    /// A fault about the token at an offset in the current line.
    #[cold]
    pub(crate) fn fault_at(&self, offset: usize, expected: impl Into<String>) -> Box<Fault> {
        let token = self.text.get(offset..).unwrap_or_default();
        Fault::new(self.line, self.column(offset), expected, describe(token))
    }
}

/// What an error message calls the token that `text` starts with.
pub(crate) fn describe(text: &[u8]) -> String {
    let blank = |byte: &u8| matches!(byte, b' ' | b'\n' | b'\r' | b',' | b']');
    match text.first() {
        None | Some(b'\n' | b'\r') => return "the end of the line".to_owned(),
        Some(b' ') => return "a blank".to_owned(),
        _ => {}
    }
    let end = text.iter().skip(1).position(blank).map_or(text.len(), |end| end + 1);
    let shown = text[..end.min(SHOWN)].escape_ascii();
    format!("`{shown}{}`", if end > SHOWN { "…" } else { "" })
}

/// A number for messages and its noun, in the plural unless it is 1.
pub(crate) fn counted(count: u64, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}
