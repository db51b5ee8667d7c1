//! The names of choices.

use super::super::member::{ActionMembers, BRANCH_ACTIONS, CHOICE_ACTIONS};
use super::archive::Archive;
use super::array::{Array, Offsets};
use super::index::Index;
use crate::formats::import::{Assembly, ImportError, Position};
use crate::model::{ModelKind, require_memory};
use std::io::Read;

/// What choices are called, as it is read along with them.
pub(super) struct Actions {
    /// Per choice or branch; without it, all have the first name.
    values: Option<Array>,
    /// The names belong to branches: all branches of a choice have the same.
    of_branches: bool,
    names: Vec<Name>,
}

#[derive(Clone)]
struct Name {
    text: String,
    /// The id in the model, once it is known to occur.
    id: Option<u32>,
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
        Ok(Some(Self { values: Array::open(archive, members.values, 4, entries)?, of_branches, names }))
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
                if found as usize >= self.names.len() {
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
        let Name { text, id } = &mut self.names[name as usize];
        if id.is_none() && !text.is_empty() {
            *id = Some(assembly.action(text));
        }
        Ok(*id)
    }
}

/// Reads a list of names; without one, they are called `_1`, `_2`, … as PRISM does.
fn read_names(archive: &Archive, members: &ActionMembers, count: u64) -> Result<Vec<Name>, ImportError> {
    let at = |name: &str, entry| Position::member(archive.path(), name, entry);
    let Some(bytes) = archive.bytes(members.strings) else {
        if count > u64::from(u32::MAX) {
            return Err(at(members.strings, None).refuse("names of actions", "no such member"));
        }
        require_memory(format!("{count} names"), count.saturating_mul(48))?;
        return Ok((1..=count).map(|i| Name { text: format!("_{i}"), id: None }).collect());
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
            names.push(Name { text, id: None });
        }
    }
    Ok(names)
}
