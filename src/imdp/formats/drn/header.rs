//! The lines before `@model`.

use crate::formats::import::{Cursor, Fault, ImportError, Lines};
use crate::model::{ModelKind, StateId};
use std::collections::HashSet;
use std::io::BufRead;

/// What the header says.
#[derive(Debug)]
pub(super) struct Header {
    pub kind: ModelKind,
    pub states: u64,
    pub choices: Option<u64>,
    /// The names of reward structures, in the order of their values.
    pub rewards: Vec<String>,
    /// The labels that are declared in a comment.
    pub labels: Vec<String>,
    /// The variables that are declared in a comment.
    pub variables: Vec<String>,
}

/// The shortest line of a state with its line end, `state 0`.
const SHORTEST_STATE: u64 = 8;

/// Reads up to the line `@model` of a file of so many bytes.
pub(super) fn read_header<R: BufRead>(lines: &mut Lines<'_, R>, bytes: u64) -> Result<Header, ImportError> {
    let (mut kind, mut states, mut choices) = (None, None, None);
    let (mut labels, mut variables, mut rewards) = (vec![], vec![], None);
    while let Some(mut cursor) = lines.next_or_blank()? {
        let entry = read_entry(&mut cursor).map_err(|fault| lines.place(*fault))?;
        match entry {
            Entry::Comment => {}
            Entry::Kind(found) => once(lines, "@type", &mut kind, found)?,
            Entry::Labels(names) => labels = names,
            Entry::Variables(names) => variables = names,
            Entry::Section("@parameters") => refuse_content(lines)?,
            Entry::Section(name @ "@reward_models") => {
                let names = read_reward_names(lines)?;
                once(lines, name, &mut rewards, names)?;
            }
            Entry::Section(name @ "@nr_states") => {
                let count = read_count(lines, 1..=u64::from(StateId::MAX))?;
                // A header that lies must not decide how much is allocated.
                let fits = bytes / SHORTEST_STATE;
                if count > fits {
                    let expected = format!("at most {fits} states in a file of {bytes} bytes");
                    return Err(lines.refuse(1, expected, count.to_string()));
                }
                once(lines, name, &mut states, count)?;
            }
            Entry::Section(name) => {
                let count = read_count(lines, 0..=u64::MAX)?;
                once(lines, name, &mut choices, count)?;
            }
            Entry::Model => {
                let missing = |what: &str| lines.refuse(1, format!("{what} before this line"), "none");
                let kind = kind.ok_or_else(|| missing("`@type: MDP` or `@type: DTMC`"))?;
                let states = states.ok_or_else(|| missing("`@nr_states` and a number"))?;
                let rewards = rewards.unwrap_or_default();
                return Ok(Header { kind, states, choices, rewards, labels, variables });
            }
        }
    }
    Err(lines.refuse(1, "a line `@model` and the states", "the end of the file"))
}

enum Entry {
    Comment,
    Kind(ModelKind),
    Section(&'static str),
    Labels(Vec<String>),
    Variables(Vec<String>),
    Model,
}

/// The types of values: what they mean is told by each number itself.
const VALUE_TYPES: [&str; 4] = ["double-interval", "rational-interval", "double", "rational"];

fn read_entry(cursor: &mut Cursor<'_>) -> Result<Entry, Box<Fault>> {
    if cursor.skip(b"//! labels ") {
        return names(cursor).map(Entry::Labels);
    }
    if cursor.skip(b"//! variables ") {
        let start = cursor.offset();
        let names = names(cursor)?;
        if has_twice(&names) {
            return Err(cursor.fault_at(start, "every variable once"));
        }
        return Ok(Entry::Variables(names));
    }
    cursor.skip_blanks();
    if cursor.skip(b"//") || cursor.at_line_end() || cursor.at_end() {
        return Ok(Entry::Comment);
    }
    if cursor.skip(b"@type:") {
        cursor.skip_blanks();
        // PRISM writes the types of interval models as such, Storm writes MDP and says so of the values.
        let kinds = [("IMDP", ModelKind::Imdp), ("IDTMC", ModelKind::Idtmc), ("MDP", ModelKind::Imdp)];
        let mut kinds = kinds.into_iter().chain([("DTMC", ModelKind::Idtmc)]);
        let Some((_, kind)) = kinds.find(|(name, _)| cursor.skip_word(name)) else {
            return Err(cursor.fault_here("MDP or DTMC, the types of model that are supported"));
        };
        end_of_line(cursor, "MDP or DTMC and the end of the line")?;
        return Ok(Entry::Kind(kind));
    }
    if cursor.skip(b"@value_type:") {
        cursor.skip_blanks();
        if !VALUE_TYPES.iter().any(|name| cursor.skip_word(name)) {
            return Err(cursor.fault_here(format!("one of {}", VALUE_TYPES.join(", "))));
        }
        end_of_line(cursor, "the end of the line")?;
        return Ok(Entry::Comment);
    }
    if cursor.skip(b"@model") {
        end_of_line(cursor, "the end of the line")?;
        return Ok(Entry::Model);
    }
    for name in ["@parameters", "@reward_models", "@nr_states", "@nr_choices"] {
        if cursor.skip_word(name) {
            end_of_line(cursor, "the end of the line")?;
            return Ok(Entry::Section(name));
        }
    }
    Err(cursor
        .fault_here("@type, @value_type, @parameters, @reward_models, @nr_states, @nr_choices or @model"))
}

fn has_twice(names: &[String]) -> bool {
    let mut seen = HashSet::new();
    !names.iter().all(|name| seen.insert(name))
}

/// Passes over blanks at the end of a line.
pub(super) fn end_of_line(cursor: &mut Cursor<'_>, expected: &str) -> Result<(), Box<Fault>> {
    cursor.skip_blanks();
    if cursor.at_line_end() || cursor.at_end() { Ok(()) } else { Err(cursor.fault_here(expected)) }
}

/// The names up to the end of the line, separated by blanks.
fn names(cursor: &mut Cursor<'_>) -> Result<Vec<String>, Box<Fault>> {
    let mut names = vec![];
    cursor.skip_blanks();
    while !cursor.at_line_end() && !cursor.at_end() {
        names.push(read_name(cursor)?);
        cursor.skip_blanks();
    }
    Ok(names)
}

/// A name: all that is in quotation marks, or all up to the next blank.
pub(super) fn read_name(cursor: &mut Cursor<'_>) -> Result<String, Box<Fault>> {
    let start = cursor.offset();
    let quoted = cursor.skip(b"\"");
    let inside = cursor.offset();
    let ends = |byte| if quoted { byte == b'"' } else { matches!(byte, b' ' | b'\t') };
    while !cursor.at_line_end() && !cursor.at_end() && !ends(cursor.peek()) {
        cursor.advance(1);
    }
    let name = std::str::from_utf8(cursor.since(inside)).ok().filter(|name| !name.is_empty());
    let Some(name) = name.map(str::to_owned) else {
        return Err(cursor.fault_at(start, "a name"));
    };
    if quoted {
        cursor.expect(b'"', "`\"` after the name")?;
    }
    Ok(name)
}

/// The line after `@reward_models`.
fn read_reward_names<R: BufRead>(lines: &mut Lines<'_, R>) -> Result<Vec<String>, ImportError> {
    let Some(mut cursor) = lines.next_or_blank()? else { return Ok(vec![]) };
    let start = cursor.offset();
    let names = names(&mut cursor).and_then(|names| match has_twice(&names) {
        true => Err(cursor.fault_at(start, "every reward model once")),
        false => Ok(names),
    });
    names.map_err(|fault| lines.place(*fault))
}

/// The line after `@parameters`, which must be empty: models with parameters have no values.
fn refuse_content<R: BufRead>(lines: &mut Lines<'_, R>) -> Result<(), ImportError> {
    let Some(mut cursor) = lines.next_or_blank()? else { return Ok(()) };
    let outcome = end_of_line(&mut cursor, "an empty line: parameters are not supported");
    outcome.map_err(|fault| lines.place(*fault))
}

fn read_count<R: BufRead>(
    lines: &mut Lines<'_, R>,
    range: std::ops::RangeInclusive<u64>,
) -> Result<u64, ImportError> {
    const EXPECTED: &str = "a number";
    let Some(mut cursor) = lines.next_or_blank()? else {
        return Err(lines.refuse(1, EXPECTED, "the end of the file"));
    };
    cursor.skip_blanks();
    let start = cursor.offset();
    let outcome = cursor.unsigned(EXPECTED).and_then(|count| {
        if !range.contains(&count) {
            return Err(cursor.fault_at(start, format!("between {} and {}", range.start(), range.end())));
        }
        end_of_line(&mut cursor, "the end of the line").map(|()| count)
    });
    outcome.map_err(|fault| lines.place(*fault))
}

fn once<R: BufRead, T>(
    lines: &Lines<'_, R>,
    name: &str,
    slot: &mut Option<T>,
    value: T,
) -> Result<(), ImportError> {
    match slot.replace(value) {
        Some(_) => Err(lines.refuse(1, format!("{name} once"), "a second one")),
        None => Ok(()),
    }
}
