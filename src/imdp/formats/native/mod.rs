//! This crate's own format, `model.dynabs`: compact, versioned and checksummed.
//!
//! All numbers are little-endian, doubles are their bits, sets of states are bit strings of ⌈states/8⌉
//! bytes with the least significant bit first. The file is
//!
//! ```text
//! "DYNABS\r\n"  u32 version
//! sections      u32 tag, u64 length in bytes, content; in the order below
//! sha256        of everything before it, 32 bytes
//! ```
//!
//! | tag | section | content |
//! |---|---|---|
//! | 1 | kind | u8: 0 interval MDP, 1 interval DTMC |
//! | 2 | row lengths | u32 per row |
//! | 3 | successors | u32 per entry |
//! | 4 | lower bounds | f64 per entry |
//! | 5 | upper bounds | f64 per entry |
//! | 6 | range counts | u32 per state |
//! | 7 | ranges | u32 first row, u32 last row, state by state |
//! | 8 | absorbing states | set |
//! | 9 | initial states | set |
//! | 10 | actions | u8: 0 none, 1 named after rows, 2 by choice: u32 count, names, u32 per choice |
//! | 11 | labels | u32 count; name and set each |
//! | 12 | variables | u32 count; name and u8 each: 0 with i32 per state, 1 with a set |
//! | 13 | rewards | only if there are any: u32 count; name, u8 and f64 per state, u8 and f64 per choice (each 1, or 0 and nothing), u32 count of choices whose branches earn something: u64 choice, u32 count and f64 per branch |
//!
//! A name is its length as u32 and UTF-8. Equal models give equal bytes.

mod error;
mod read;
mod sections;
mod write;

pub use error::NativeError;
pub use read::{read, read_from};
pub use write::{write, write_file};

const MAGIC: [u8; 8] = *b"DYNABS\r\n";
const VERSION: u32 = 1;

/// The sections, in the order in which they are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
enum Section {
    Kind = 1,
    RowLengths,
    Successors,
    Lower,
    Upper,
    RangeCounts,
    Ranges,
    Absorbing,
    Initial,
    Actions,
    Labels,
    Variables,
    Rewards,
}
