//! What a path holds.

use super::{Format, prism};
use std::path::{Path, PathBuf};

/// What a path holds, as far as its name tells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Held {
    /// A directory.
    Directory,
    /// A model, and where it is: a file, PRISM's arguments `m.tra,sta,lab` and `m.all`, or the stem of explicit files.
    Model(Format, PathBuf),
    /// Results, findings or a reference, in JSON.
    Json,
    /// Something else.
    Other,
    /// Nothing.
    Nothing,
}

impl Held {
    /// What is at a path.
    pub fn at(path: &Path) -> Self {
        if path.is_dir() {
            return Self::Directory;
        }
        let is_there = path.exists() || prism::ExplicitFiles::listed(path).is_some();
        if !is_there {
            let explicit = PathBuf::from(format!("{}.tra", path.display()));
            return if explicit.exists() { Self::Model(Format::Prism, explicit) } else { Self::Nothing };
        }
        match Format::of_path(path) {
            Some(format) => Self::Model(format, path.to_owned()),
            None if path.extension().is_some_and(|extension| extension == "json") => Self::Json,
            None => Self::Other,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_what_is_there() {
        let scratch = tempfile::tempdir().unwrap();
        let at = |name: &str| scratch.path().join(name);
        for name in ["m.tra", "m.sta", "m.lab", "x.drn.gz", "r.json", "y"] {
            std::fs::write(at(name), "").unwrap();
        }
        let found = |name: &str| Held::at(&at(name));
        assert_eq!(Held::at(scratch.path()), Held::Directory);
        assert_eq!(found("m.tra"), Held::Model(Format::Prism, at("m.tra")));
        assert_eq!(found("m"), Held::Model(Format::Prism, at("m.tra")));
        assert_eq!(found("m.tra,sta,lab"), Held::Model(Format::Prism, at("m.tra,sta,lab")));
        assert_eq!(found("x.drn.gz"), Held::Model(Format::Drn, at("x.drn.gz")));
        assert_eq!((found("r.json"), found("y"), found("z.tra")), (Held::Json, Held::Other, Held::Nothing));
    }
}
