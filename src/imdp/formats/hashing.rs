//! SHA-256 of what is written, while it is written.

use crate::files;
use data_encoding::HEXLOWER;
use sha2::{Digest, Sha256};
use std::io::{self, BufReader, Write};
use std::path::Path;

/// From this size on, hashing (about as slow as writing) gets a thread of its own.
const LARGE: usize = 1 << 18;

/// Passes bytes on, counting and hashing them.
#[derive(Debug)]
pub struct HashingWriter<W> {
    inner: W,
    hash: Sha256,
    bytes: u64,
}

impl<W: Write> HashingWriter<W> {
    /// Starts with nothing written.
    pub fn new(inner: W) -> Self {
        Self { inner, hash: Sha256::new(), bytes: 0 }
    }

    /// The writer below, the number of bytes and their SHA-256 in hexadecimal.
    pub fn finish(self) -> (W, u64, String) {
        (self.inner, self.bytes, HEXLOWER.encode(&self.hash.finalize()))
    }
}

impl<W: Write> Write for HashingWriter<W> {
    fn write(&mut self, buffer: &[u8]) -> io::Result<usize> {
        let Self { inner, hash, bytes } = self;
        if buffer.len() < LARGE {
            inner.write_all(buffer)?;
            hash.update(buffer);
        } else {
            let mut hashed = false;
            std::thread::scope(|scope| {
                // Without another thread it only takes longer.
                let thread = std::thread::Builder::new().spawn_scoped(scope, || hash.update(buffer));
                hashed = thread.is_ok();
                inner.write_all(buffer)
            })?;
            if !hashed {
                hash.update(buffer);
            }
        }
        *bytes += buffer.len() as u64;
        Ok(buffer.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

/// The SHA-256 of some bytes, in hexadecimal.
pub fn sha256_hex(bytes: &[u8]) -> String {
    HEXLOWER.encode(&Sha256::digest(bytes))
}

/// The SHA-256 of a file, in hexadecimal.
///
/// # Errors
/// What the system says when the file cannot be read.
pub fn sha256_of_file(path: &Path) -> io::Result<String> {
    let mut writer = HashingWriter::new(io::sink());
    io::copy(&mut BufReader::with_capacity(1 << 16, files::open(path)?.0), &mut writer)?;
    Ok(writer.finish().2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_digest() {
        let mut writer = HashingWriter::new(Vec::new());
        writer.write_all(b"abc").unwrap();
        let (bytes, count, hash) = writer.finish();
        assert_eq!((bytes.as_slice(), count), (b"abc".as_slice(), 3));
        assert_eq!(hash, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
        assert_eq!(hash, sha256_hex(b"abc"));
    }
}
