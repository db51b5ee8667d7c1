//! Deterministic automata in the Hanoi Omega-Automata format, version 1 (Babiak et al., CAV 2015).
//!
//! What Spot, Owl and PRISM write of a safe or co-safe formula can be read: one start, labels on edges, on states or implicit,
//! aliases, acceptance `Inf(0)` on states, or `t`. Missing edges lead to a rejecting sink.

mod header;
mod reader;

use super::dfa::Dfa;
use header::Header;
use reader::{Reader, Token};

/// An automaton from a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hoa {
    /// The names of the propositions.
    pub propositions: Vec<String>,
    /// The automaton.
    pub dfa: Dfa,
}

/// Why a text is no automaton of this kind.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: found {found}; expected {expected}")]
pub struct HoaError {
    /// Where, counted from 1.
    pub line: usize,
    /// What is there.
    pub found: String,
    /// What should be.
    pub expected: String,
}

/// More states than this are no task.
const MAX_STATES: usize = 1 << 16;

impl Hoa {
    /// Reads a text.
    ///
    /// # Errors
    /// [`HoaError`] if it is not in the format, not deterministic, or has another kind of acceptance.
    pub fn parse(text: &str) -> Result<Self, HoaError> {
        let mut reader = Reader::new(text)?;
        let header = Header::read(&mut reader)?;
        let body = Body::read(&mut reader, &header)?;
        let dfa = body.automaton(&header)?;
        Ok(Self { propositions: header.propositions, dfa })
    }
}

struct Body {
    /// By state and letter.
    next: Vec<Vec<Option<u32>>>,
    accepting: Vec<bool>,
}

impl Body {
    fn read(reader: &mut Reader, header: &Header) -> Result<Self, HoaError> {
        let letters = 1usize << header.propositions.len();
        let mut body = Self { next: vec![], accepting: vec![] };
        loop {
            match reader.next() {
                Token::Mark("--END--") => return Ok(body),
                Token::Key(key) if key == "State" => body.state(reader, header, letters)?,
                Token::Mark("--ABORT--") => return reader.fail("a whole automaton"),
                _ => return reader.fail("\"State:\" or --END--"),
            }
        }
    }

    fn state(&mut self, reader: &mut Reader, header: &Header, letters: usize) -> Result<(), HoaError> {
        let of_all = self.bracketed(reader, header)?;
        let state = reader.number("the number of a state")? as usize;
        let limit = header.states.map_or(MAX_STATES, |states| (states as usize).min(MAX_STATES));
        if state >= limit {
            return reader.fail(format!("a state below {limit}"));
        }
        if matches!(reader.peek(), Token::Text(_)) {
            reader.next();
        }
        let accepting = self.accepting_sets(reader)?;
        self.grow(state + 1, letters);
        self.accepting[state] = accepting;
        let mut implicit = 0;
        loop {
            let label = match self.bracketed(reader, header)? {
                Some(label) => label,
                None if matches!(reader.peek(), Token::Number(_)) => match &of_all {
                    Some(label) => label.clone(),
                    None if implicit < letters => {
                        let letter = implicit;
                        implicit += 1;
                        (0..letters).map(|l| l == letter).collect()
                    }
                    None => {
                        reader.next();
                        return reader.fail(format!("{letters} edges without a label, one for each letter"));
                    }
                },
                None => return Ok(()),
            };
            let to = reader.number("the state that the edge leads to")?;
            if matches!(reader.peek(), Token::Symbol('&')) {
                reader.next();
                return reader.fail("one state: the automaton must not be alternating");
            }
            if to as usize >= limit {
                return reader.fail(format!("a state below {limit}"));
            }
            if *reader.peek() == Token::Symbol('{') {
                reader.next();
                return reader
                    .fail("acceptance on states, not on edges (autfilt -S turns one into the other)");
            }
            self.grow(to as usize + 1, letters);
            for (slot, _) in self.next[state].iter_mut().zip(&label).filter(|(_, has)| **has) {
                if slot.replace(to).is_some_and(|other| other != to) {
                    return reader.fail(format!(
                        "one successor for each letter: state {state} has two, the automaton must be deterministic (ltl2tgba -D)"
                    ));
                }
            }
        }
    }

    fn bracketed(&self, reader: &mut Reader, header: &Header) -> Result<Option<Vec<bool>>, HoaError> {
        if !reader.take(&Token::Symbol('[')) {
            return Ok(None);
        }
        let label = reader.label(header, 0)?;
        reader.symbol(']')?;
        Ok(Some(label))
    }

    fn accepting_sets(&self, reader: &mut Reader) -> Result<bool, HoaError> {
        let mut accepting = false;
        if reader.take(&Token::Symbol('{')) {
            while !reader.take(&Token::Symbol('}')) {
                accepting |= reader.number("the number of an acceptance set or \"}\"")? == 0;
            }
        }
        Ok(accepting)
    }

    fn grow(&mut self, states: usize, letters: usize) {
        if self.next.len() < states {
            self.next.resize(states, vec![None; letters]);
            self.accepting.resize(states, false);
        }
    }

    fn automaton(mut self, header: &Header) -> Result<Dfa, HoaError> {
        let letters = 1usize << header.propositions.len();
        let start = header.start.unwrap_or_default();
        if start as usize >= MAX_STATES {
            let expected = format!("a start below {MAX_STATES}");
            return Err(HoaError { line: 1, found: start.to_string(), expected });
        }
        self.grow(start as usize + 1, letters);
        if header.all_accept {
            self.accepting.fill(true);
        }
        let sink = self.next.len() as u32;
        let mut next: Vec<u32> = self.next.iter().flatten().map(|to| to.unwrap_or(sink)).collect();
        next.extend(vec![sink; letters]);
        self.accepting.push(false);
        Ok(Dfa::from_parts(header.propositions.len() as u32, start, next, self.accepting))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::automaton::Aim;

    /// As Spot writes `F (a & (!b U c))`, with an alias.
    const DELIVERY: &str = r#"HOA: v1
name: "F(a & (!b U c))" /* a comment
over lines */
States: 3
Start: 1
AP: 3 "a" "b" "c"
acc-name: Buchi
Acceptance: 1 Inf(0)
properties: trans-labels explicit-labels state-acc complete deterministic terminal
Alias: @go 0 & !1
--BODY--
State: 0 {0}
[t] 0
State: 1 "waiting"
[!0 | (0 & 1 & !2)] 1
[@go & !2] 2
[0 & 2] 0
State: 2
[!1&!2] 2
[1&!2] 1
[2] 0
--END--
"#;

    #[test]
    fn automata_are_read() {
        let hoa = Hoa::parse(DELIVERY).unwrap();
        assert_eq!(hoa.propositions, ["a", "b", "c"]);
        assert_eq!(hoa.dfa.aim(), Some(Aim::Reach));
        let carrying = hoa.dfa.step(hoa.dfa.start(), 0b001);
        assert_eq!(hoa.dfa.step(carrying, 0b010), hoa.dfa.start());
        assert_eq!(hoa.dfa.minimal(Aim::Reach).num_states(), 3);
        let safe = "HOA: v1 Start: 0 AP: 1 \"bad\" Acceptance: 0 t --BODY-- State: [!0] 0 0 --END--";
        assert_eq!(Hoa::parse(safe).unwrap().dfa.minimal(Aim::Stay).num_states(), 2);
        let implicit = "HOA: v1 States: 2 Start: 0 AP: 1 \"a\" Acceptance: 1 Inf(0) --BODY-- State: 0 0 1 State: 1 {0} 1 0 --END--";
        let hoa = Hoa::parse(implicit).unwrap();
        assert_eq!((hoa.dfa.step(0, 1), hoa.dfa.step(1, 1), hoa.dfa.aim()), (1, 0, None));
    }

    #[test]
    fn mistakes_have_a_line() {
        let change = |from: &str, to: &str| Hoa::parse(&DELIVERY.replacen(from, to, 1)).unwrap_err();
        for (from, to, line, expected) in [
            ("HOA: v1", "HOA: v2", 1, "v1"),
            ("HOA: v1", "never {", 1, "HOA"),
            ("1 Inf(0)", "1 Fin(0)", 8, "Inf(0)"),
            ("1 Inf(0)", "2 Inf(0)&Inf(1)", 8, "Inf(0)"),
            ("Start: 1", "Start: 1&2", 5, "deterministic"),
            ("[t] 0", "[t] 0 {0}", 13, "on states"),
            ("[2] 0", "[2|0] 0", 21, "deterministic"),
            ("[2] 0", "[3] 0", 21, "below 3"),
            ("[2] 0", "[2] 7", 21, "below 3"),
            ("[2] 0", "[2] ?", 21, "a word"),
            ("--END--", "", 22, "--END--"),
            ("AP: 3", "AP: 13", 6, "at most 12"),
        ] {
            let error = change(from, to);
            assert!(error.line == line && error.expected.contains(expected), "{from} -> {to}: {error}");
        }
        assert!(Hoa::parse("").unwrap_err().to_string().starts_with("line 1: found the end"));
        let deep = DELIVERY.replacen("[2] 0", &format!("[{}2] 0", "(".repeat(100_000)), 1);
        assert!(Hoa::parse(&deep).unwrap_err().expected.contains("deeply"));
    }
}
