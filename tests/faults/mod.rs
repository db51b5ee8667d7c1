//! Commands that are killed while they write, and disks that are full: the old or the new output, whole, and nothing
//! else left behind.
#![cfg(target_os = "linux")]

mod full_disk;
mod kill;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The files of a directory and of the directories in it, without what a killed process staged.
pub fn files(directory: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(directory).into_iter().flatten() {
        let entry = entry.unwrap();
        let name = entry.file_name().into_string().unwrap();
        if name.starts_with(".dynabs-") {
            continue;
        }
        if entry.file_type().unwrap().is_dir() {
            let inner = self::files(&entry.path());
            files.extend(inner.into_iter().map(|(inner, bytes)| (format!("{name}/{inner}"), bytes)));
        } else {
            files.insert(name, fs::read(entry.path()).unwrap());
        }
    }
    files
}

/// The names in a directory that begin with a dot.
pub fn left_over(directory: &Path) -> Vec<String> {
    let names = fs::read_dir(directory).into_iter().flatten().map(|entry| entry.unwrap().file_name());
    names.map(|name| name.into_string().unwrap()).filter(|name| name.starts_with('.')).collect()
}
