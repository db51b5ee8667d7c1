//! Opening what others wrote.

use crate::model::{MemoryError, require_memory};
use std::fs::{self, File, Metadata};
use std::io::{self, Read};
use std::path::Path;

/// Opens a regular file and tells its size in bytes.
///
/// # Errors
/// What the system says; [`io::ErrorKind::IsADirectory`] or, for a device, a pipe or a socket,
/// [`io::ErrorKind::InvalidInput`].
pub fn open(path: &Path) -> io::Result<(File, u64)> {
    // Opening as such can wait for ever, or rewind a tape: look first.
    require_regular(&fs::metadata(path)?)?;
    let file = open_without_waiting(path)?;
    let metadata = file.metadata()?;
    require_regular(&metadata)?;
    Ok((file, metadata.len()))
}

/// Reads a regular file as a whole.
///
/// # Errors
/// Those of [`open`]; [`io::ErrorKind::OutOfMemory`] if it does not fit; [`io::ErrorKind::InvalidInput`] if there is
/// more in it than its size says, as in files that the kernel makes up.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    let (file, size) = open(path)?;
    let refuse = |error: MemoryError| io::Error::new(io::ErrorKind::OutOfMemory, error);
    require_memory("the file", size.saturating_mul(2)).map_err(refuse)?;
    let mut bytes = Vec::with_capacity(usize::try_from(size).unwrap_or(0));
    file.take(size.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > size {
        return Err(not_regular("there is more in it than its size says"));
    }
    Ok(bytes)
}

/// Reads a regular file of UTF-8 as a whole.
///
/// # Errors
/// Those of [`read`]; [`io::ErrorKind::InvalidData`] if it is not text.
pub fn read_text(path: &Path) -> io::Result<String> {
    let refuse = |_| io::Error::new(io::ErrorKind::InvalidData, "it is not a text in UTF-8");
    String::from_utf8(read(path)?).map_err(refuse)
}

/// Whether an error of reading says that the file is the wrong one, rather than that the system failed.
pub fn is_fault_of_input(error: &io::Error) -> bool {
    use io::ErrorKind::{InvalidData, InvalidInput, IsADirectory, NotADirectory, NotFound};
    matches!(error.kind(), InvalidData | InvalidInput | IsADirectory | NotADirectory | NotFound)
}

fn require_regular(metadata: &Metadata) -> io::Result<()> {
    if metadata.is_file() {
        return Ok(());
    }
    Err(match metadata.is_dir() {
        true => io::Error::new(io::ErrorKind::IsADirectory, "it is not a regular file: it is a directory"),
        false => not_regular("it is a device, a pipe or a socket"),
    })
}

fn not_regular(found: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, format!("it is not a regular file: {found}"))
}

/// Between looking and opening a pipe may have taken the place.
#[cfg(unix)]
fn open_without_waiting(path: &Path) -> io::Result<File> {
    use std::os::unix::fs::OpenOptionsExt;
    let nonblocking = rustix::fs::OFlags::NONBLOCK | rustix::fs::OFlags::NOCTTY;
    fs::OpenOptions::new().read(true).custom_flags(nonblocking.bits().cast_signed()).open(path)
}

#[cfg(not(unix))]
fn open_without_waiting(path: &Path) -> io::Result<File> {
    File::open(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_regular_files_are_read() {
        let scratch = tempfile::tempdir().unwrap();
        let file = scratch.path().join("file");
        fs::write(&file, "text").unwrap();
        assert_eq!(read_text(&file).unwrap(), "text");
        fs::write(&file, [0xff]).unwrap();
        assert_eq!(read_text(&file).unwrap_err().kind(), io::ErrorKind::InvalidData);
        let found = |path: &Path| read(path).unwrap_err().to_string();
        assert!(found(scratch.path()).contains("a directory"));
        assert!(is_fault_of_input(&read(&scratch.path().join("none")).unwrap_err()));
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn nothing_endless_is_read() {
        let scratch = tempfile::tempdir().unwrap();
        let fifo = scratch.path().join("fifo");
        rustix::fs::mknodat(rustix::fs::CWD, &fifo, rustix::fs::FileType::Fifo, 0o600.into(), 0).unwrap();
        let found = |path: &Path| read(path).unwrap_err().to_string();
        for path in [fifo.as_path(), Path::new("/dev/zero"), Path::new("/dev/null")] {
            assert!(found(path).contains("a device, a pipe or a socket"), "{}", path.display());
        }
        assert!(found(Path::new("/proc/self/environ")).contains("more in it than its size"));
    }
}
