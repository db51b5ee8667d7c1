//! One name per thing, one thing per name: no public type name occurs twice in a crate.

use crate::common::root;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let path = entry.path();
        if entry.file_type().unwrap().is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// The name of the public type that a line declares; `unreachable_pub` keeps `pub` for what the docs show.
fn declared(line: &str) -> Option<&str> {
    let rest = line.trim_start().strip_prefix("pub ")?;
    let rest =
        ["struct ", "enum ", "trait ", "type ", "union "].iter().find_map(|kind| rest.strip_prefix(kind))?;
    rest.split(|c: char| !c.is_alphanumeric() && c != '_').next()
}

#[test]
fn no_public_type_name_occurs_twice_in_a_crate() {
    for name in ["imdp", "dynabs", "cli"] {
        let mut files = vec![];
        sources(&root().join("src").join(name), &mut files);
        let mut places: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for file in &files {
            for line in fs::read_to_string(file).unwrap().lines() {
                if let Some(found) = declared(line) {
                    places.entry(found.to_owned()).or_default().push(file.display().to_string());
                }
            }
        }
        assert!(places.len() > 10, "{name}: {places:?}");
        let twice: Vec<_> = places.iter().filter(|(_, files)| files.len() > 1).collect();
        assert!(twice.is_empty(), "{name}: {twice:#?}");
    }
}

#[test]
fn declarations_are_recognised() {
    assert_eq!(declared("pub struct Row<'a> {"), Some("Row"));
    assert_eq!(declared("    pub type Rational = num_rational::BigRational;"), Some("Rational"));
    assert_eq!(declared("pub(crate) struct Row;"), None);
    assert_eq!(declared("    pub typed: u32,"), None);
}
