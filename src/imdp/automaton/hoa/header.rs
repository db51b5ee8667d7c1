//! What comes before the states of an automaton.

use super::HoaError;
use super::reader::{Reader, Token};
use crate::automaton::Dfa;
use std::collections::HashMap;

/// The header, as far as it matters.
#[derive(Default)]
pub(super) struct Header {
    pub(super) states: Option<u32>,
    pub(super) start: Option<u32>,
    pub(super) propositions: Vec<String>,
    pub(super) aliases: HashMap<String, Vec<bool>>,
    /// Whether all states accept.
    pub(super) all_accept: bool,
}

impl Header {
    pub(super) fn read(reader: &mut Reader) -> Result<Self, HoaError> {
        let mut header = Self::default();
        let mut accepts = None;
        if reader.next() != Token::Key("HOA".to_owned()) {
            return reader.fail("\"HOA: v1\" at the beginning");
        }
        if reader.next() != Token::Word("v1".to_owned()) {
            return reader.fail("v1");
        }
        loop {
            match reader.next() {
                Token::Mark("--BODY--") => break,
                Token::Key(key) => match key.as_str() {
                    "States" => header.states = Some(reader.number("the number of states")?),
                    "Start" => {
                        let start = reader.number("the number of a state")?;
                        if header.start.replace(start).is_some() || reader.take(&Token::Symbol('&')) {
                            return reader.fail("one start: the automaton must be deterministic");
                        }
                    }
                    "AP" => header.propositions(reader)?,
                    "Alias" => {
                        let Token::Word(name) = reader.next() else {
                            return reader.fail("a name such as @a");
                        };
                        let letters = reader.label(&header, 0)?;
                        header.aliases.insert(name, letters);
                    }
                    "Acceptance" => accepts = Some(acceptance(reader)?),
                    _ => {
                        while !matches!(reader.peek(), Token::Key(_) | Token::Mark(_) | Token::End) {
                            reader.next();
                        }
                    }
                },
                _ => return reader.fail("a header field or --BODY--"),
            }
        }
        let Some(all_accept) = accepts else { return reader.fail("Acceptance: before --BODY--") };
        if header.start.is_none() {
            return reader.fail("Start: before --BODY--");
        }
        Ok(Self { all_accept, ..header })
    }

    fn propositions(&mut self, reader: &mut Reader) -> Result<(), HoaError> {
        let count = reader.number("the number of propositions")? as usize;
        if count > Dfa::MAX_PROPOSITIONS {
            return reader.fail(format!("at most {} propositions", Dfa::MAX_PROPOSITIONS));
        }
        for _ in 0..count {
            match reader.next() {
                Token::Text(name) => self.propositions.push(name),
                _ => return reader.fail(format!("{count} names in quotation marks")),
            }
        }
        Ok(())
    }
}

/// Whether all states accept; else those of set 0 do.
fn acceptance(reader: &mut Reader) -> Result<bool, HoaError> {
    const EXPECTED: &str = "\"1 Inf(0)\" (Büchi) or \"0 t\": what automata of safe and co-safe formulas have";
    match (reader.next(), reader.next()) {
        (Token::Number(0), Token::Word(word)) if word == "t" => Ok(true),
        (Token::Number(1), Token::Word(word)) if word == "Inf" => {
            let rest = [reader.next(), reader.next(), reader.next()];
            let goes_on = matches!(reader.peek(), Token::Symbol('&' | '|'));
            if rest == [Token::Symbol('('), Token::Number(0), Token::Symbol(')')] && !goes_on {
                Ok(false)
            } else {
                reader.fail(EXPECTED)
            }
        }
        _ => reader.fail(EXPECTED),
    }
}
