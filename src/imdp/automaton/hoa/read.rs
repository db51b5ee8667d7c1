//! States and edges.

use super::acceptance::too_many_alternatives;
use super::header::Header;
use super::label::{Label, too_many_cubes};
use super::lexer::{Token, Tokens};
use super::{HoaError, HoaErrorKind};
use crate::automaton::deterministic::{DeterministicAutomaton, Edge};
use crate::automaton::guard::Guard;

/// Reads a deterministic automaton from the text of a file.
///
/// # Errors
/// [`HoaError`] if the text is no automaton in this format, or one that is not deterministic.
pub fn read_hoa(text: &str) -> Result<DeterministicAutomaton, HoaError> {
    let mut tokens = Tokens::new(text)?;
    let header = Header::read(&mut tokens)?;
    let mut states: Vec<Option<Vec<Edge>>> = vec![None; header.states.unwrap_or(header.start + 1) as usize];
    loop {
        match tokens.peek().clone() {
            Token::Item(item) if item == "State" => tokens.advance()?,
            Token::Mark(mark) if mark == "END" => break,
            _ => return Err(tokens.unexpected("`State:` or --END--")),
        };
        let (state, edges) = read_state(&mut tokens, &header)?;
        let index = state as usize;
        if index >= states.len() {
            states.resize(index + 1, None);
        }
        if states[index].is_some() {
            return Err(tokens.error(HoaErrorKind::Twice { state }));
        }
        let overlap =
            |(i, edge): (usize, &Edge)| edges[..i].iter().any(|other| other.guard.meets(&edge.guard));
        if edges.iter().enumerate().any(overlap) {
            return Err(tokens.error(HoaErrorKind::Nondeterministic { state }));
        }
        states[index] = Some(edges);
    }
    let limit = states.len() as u64;
    let mut edges: Vec<Vec<Edge>> = states.into_iter().map(Option::unwrap_or_default).collect();
    for own in &mut edges {
        if let Some(edge) = own.iter().find(|edge| u64::from(edge.target) >= limit) {
            let found = u64::from(edge.target);
            return Err(tokens.error(HoaErrorKind::Range { what: "the target of an edge", found, limit }));
        }
        // Letters without an edge lead to one more state, which accepts nothing.
        let gap = Guard::gap(own.iter().map(|edge| &edge.guard));
        let guard = gap.ok_or_else(|| tokens.error(too_many_cubes()))?;
        own.push(Edge { guard, target: limit as u32, marks: 0 });
        own.retain(|edge| !edge.guard.is_empty());
    }
    edges.push(vec![]);
    let Header { start, propositions, sets, acceptance, .. } = header;
    DeterministicAutomaton::new(propositions, start as u32, edges, (sets, acceptance))
        .ok_or_else(|| tokens.error(too_many_alternatives()))
}

/// A state and its edges.
fn read_state(tokens: &mut Tokens<'_>, header: &Header) -> Result<(u64, Vec<Edge>), HoaError> {
    let of_state = read_label(tokens, header)?;
    let state = state_number(tokens, header)?;
    if let Token::Text(_) = tokens.peek() {
        tokens.advance()?;
    }
    let marks = read_marks(tokens, header)?;
    let mut edges: Vec<Edge> = vec![];
    loop {
        let guard = match tokens.peek() {
            Token::Symbol('[') => read_label(tokens, header)?,
            Token::Integer(_) => None,
            _ => return Ok((state, edges)),
        };
        let guard = match (guard, &of_state) {
            (Some(guard), _) => guard,
            (None, Some(guard)) => guard.clone(),
            // Without labels there is one edge for each letter, in their order.
            (None, None) => {
                let letter = edges.len() as u64;
                let propositions = header.propositions.len();
                if propositions < 64 && letter >> propositions != 0 {
                    return Err(tokens.unexpected("as many edges as there are letters, or labels"));
                }
                Guard::of_letter(letter, propositions)
            }
        };
        let target = state_number(tokens, header)? as u32;
        if *tokens.peek() == Token::Symbol('&') {
            return Err(tokens.error(HoaErrorKind::Alternating));
        }
        let marks = marks | read_marks(tokens, header)?;
        edges.push(Edge { guard, target, marks });
    }
}

fn state_number(tokens: &mut Tokens<'_>, header: &Header) -> Result<u64, HoaError> {
    tokens.integer("the state", header.states.unwrap_or(1 << 20))
}

/// `[…]`, if it comes next.
fn read_label(tokens: &mut Tokens<'_>, header: &Header) -> Result<Option<Guard>, HoaError> {
    if !tokens.accept('[')? {
        return Ok(None);
    }
    let label = Label::read(tokens, &header.aliases, header.propositions.len())?;
    tokens.expect(']')?;
    label.guard(true).map(Some).ok_or_else(|| tokens.error(too_many_cubes()))
}

/// `{0 2}`, if it comes next, as bits.
fn read_marks(tokens: &mut Tokens<'_>, header: &Header) -> Result<u64, HoaError> {
    let mut marks = 0;
    if tokens.accept('{')? {
        while !tokens.accept('}')? {
            marks |= 1 << tokens.integer("the acceptance set", header.sets as u64)?;
        }
    }
    Ok(marks)
}
