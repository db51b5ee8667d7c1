//! The names of choices.

use super::archive::TarStream;
use super::{UmbWriter, member};
use crate::model::{ActionNames, IntervalMdp};
use std::borrow::Cow;
use std::io;

/// The names of choices and what stands for none.
#[derive(Debug)]
pub(super) struct Actions<'a> {
    names: &'a ActionNames,
    /// The number of names.
    named: u32,
    /// Some choice has no name: its name is the empty one, after all others.
    has_unnamed: bool,
}

impl<'a> Actions<'a> {
    /// The names of a model; `loops` if states without choices get self-loops, which have no name.
    pub(super) fn new(model: &'a IntervalMdp, loops: bool) -> Self {
        let (named, has_unnamed) = match model.actions() {
            ActionNames::None => (0, false),
            ActionNames::OfRow => {
                (model.rows().len() as u32, loops || !model.choices().absorbing().is_clear())
            }
            ActionNames::OfChoice { names, ids } => {
                (names.len() as u32, loops || ids.contains(&ActionNames::UNNAMED))
            }
        };
        Self { names: model.actions(), named, has_unnamed }
    }

    /// The number of names, with the empty one.
    pub(super) fn count(&self) -> u64 {
        u64::from(self.named) + u64::from(self.has_unnamed)
    }

    fn name(&self, id: u32) -> Cow<'_, str> {
        match self.names {
            ActionNames::OfRow => format!("a_{id}").into(),
            ActionNames::OfChoice { names, .. } => names[id as usize].as_str().into(),
            ActionNames::None => "".into(),
        }
    }

    /// Writes the members, if choices have names.
    pub(super) fn members(&self, writer: &UmbWriter<'_>, tar: &mut TarStream<'_>) -> io::Result<()> {
        if self.names == &ActionNames::None {
            return Ok(());
        }
        let members = member::CHOICE_ACTIONS;
        tar.member(members.values, 4 * writer.choices, |out| {
            let mut choice = 0usize;
            writer.for_each_choice(|state, row| {
                let is_loop = row.is_none() && writer.deadlocks.contains(state.index());
                let id = match self.names {
                    _ if is_loop => None,
                    ActionNames::OfChoice { ids, .. } => {
                        Some(ids[choice]).filter(|&id| id != ActionNames::UNNAMED)
                    }
                    _ => row.map(|row| row.0),
                };
                choice += usize::from(!is_loop);
                out.write_all(&id.unwrap_or(self.named).to_le_bytes())
            })
        })?;
        tar.member(members.mapping, 8 * (self.count() + 1), |out| {
            let mut offset = 0u64;
            out.write_all(&offset.to_le_bytes())?;
            for id in 0..self.named {
                offset += self.name(id).len() as u64;
                out.write_all(&offset.to_le_bytes())?;
            }
            // The empty name takes no room.
            if self.has_unnamed { out.write_all(&offset.to_le_bytes()) } else { Ok(()) }
        })?;
        let bytes = (0..self.named).map(|id| self.name(id).len() as u64).sum();
        tar.member(members.strings, bytes, |out| {
            (0..self.named).try_for_each(|id| out.write_all(self.name(id).as_bytes()))
        })
    }
}
