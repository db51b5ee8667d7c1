//! Opening a file that may be compressed.

use super::error::ImportError;
use crate::files;
use flate2::read::MultiGzDecoder;
use lzma_rust2::XzReader;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek};
use std::path::Path;

/// How much is read from the file at once.
const BUFFER: usize = 1 << 18;

/// The most memory that a dictionary of xz may want, in KiB: that of its highest level, and to spare.
const XZ_MEMORY: u32 = 256 << 10;

/// How a file is compressed, told by its first bytes whatever it is called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::formats) enum Packing {
    None,
    Gzip,
    Xz,
}

/// The content of a regular file, decompressed on the way.
pub(in crate::formats) struct Source {
    /// The content.
    pub reader: BufReader<Box<dyn Read + Send>>,
    /// How long the content is, in bytes.
    pub length: u64,
}

impl Packing {
    /// That of a file, which is left at its start.
    pub(crate) fn of(file: &mut File) -> io::Result<Self> {
        let mut magic = vec![];
        file.by_ref().take(6).read_to_end(&mut magic)?;
        file.rewind()?;
        Ok(if magic.starts_with(&[0x1f, 0x8b]) {
            Self::Gzip
        } else if magic.starts_with(b"\xfd7zXZ\0") {
            Self::Xz
        } else {
            Self::None
        })
    }

    /// What the bytes of a file are before they were compressed.
    pub(crate) fn unpack(self, file: File) -> Box<dyn Read + Send> {
        match self {
            Self::None => Box::new(file),
            Self::Gzip => Box::new(MultiGzDecoder::new(BufReader::with_capacity(BUFFER, file))),
            Self::Xz => {
                let packed = BufReader::with_capacity(BUFFER, file);
                Box::new(XzReader::new_mem_limit(packed, true, XZ_MEMORY))
            }
        }
    }
}

/// Opens a file; one that is compressed is read through once, to know its length and that it is whole.
///
/// # Errors
/// [`ImportError`] if it is no regular file, or is damaged.
pub(in crate::formats) fn open(path: &Path) -> Result<Source, ImportError> {
    let failed = |error| ImportError::io(path, error);
    let (mut file, size) = files::open(path).map_err(failed)?;
    let packing = Packing::of(&mut file).map_err(failed)?;
    let length = match packing {
        Packing::None => size,
        _ => {
            let (again, _) = files::open(path).map_err(failed)?;
            io::copy(&mut packing.unpack(again), &mut io::sink())
                .map_err(|error| ImportError::Damaged { path: path.to_owned(), problem: error.to_string() })?
        }
    };
    let reader = BufReader::with_capacity(BUFFER, packing.unpack(file));
    Ok(Source { reader, length })
}

/// A path without the ending of a compressed file: `m.tra.gz` is a `.tra` file.
pub(in crate::formats) fn without_packing(path: &Path) -> std::path::PathBuf {
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("gz" | "xz") => path.with_extension(""),
        _ => path.to_owned(),
    }
}
