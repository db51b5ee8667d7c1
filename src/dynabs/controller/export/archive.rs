//! A ZIP archive of a few files in memory: what a `.npz` is.

use flate2::write::DeflateEncoder;
use flate2::{Compression, Crc};
use std::io::{self, Write};

/// An archive that grows file by file; the times of its files are those of nothing, so that the same files are the same bytes.
#[derive(Default)]
pub(super) struct Archive {
    files: Vec<u8>,
    directory: Vec<u8>,
    count: u16,
}

/// Version 2.0, no flags, deflated, midnight of 1980-01-01.
const HEAD: [u8; 10] = [20, 0, 0, 0, 8, 0, 0, 0, 0x21, 0];

impl Archive {
    /// Adds a file.
    ///
    /// # Errors
    /// If the archive grows beyond the 4 GiB that its format counts.
    pub(super) fn add(&mut self, name: &str, content: &[u8]) -> io::Result<()> {
        let mut deflated = DeflateEncoder::new(vec![], Compression::best());
        deflated.write_all(content)?;
        let deflated = deflated.finish()?;
        let mut crc = Crc::new();
        crc.update(content);
        let mut facts = HEAD.to_vec();
        facts.extend(crc.sum().to_le_bytes());
        facts.extend(length(deflated.len())?);
        facts.extend(length(content.len())?);
        facts.extend((name.len() as u16).to_le_bytes());
        let offset = length(self.files.len())?;
        // Nothing extra.
        self.files.extend(
            b"PK\x03\x04".iter().chain(&facts).chain(&[0; 2]).chain(name.as_bytes()).chain(&deflated),
        );
        // Made by version 2.0; no extra, no comment, disk 0, no attributes.
        self.directory.extend(b"PK\x01\x02\x14\0".iter().chain(&facts).chain(&[0; 12]).chain(&offset));
        self.directory.extend(name.as_bytes());
        self.count += 1;
        Ok(())
    }

    /// The archive.
    ///
    /// # Errors
    /// If it is larger than the 4 GiB that its format counts.
    pub(super) fn finish(mut self) -> io::Result<Vec<u8>> {
        let count = self.count.to_le_bytes();
        let lengths = [length(self.directory.len())?, length(self.files.len())?].concat();
        self.files.append(&mut self.directory);
        // One disk, and no comment.
        let end = [b"PK\x05\x06\0\0\0\0", &count[..], &count, &lengths, &[0; 2]].concat();
        self.files.extend(end);
        Ok(self.files)
    }
}

fn length(bytes: usize) -> io::Result<[u8; 4]> {
    let counted = u32::try_from(bytes).map_err(|_| {
        io::Error::new(
            io::ErrorKind::FileTooLarge,
            "the tables are larger than the 4 GiB that the format counts",
        )
    })?;
    Ok(counted.to_le_bytes())
}
