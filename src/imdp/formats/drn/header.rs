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
    /// The labels that are declared in a comment.
    pub labels: Vec<String>,
    /// The variables that are declared in a comment.
    pub variables: Vec<String>,
}

/// The shortest line of a state with its line end, `state 0`.
const SHORTEST_STATE: u64 = 8;

/// Reads up to the line `@model` of a file of so many bytes.
pub(super) fn read_header<R: BufRead>(lines: &mut Lines<'_, R>, bytes: u64) -> Result<Header, ImportError> {
    let (mut kind, mut states, mut choices, mut intervals) = (None, None, None, false);
    let (mut labels, mut variables) = (vec![], vec![]);
    while let Some(mut cursor) = lines.next_or_blank()? {
        let entry = read_entry(&mut cursor).map_err(|fault| lines.place(*fault))?;
        match entry {
            Entry::Comment => {}
            Entry::Kind(found) => once(lines, "@type", &mut kind, found)?,
            Entry::Intervals => intervals = true,
            Entry::Labels(names) => labels = names,
            Entry::Variables(names) => variables = names,
            Entry::Section(name @ ("@parameters" | "@reward_models")) => refuse_content(lines, name)?,
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
                if !intervals {
                    return Err(missing("`@value_type: double-interval`"));
                }
                let kind = kind.ok_or_else(|| missing("`@type: MDP` or `@type: DTMC`"))?;
                let states = states.ok_or_else(|| missing("`@nr_states` and a number"))?;
                return Ok(Header { kind, states, choices, labels, variables });
            }
        }
    }
    Err(lines.refuse(1, "a line `@model` and the states", "the end of the file"))
}

enum Entry {
    Comment,
    Kind(ModelKind),
    Intervals,
    Section(&'static str),
    Labels(Vec<String>),
    Variables(Vec<String>),
    Model,
}

fn read_entry(cursor: &mut Cursor<'_>) -> Result<Entry, Box<Fault>> {
    if cursor.skip(b"//! labels ") {
        return names(cursor).map(Entry::Labels);
    }
    if cursor.skip(b"//! variables ") {
        let start = cursor.offset();
        let names = names(cursor)?;
        let mut seen = HashSet::new();
        if !names.iter().all(|name| seen.insert(name)) {
            return Err(cursor.fault_at(start, "every variable once"));
        }
        return Ok(Entry::Variables(names));
    }
    if cursor.skip(b"//") || cursor.at_line_end() {
        return Ok(Entry::Comment);
    }
    if cursor.skip(b"@type: ") {
        let kind = if cursor.skip(b"MDP") {
            ModelKind::Imdp
        } else if cursor.skip(b"DTMC") {
            ModelKind::Idtmc
        } else {
            return Err(cursor.fault_here("MDP or DTMC, the types of model that are supported"));
        };
        cursor.line_end("MDP or DTMC and the end of the line")?;
        return Ok(Entry::Kind(kind));
    }
    if cursor.skip(b"@value_type: ") {
        if !cursor.skip(b"double-interval") && !cursor.skip(b"double") {
            return Err(
                cursor.fault_here("double-interval or double, the types of values that are supported")
            );
        }
        cursor.line_end("double-interval or double and the end of the line")?;
        return Ok(Entry::Intervals);
    }
    if cursor.skip(b"@model") {
        cursor.line_end("the end of the line")?;
        return Ok(Entry::Model);
    }
    for name in ["@parameters", "@reward_models", "@nr_states", "@nr_choices"] {
        if cursor.skip(name.as_bytes()) {
            cursor.line_end("the end of the line")?;
            return Ok(Entry::Section(name));
        }
    }
    Err(cursor
        .fault_here("@type, @value_type, @parameters, @reward_models, @nr_states, @nr_choices or @model"))
}

/// The names up to the end of the line, separated by blanks.
fn names(cursor: &mut Cursor<'_>) -> Result<Vec<String>, Box<Fault>> {
    let mut names = vec![read_name(cursor)?];
    while !cursor.at_line_end() {
        cursor.expect(b' ', "one blank and the next name")?;
        names.push(read_name(cursor)?);
    }
    Ok(names)
}

/// A name: all that is in quotation marks, or all up to the next blank.
pub(super) fn read_name(cursor: &mut Cursor<'_>) -> Result<String, Box<Fault>> {
    let start = cursor.offset();
    let quoted = cursor.skip(b"\"");
    let inside = cursor.offset();
    while !cursor.at_line_end() && !cursor.at_end() && cursor.peek() != if quoted { b'"' } else { b' ' } {
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

/// The line after a section that must be empty: what would stand there is not supported.
fn refuse_content<R: BufRead>(lines: &mut Lines<'_, R>, section: &str) -> Result<(), ImportError> {
    match lines.next_or_blank()? {
        Some(mut cursor) => {
            while cursor.skip(b" ") || cursor.skip(b"\t") {}
            if cursor.at_line_end() {
                return Ok(());
            }
            let fault = cursor
                .fault_here(format!("an empty line: {} are not supported", &section[1..].replace('_', " ")));
            Err(lines.place(*fault))
        }
        None => Ok(()),
    }
}

fn read_count<R: BufRead>(
    lines: &mut Lines<'_, R>,
    range: std::ops::RangeInclusive<u64>,
) -> Result<u64, ImportError> {
    const EXPECTED: &str = "a number";
    let Some(mut cursor) = lines.next_or_blank()? else {
        return Err(lines.refuse(1, EXPECTED, "the end of the file"));
    };
    let outcome = cursor.unsigned(EXPECTED).and_then(|count| {
        if !range.contains(&count) {
            return Err(cursor.fault_at(0, format!("between {} and {}", range.start(), range.end())));
        }
        cursor.line_end("the end of the line").map(|()| count)
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
