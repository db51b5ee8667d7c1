//! The `.lab` file: the labels of every state.

use crate::model::{IntervalMdp, StateSet};
use std::io::{self, Write};

/// Writes `0="init" 1="deadlock" …` and then one line `state: label label …` per labelled state.
///
/// # Errors
/// Those of `out`.
pub fn write_lab(model: &IntervalMdp, out: &mut impl Write) -> io::Result<()> {
    let others = model.labels().iter().filter(|(name, _)| *name != "init");
    let labels: Vec<(&str, &StateSet)> = std::iter::once(("init", model.initial())).chain(others).collect();
    let header: Vec<_> = labels.iter().enumerate().map(|(i, (name, _))| format!("{i}=\"{name}\"")).collect();
    writeln!(out, "{}", header.join(" "))?;
    for state in 0..model.num_states() {
        let mut held = labels.iter().enumerate().filter(|(_, (_, set))| set.contains(state)).peekable();
        if held.peek().is_none() {
            continue;
        }
        write!(out, "{state}:")?;
        for (i, _) in held {
            write!(out, " {i}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}
