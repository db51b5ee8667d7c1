//! The files that one command writes.

use super::directory::{FILES, sync_directory};
use super::left_over::finish;
use super::place::Place;
use super::staged::{StagedDirectory, rename_new};
use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

/// Files written beside their places: nobody ever sees half of one, nor one without the others.
///
/// Those of one directory appear together; [`settle`](super::settle) tells readers. Dropped without
/// [`commit`](Self::commit), nothing appears.
#[derive(Debug, Default)]
pub struct Outputs {
    groups: Vec<Group>,
}

/// The files of one directory.
#[derive(Debug)]
struct Group {
    directory: PathBuf,
    staged: StagedDirectory,
    names: Vec<OsString>,
}

impl Outputs {
    /// Writes a file through `fill`; it appears at `path` with [`commit`](Self::commit).
    ///
    /// A device or a pipe is written at once.
    ///
    /// # Errors
    /// What the system says, and the errors of `fill`.
    pub fn write(
        &mut self,
        path: &Path,
        fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ) -> io::Result<()> {
        let (file, is_staged) = match Place::of(path)? {
            Place::Through(file) => (file, false),
            Place::File { directory, name } => (self.group(directory)?.create(name)?, true),
        };
        let mut out = BufWriter::with_capacity(1 << 16, file);
        fill(&mut out)?;
        let file = out.into_inner().map_err(io::IntoInnerError::into_error)?;
        if is_staged { file.sync_all() } else { Ok(()) }
    }

    /// Whether `path` can hold one of several files: it is, or can become, a regular file.
    ///
    /// # Errors
    /// What the system says.
    pub fn is_file(path: &Path) -> io::Result<bool> {
        Ok(matches!(Place::of(path)?, Place::File { .. }))
    }

    /// Puts all files into their places.
    ///
    /// # Errors
    /// What the system says.
    pub fn commit(self) -> io::Result<()> {
        self.groups.iter().try_for_each(|group| group.publish(|from, to| fs::rename(from, to)))
    }

    /// Puts all files into their places, each of which must be free.
    ///
    /// # Errors
    /// What the system says; [`io::ErrorKind::AlreadyExists`] if a place is taken.
    pub fn commit_new(self) -> io::Result<()> {
        for group in &self.groups {
            if group.names.iter().any(|name| fs::symlink_metadata(group.directory.join(name)).is_ok()) {
                return Err(io::ErrorKind::AlreadyExists.into());
            }
        }
        self.groups.iter().try_for_each(|group| group.publish(rename_new))
    }

    fn group(&mut self, directory: PathBuf) -> io::Result<&mut Group> {
        let at = match self.groups.iter().position(|group| group.directory == directory) {
            Some(at) => at,
            None => {
                let staged = StagedDirectory::new(&directory)?;
                self.groups.push(Group { directory, staged, names: vec![] });
                self.groups.len() - 1
            }
        };
        Ok(&mut self.groups[at])
    }
}

impl Group {
    fn create(&mut self, name: OsString) -> io::Result<File> {
        let file = File::create_new(self.staged.path().join(&name))?;
        // Who may read the old file may read the new one, and nobody else.
        if let Ok(old) = fs::metadata(self.directory.join(&name)) {
            file.set_permissions(old.permissions())?;
        }
        self.names.push(name);
        Ok(file)
    }

    /// Puts the files into their places, one by `rename`, several by way of a directory that counts.
    fn publish(&self, rename: impl FnOnce(&Path, &Path) -> io::Result<()>) -> io::Result<()> {
        sync_directory(self.staged.path())?;
        self.staged.publish(|staged| match self.names.as_slice() {
            [] => Ok(()),
            [name] => {
                rename(&staged.join(name), &self.directory.join(name))?;
                sync_directory(&self.directory)
            }
            _ => finish(&StagedDirectory::renamed(staged, &self.directory, FILES)?, &self.directory),
        })
    }
}
