//! The names of choices.

use super::super::member::{ActionMembers, BRANCH_ACTIONS, CHOICE_ACTIONS};
use super::archive::Archive;
use super::array::{Array, Offsets};
use super::index::Index;
use crate::formats::import::{Assembly, ImportError, Position};
use crate::model::{ModelKind, require_memory};
use std::borrow::Cow;
use std::collections::HashMap;
use std::io::Read;

/// What choices are called, as it is read along with them.
pub(super) struct Actions {
    /// Per choice or branch; without it, all have the first name.
    values: Option<Array>,
    /// The names belong to branches: all branches of a choice have the same.
    of_branches: bool,
    names: Names,
    /// The ids in the model of the names that have occurred.
    ids: HashMap<u32, u32>,
}

/// A list of names.
enum Names {
    /// They are given.
    Given(Vec<String>),
    /// So many that are not given: they are called `_1`, `_2`, … as PRISM does.
    Counted(u64),
}

impl Names {
    fn len(&self) -> u64 {
        match self {
            Self::Given(names) => names.len() as u64,
            Self::Counted(count) => *count,
        }
    }

    fn text(&self, name: u32) -> Cow<'_, str> {
        match self {
            Self::Given(names) => names[name as usize].as_str().into(),
            Self::Counted(_) => format!("_{}", u64::from(name) + 1).into(),
        }
    }
}

impl Actions {
    /// The names of choices, or of branches in a chain, where PRISM has them; none if there are none.
    ///
    /// # Errors
    /// [`ImportError`] if a member is missing or malformed.
    pub(super) fn open(archive: &Archive, index: &mut Index) -> Result<Option<Self>, ImportError> {
        let counts = index.counts;
        let of_branches =
            counts.choice_actions == 0 && counts.branch_actions > 0 && index.kind == ModelKind::Idtmc;
        if counts.branch_actions > 0 && !of_branches {
            index.ignore(archive, "names of branches".to_owned());
        }
        let (members, count, entries) = match of_branches {
            true => (BRANCH_ACTIONS, counts.branch_actions, counts.branches),
            false => (CHOICE_ACTIONS, counts.choice_actions, counts.choices),
        };
        if count == 0 {
            return Ok(None);
        }
        let names = read_names(archive, &members, count)?;
        let values = Array::open(archive, members.values, 4, entries)?;
        Ok(Some(Self { values, of_branches, names, ids: HashMap::new() }))
    }

    /// The id of the name of the next choice, which has `branches` branches; none if it has no name.
    pub(super) fn next(
        &mut self,
        branches: u64,
        assembly: &mut Assembly,
    ) -> Result<Option<u32>, ImportError> {
        let mut name = 0;
        if let Some(values) = &mut self.values {
            for branch in 0..if self.of_branches { branches } else { 1 } {
                let found = u32::from_le_bytes(values.next()?);
                if u64::from(found) >= self.names.len() {
                    let expected = format!("a name below {}, the number of names", self.names.len());
                    return Err(values.refuse(expected, found.to_string()));
                }
                if branch > 0 && found != name {
                    let expected = format!("name {name} as for the other branches of this choice");
                    return Err(values.refuse(expected, found.to_string()));
                }
                name = found;
            }
        }
        if let Some(&id) = self.ids.get(&name) {
            return Ok(Some(id));
        }
        let text = self.names.text(name);
        if text.is_empty() {
            return Ok(None);
        }
        let id = assembly.action(&text);
        self.ids.insert(name, id);
        Ok(Some(id))
    }
}

/// Reads a list of names.
fn read_names(archive: &Archive, members: &ActionMembers, count: u64) -> Result<Names, ImportError> {
    let at = |name: &str, entry| Position::member(archive.path(), name, entry);
    let Some(bytes) = archive.bytes(members.strings) else {
        if count > u64::from(u32::MAX) {
            return Err(at(members.strings, None).refuse("names of actions", "no such member"));
        }
        return Ok(Names::Counted(count));
    };
    if archive.bytes(members.mapping).is_none() {
        return Err(at(members.mapping, None).refuse("where each name starts", "no such member"));
    }
    let mut offsets = Offsets::open(archive, members.mapping, count, bytes, "names")?;
    require_memory(format!("{count} names"), bytes.saturating_add(count.saturating_mul(48)))?;
    let mut names = vec![];
    if let Some(mut source) = archive.read(members.strings)? {
        for name in 0..count {
            let range = offsets.next(name + 1 == count)?;
            let length = range.end - range.start;
            let mut text = vec![];
            let read = source.by_ref().take(length).read_to_end(&mut text);
            read.map_err(|error| at(members.strings, Some(range.start)).refuse("a name", error.to_string()))?;
            let text = String::from_utf8(text).ok().filter(|text| text.len() as u64 == length);
            let Some(text) = text else {
                return Err(
                    at(members.strings, Some(range.start)).refuse("a name in UTF-8", "something else")
                );
            };
            names.push(text);
        }
    }
    Ok(Names::Given(names))
}
