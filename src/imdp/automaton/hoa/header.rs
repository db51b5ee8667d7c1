//! What stands before the states.

use super::label::Label;
use super::lexer::{Token, Tokens};
use super::{HoaError, HoaErrorKind};
use crate::automaton::acceptance::AcceptanceCondition;
use std::collections::HashMap;

/// More states than this are given up.
const MAX_STATES: u64 = 1 << 20;

/// Letters and sets have one bit each in a word.
const MAX_BITS: u64 = 64;

/// The header of a file.
pub(super) struct Header {
    pub(super) states: Option<u64>,
    pub(super) start: u64,
    pub(super) propositions: Vec<String>,
    pub(super) sets: usize,
    pub(super) acceptance: AcceptanceCondition,
    pub(super) aliases: HashMap<String, Label>,
}

/// What must be there, and what it looks like.
const REQUIRED: [(&str, &str); 2] = [("Start:", "Start: 0"), ("Acceptance:", "Acceptance: 1 Inf(0)")];

impl Header {
    /// Reads up to and including `--BODY--`.
    pub(super) fn read(tokens: &mut Tokens<'_>) -> Result<Self, HoaError> {
        match tokens.advance()? {
            Token::Item(item) if item == "HOA" => {}
            _ => {
                let found = "something else at the beginning".to_owned();
                let expected = "`HOA: v1`, the first line of the Hanoi omega-automata format".to_owned();
                return Err(HoaError { line: 1, kind: HoaErrorKind::Unexpected { found, expected } });
            }
        }
        match tokens.peek() {
            Token::Word(version) if version == "v1" => tokens.advance()?,
            _ => return Err(tokens.unexpected("`v1`, the version of the format")),
        };
        let (mut states, mut start, mut acceptance) = (None, None, None);
        let (mut propositions, mut aliases) = (vec![], HashMap::new());
        loop {
            let item = match tokens.peek().clone() {
                Token::Item(item) => item,
                Token::Mark(mark) if mark == "BODY" => break,
                _ => return Err(tokens.unexpected("a header item such as `States: 2`, or --BODY--")),
            };
            tokens.advance()?;
            match item.as_str() {
                "States" => states = Some(tokens.integer("the number of states", MAX_STATES + 1)?),
                "Start" => {
                    if start.is_some() {
                        return Err(tokens.error(HoaErrorKind::SeveralStarts));
                    }
                    start = Some(tokens.integer("the initial state", states.unwrap_or(MAX_STATES))?);
                    if *tokens.peek() == Token::Symbol('&') {
                        return Err(tokens.error(HoaErrorKind::Alternating));
                    }
                }
                "AP" => propositions = names(tokens)?,
                "Acceptance" => {
                    let sets = number(tokens, "acceptance sets")? as usize;
                    acceptance = Some((sets, AcceptanceCondition::read(tokens, sets)?));
                }
                "Alias" => {
                    let Token::Alias(name) = tokens.peek().clone() else {
                        return Err(tokens.unexpected("the name of an alias, such as `@a`"));
                    };
                    tokens.advance()?;
                    let label = Label::read(tokens, &aliases, propositions.len())?;
                    aliases.insert(name, label);
                }
                // Names in capitals may change what the automaton means; all others are information.
                name if name.starts_with(|c: char| c.is_ascii_uppercase()) => {
                    let found = format!("`{name}:`");
                    let expected =
                        "States, Start, AP, Acceptance, Alias or an item in small letters".to_owned();
                    return Err(tokens.error(HoaErrorKind::Unexpected { found, expected }));
                }
                _ => skip(tokens)?,
            }
        }
        let missing = |index: usize| {
            let (item, example) = REQUIRED[index];
            tokens.error(HoaErrorKind::Missing { item, example })
        };
        let start = start.ok_or_else(|| missing(0))?;
        let (sets, acceptance) = acceptance.ok_or_else(|| missing(1))?;
        if let Some(limit) = states.filter(|&limit| start >= limit) {
            return Err(tokens.error(HoaErrorKind::Range { what: "the initial state", found: start, limit }));
        }
        tokens.advance()?;
        Ok(Self { states, start, propositions, sets, acceptance, aliases })
    }
}

/// How many there are, of which there may be one a bit.
fn number(tokens: &mut Tokens<'_>, what: &'static str) -> Result<u64, HoaError> {
    match *tokens.peek() {
        Token::Integer(found) if found > MAX_BITS => {
            Err(tokens.error(HoaErrorKind::TooMany { what, found, limit: MAX_BITS }))
        }
        _ => tokens.integer(what, MAX_BITS + 1),
    }
}

fn names(tokens: &mut Tokens<'_>) -> Result<Vec<String>, HoaError> {
    let count = number(tokens, "propositions")?;
    let mut names = vec![];
    for _ in 0..count {
        let Token::Text(name) = tokens.peek().clone() else {
            return Err(tokens.unexpected("the name of a proposition in quotation marks"));
        };
        tokens.advance()?;
        names.push(name);
    }
    Ok(names)
}

/// Skips what belongs to an item.
fn skip(tokens: &mut Tokens<'_>) -> Result<(), HoaError> {
    while !matches!(tokens.peek(), Token::Item(_) | Token::Mark(_) | Token::End) {
        tokens.advance()?;
    }
    Ok(())
}
