//! The members of a tar archive, each of which can be read on its own.

use crate::files;
use crate::formats::import::{ImportError, Packing, Position};
use std::collections::HashMap;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// How much is read from the file at once.
const BUFFER: usize = 1 << 17;

/// How many bytes of small members are kept at most, and of each of them.
const KEPT: u64 = 64 << 20;
const SMALL: u64 = 16 << 20;

/// How long what tar says ahead of a member may be, its name above all.
const LONGEST_NAME: u64 = 1 << 16;

/// A UMB archive: where each member is.
#[derive(Debug)]
pub(super) struct Archive {
    path: PathBuf,
    packing: Packing,
    members: HashMap<String, Member>,
}

/// Where a member is in the uncompressed archive.
#[derive(Clone, Debug)]
struct Member {
    offset: u64,
    bytes: u64,
    /// Kept from the first pass if it is small: to get there again, all before it would be decompressed again.
    content: Option<Arc<[u8]>>,
}

/// Whether an entry is no member, but says something of the next one.
fn is_extension(kind: tar::EntryType) -> bool {
    kind.is_gnu_longname()
        || kind.is_gnu_longlink()
        || kind.is_pax_local_extensions()
        || kind.is_pax_global_extensions()
}

/// The name of the next member, if an entry gives it.
fn name_ahead(entry: &mut tar::Entry<'_, impl Read>) -> io::Result<Option<Vec<u8>>> {
    let kind = entry.header().entry_type();
    let mut content = vec![];
    entry.read_to_end(&mut content)?;
    if kind.is_gnu_longname() {
        content.truncate(content.iter().position(|&byte| byte == 0).unwrap_or(content.len()));
        return Ok(Some(content));
    }
    let mut name = None;
    if kind.is_pax_local_extensions() {
        for record in tar::PaxExtensions::new(&content) {
            let record = record?;
            match record.key_bytes() {
                b"path" => name = Some(record.value_bytes().to_owned()),
                b"size" => return Err(io::Error::other("a member of 8 GiB or more, as PAX writes its size")),
                _ => {}
            }
        }
    }
    Ok(name)
}

/// One member, read from its start.
pub(super) type MemberReader = BufReader<Box<dyn Read>>;

impl Archive {
    /// Finds the members, decompressing everything once.
    ///
    /// # Errors
    /// [`ImportError`] if the archive is damaged or cut short, or holds a member twice.
    pub(super) fn open(path: &Path) -> Result<Self, ImportError> {
        let io = |error| ImportError::io(path, error);
        let (mut file, _) = files::open(path).map_err(io)?;
        let packing = Packing::of(&mut file).map_err(io)?;
        let mut archive = Self { path: path.to_owned(), packing, members: HashMap::new() };
        let mut rest = archive.list(BufReader::with_capacity(BUFFER, packing.unpack(file)))?;
        if packing != Packing::None {
            // Only at its end does the checksum tell whether all of it was right.
            io::copy(&mut rest, &mut io::sink()).map_err(|error| Self::damaged(path, &error))?;
        }
        Ok(archive)
    }

    fn list<R: Read>(&mut self, source: R) -> Result<R, ImportError> {
        let damaged = |error| Self::damaged(&self.path, &error);
        let mut tar = tar::Archive::new(source);
        let (mut end, mut kept) = (0, 0);
        let mut long_name = None;
        // Raw: otherwise a name is read as a whole, however long it is.
        for entry in tar.entries().map_err(damaged)?.raw(true) {
            let mut entry = entry.map_err(damaged)?;
            if is_extension(entry.header().entry_type()) {
                if entry.size() > LONGEST_NAME {
                    let found = format!("one of {} bytes", entry.size());
                    return Err(Self::refuse(&self.path, "names of members that are shorter", found));
                }
                long_name = name_ahead(&mut entry).map_err(damaged)?.or(long_name);
                continue;
            }
            let name = long_name.take().unwrap_or_else(|| entry.path_bytes().into_owned());
            let name = String::from_utf8_lossy(&name);
            let name = name.strip_prefix("./").unwrap_or(&name).to_owned();
            let mut member = Member { offset: entry.raw_file_position(), bytes: entry.size(), content: None };
            if member.offset.checked_add(member.bytes).is_none() || member.offset < end {
                return Err(Self::refuse(
                    &self.path,
                    "members one after the other",
                    format!("{name} elsewhere"),
                ));
            }
            end = member.offset + member.bytes;
            match entry.header().entry_type() {
                tar::EntryType::Directory => continue,
                tar::EntryType::Regular | tar::EntryType::Continuous => {}
                other => {
                    let found = format!("{name} of type {other:?}");
                    return Err(Self::refuse(&self.path, "regular files and directories", found));
                }
            }
            if self.packing != Packing::None && member.bytes <= SMALL && kept + member.bytes <= KEPT {
                let mut content = vec![];
                entry.read_to_end(&mut content).map_err(damaged)?;
                if content.len() as u64 == member.bytes {
                    kept += member.bytes;
                    member.content = Some(content.into());
                }
            }
            if self.members.insert(name.clone(), member).is_some() {
                return Err(Self::refuse(&self.path, "every member once", format!("{name} twice")));
            }
        }
        Ok(tar.into_inner())
    }

    fn damaged(path: &Path, error: &io::Error) -> ImportError {
        // What the system says of the disk comes with a code, what is wrong with the content does not.
        match error.raw_os_error() {
            Some(code) => ImportError::io(path, io::Error::from_raw_os_error(code)),
            None => {
                Self::refuse(path, "a tar archive, as it is or compressed with gzip or xz", error.to_string())
            }
        }
    }

    fn refuse(path: &Path, expected: &str, found: impl Into<String>) -> ImportError {
        Position::member(path, "the archive", None).refuse(expected, found)
    }

    /// The file.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// The names of the members, in no order.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.members.keys().map(String::as_str)
    }

    /// The number of bytes of a member, if it exists.
    pub(super) fn bytes(&self, name: &str) -> Option<u64> {
        self.members.get(name).map(|member| member.bytes)
    }

    /// Reads one member; none if there is no such member.
    pub(super) fn read(&self, name: &str) -> Result<Option<MemberReader>, ImportError> {
        let Some(Member { offset, bytes, content }) = self.members.get(name) else { return Ok(None) };
        if let Some(content) = content {
            let source: Box<dyn Read> = Box::new(io::Cursor::new(Arc::clone(content)));
            return Ok(Some(BufReader::new(source)));
        }
        let io = |error| ImportError::io(&self.path, error);
        let (mut file, _) = files::open(&self.path).map_err(io)?;
        let source: Box<dyn Read> = if self.packing == Packing::None {
            file.seek(SeekFrom::Start(*offset)).map_err(io)?;
            Box::new(file.take(*bytes))
        } else {
            let mut unpacked = self.packing.unpack(file);
            let before = io::copy(&mut unpacked.by_ref().take(*offset), &mut io::sink());
            before.map_err(|error| Self::damaged(&self.path, &error))?;
            Box::new(unpacked.take(*bytes))
        };
        Ok(Some(BufReader::with_capacity(BUFFER, source)))
    }
}
