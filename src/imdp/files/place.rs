//! Where output goes: a name in a directory, or something that is written through.

use std::fs::{self, File, Metadata};
use std::io;
use std::path::{Path, PathBuf};

/// So many links are followed, as the kernel does.
const MOST_LINKS: usize = 40;

/// What a path to write to leads to.
#[derive(Debug)]
pub(super) enum Place {
    /// A file to be created or replaced, in a directory that exists.
    File {
        /// The directory, without links.
        directory: PathBuf,
        /// Its name there.
        name: std::ffi::OsString,
    },
    /// A device, a pipe, or a file that the process has open: it is written as it is.
    Through(File),
}

impl Place {
    /// Finds out what `path` leads to.
    ///
    /// # Errors
    /// What the system says; [`io::ErrorKind::IsADirectory`] if a directory is there.
    pub(super) fn of(path: &Path) -> io::Result<Self> {
        let metadata = match fs::metadata(path) {
            Ok(metadata) => Some(metadata),
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Err(error) => return Err(error),
        };
        if metadata.as_ref().is_some_and(Metadata::is_dir) {
            return Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a directory; expected a file"));
        }
        let special = metadata.as_ref().is_some_and(|metadata| !metadata.is_file());
        match (resolve(path)?, metadata) {
            (Some(place), _) if !special => {
                let (Some(directory), Some(name)) = (place.parent(), place.file_name()) else {
                    return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is not the name of a file"));
                };
                Ok(Self::File { directory: directory.to_owned(), name: name.to_owned() })
            }
            (_, Some(metadata)) => through(path, &metadata).map(Self::Through),
            (_, None) => Err(io::ErrorKind::NotFound.into()),
        }
    }
}

/// Follows symbolic links, also to a file that does not exist yet; `None` for a link of the kernel to an open file.
///
/// # Errors
/// What the system says, for example that the directory does not exist.
pub fn resolve(path: &Path) -> io::Result<Option<PathBuf>> {
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        let Some(name) = path.file_name() else { return fs::canonicalize(path).map(Some) };
        let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
        let directory = fs::canonicalize(parent.unwrap_or(Path::new(".")))?;
        let place = directory.join(name);
        match fs::symlink_metadata(&place) {
            Ok(metadata) if metadata.is_symlink() && directory.starts_with("/proc") => return Ok(None),
            Ok(metadata) if metadata.is_symlink() => path = directory.join(fs::read_link(&place)?),
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => return Ok(Some(place)),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}

/// Opens what is to be written through; our own output streams are continued where they are.
#[cfg(unix)]
fn through(path: &Path, metadata: &Metadata) -> io::Result<File> {
    use std::os::fd::AsFd;
    use std::os::unix::fs::MetadataExt;
    let same = |file: &File| {
        file.metadata().is_ok_and(|own| (own.dev(), own.ino()) == (metadata.dev(), metadata.ino()))
    };
    let (out, err) = (io::stdout(), io::stderr());
    for stream in [out.as_fd(), err.as_fd()] {
        let own = File::from(stream.try_clone_to_owned()?);
        if same(&own) {
            return Ok(own);
        }
    }
    // A file opened by somebody else's descriptor is continued at its end.
    fs::OpenOptions::new().append(true).open(path)
}

#[cfg(not(unix))]
fn through(path: &Path, _: &Metadata) -> io::Result<File> {
    fs::OpenOptions::new().write(true).open(path)
}
