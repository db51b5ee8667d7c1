//! All explicit files in one: PRISM's `.pexp`, whose sections begin with `# Transitions`, `# States`, and so on.

use std::io::BufRead;
use std::path::Path;

use super::import::{StateFiles, structure};
use super::labels::read_lab;
use super::loose::read_loosely;
use super::rewards::{read_srew, read_trew};
use crate::formats::import::{ImportError, Imported, Lines, Warning, open};
use crate::model::{RewardStructure, require_memory};

/// The kinds of sections, by what their first line starts with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Transitions,
    States,
    Labels,
    StateRewards,
    TransitionRewards,
    Other,
}

/// A part of the file.
struct Section {
    kind: Kind,
    /// How many lines come before it.
    lines_before: u64,
    text: Vec<u8>,
}

/// Reads a model from one file with all sections; a file without any is read as transitions.
///
/// # Errors
/// Those of [`import_files`](super::import_files).
pub fn import_combined(path: &Path, progress: &mut (dyn FnMut(u64) + Send)) -> Result<Imported, ImportError> {
    let sections = cut(path)?;
    progress(sections.iter().map(|section| section.text.len() as u64).sum());
    let of_kind = |kind: Kind| sections.iter().filter(move |section| section.kind == kind);
    let Some(transitions) = of_kind(Kind::Transitions).next() else {
        let mut lines = Lines::new(path, open(path)?.reader);
        lines.next_or_blank()?;
        return Err(lines.refuse(1, "a section `# Transitions`", "none"));
    };
    let (header, transitions) =
        read_loosely(path, &mut transitions.lines(path), transitions.text.len() as u64 + (1 << 16))?;
    let mut parts = StateFiles::default();
    if let Some(section) = of_kind(Kind::States).next() {
        parts.read_variables(path, &mut section.lines(path), header.states)?;
    }
    match of_kind(Kind::Labels).next() {
        Some(section) => parts.labels = Some(read_lab(&mut section.lines(path), header.states)?),
        None => parts.warnings.push(Warning::NoLabelFile { path: path.to_owned() }),
    }
    for section in of_kind(Kind::Other) {
        let name = section.text.split(|byte| *byte == b'\n').next().unwrap_or_default().trim_ascii();
        let what = format!("the section `{}`", String::from_utf8_lossy(name));
        parts.warnings.push(Warning::Ignored { path: path.to_owned(), what });
    }
    let mut imported = parts.into_model(header.kind, header.states, transitions)?;
    let mut structures: Vec<RewardStructure> = vec![];
    for (i, section) in of_kind(Kind::StateRewards).enumerate() {
        read_srew(&mut section.lines(path), &imported.model, structure(&mut structures, i))?;
    }
    for (i, section) in of_kind(Kind::TransitionRewards).enumerate() {
        read_trew(&mut section.lines(path), &imported.model, structure(&mut structures, i))?;
    }
    imported.model = imported.model.with_rewards(structures)?;
    Ok(imported)
}

impl Section {
    fn lines<'a>(&'a self, path: &'a Path) -> Lines<'a, &'a [u8]> {
        Lines::starting_at(path, &self.text, self.lines_before)
    }
}

/// Cuts a file into its sections.
fn cut(path: &Path) -> Result<Vec<Section>, ImportError> {
    let failed = |error| ImportError::io(path, error);
    let source = open(path)?;
    require_memory("the sections of the file", source.length.saturating_mul(2))?;
    let mut reader = source.reader;
    let mut sections = vec![Section { kind: Kind::Transitions, lines_before: 0, text: vec![] }];
    let (mut line, mut number) = (vec![], 0);
    // The kind of a reward section stands in its second line.
    let mut rewards = false;
    while reader.read_until(b'\n', &mut line).map_err(failed)? > 0 {
        match kind(&line) {
            Some(kind @ (Kind::StateRewards | Kind::TransitionRewards)) if rewards => {
                sections.iter_mut().next_back().into_iter().for_each(|section| section.kind = kind);
            }
            Some(kind) => sections.push(Section { kind, lines_before: number, text: vec![] }),
            None => {}
        }
        rewards = line.starts_with(b"# Reward structure");
        if let Some(section) = sections.last_mut() {
            section.text.append(&mut line);
        }
        number += 1;
    }
    // What comes before the first heading is nothing, unless there is no heading at all.
    if sections.len() > 1 && sections[0].text.trim_ascii().is_empty() {
        sections.remove(0);
    }
    Ok(sections)
}

/// The section that a line begins, if it does.
fn kind(line: &[u8]) -> Option<Kind> {
    let kinds: [(&[u8], Kind); 7] = [
        (b"# Transitions", Kind::Transitions),
        (b"# States", Kind::States),
        (b"# Labels", Kind::Labels),
        (b"# Reward structure", Kind::Other),
        (b"# State rewards", Kind::StateRewards),
        (b"# Transition rewards", Kind::TransitionRewards),
        (b"# Observations", Kind::Other),
    ];
    kinds.into_iter().find(|(start, _)| line.starts_with(start)).map(|(_, kind)| kind)
}
