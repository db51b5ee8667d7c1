//! Lines cut into fields, for readers that do not mind how much blank there is between them.

use super::error::Fault;
use super::text::{Cursor, describe};
use std::ops::Range;

/// The fields of a line: what blanks separate, an interval in brackets being one field.
pub(in crate::formats) struct Fields<'a> {
    line: &'a [u8],
    /// The number of the line, from 0.
    number: u64,
    ranges: Vec<Range<usize>>,
    next: usize,
}

impl<'a> Fields<'a> {
    /// Cuts a line; `None` if it is blank or starts with `comment`.
    pub(crate) fn cut(cursor: &Cursor<'a>, comment: &[u8]) -> Option<Self> {
        let line = cursor.rest().trim_ascii_end();
        let mut ranges: Vec<Range<usize>> = vec![];
        let mut start = None;
        let mut depth = 0usize;
        for (at, byte) in line.iter().enumerate() {
            match byte {
                b'[' => depth += 1,
                b']' => depth = depth.saturating_sub(1),
                _ => {}
            }
            match start {
                None if !byte.is_ascii_whitespace() => start = Some(at),
                Some(from) if byte.is_ascii_whitespace() && depth == 0 => {
                    ranges.push(from..at);
                    start = None;
                }
                _ => {}
            }
        }
        ranges.extend(start.map(|from| from..line.len()));
        let first = ranges.first()?;
        if !comment.is_empty() && line[first.start..].starts_with(comment) {
            return None;
        }
        Some(Self { line, number: cursor.line, ranges, next: 0 })
    }

    /// How many fields there are.
    pub(crate) fn len(&self) -> usize {
        self.ranges.len()
    }

    /// The number of the line, from 0.
    pub(crate) fn line(&self) -> u64 {
        self.number
    }

    /// The next field.
    pub(crate) fn next(&mut self, expected: &str) -> Result<&'a [u8], Box<Fault>> {
        match self.ranges.get(self.next) {
            Some(range) => {
                self.next += 1;
                Ok(&self.line[range.clone()])
            }
            None => Err(Fault::new(self.number, self.line.len() + 1, expected, "the end of the line")),
        }
    }

    /// The next field, a number below `limit`.
    pub(crate) fn number(&mut self, what: &str, limit: u64) -> Result<u64, Box<Fault>> {
        let field = self.next(what)?;
        let text = std::str::from_utf8(field).ok().filter(|text| {
            text.bytes().all(|byte| byte.is_ascii_digit()) && (*text == "0" || !text.starts_with('0'))
        });
        let number = text.and_then(|text| text.parse::<u64>().ok()).ok_or_else(|| self.fault(what))?;
        match number < limit {
            true => Ok(number),
            false => Err(self.fault(format!("{what} below {limit}"))),
        }
    }

    /// A field that may follow as the last one.
    pub(crate) fn last(&mut self, expected: &str) -> Result<Option<&'a [u8]>, Box<Fault>> {
        let field = self.ranges.get(self.next).map(|range| &self.line[range.clone()]);
        self.next += usize::from(field.is_some());
        match self.ranges.get(self.next) {
            None => Ok(field),
            Some(_) => {
                self.next += 1;
                Err(self.fault(expected))
            }
        }
    }

    /// A fault about the field read last.
    pub(crate) fn fault(&self, expected: impl Into<String>) -> Box<Fault> {
        let start =
            self.next.checked_sub(1).and_then(|last| self.ranges.get(last)).map_or(0, |range| range.start);
        Fault::new(self.number, start + 1, expected, describe(&self.line[start..]))
    }
}
