//! Reading solutions.

use super::header::{FORMAT, Header, SolutionFileError};
use crate::model::StateId;
use crate::solver::{NO_CHOICE, Policy, Solution, ValueBounds};

/// What a solution should be of.
#[derive(Clone, Copy)]
pub struct SolutionSubject<'a> {
    /// The property, in PRISM's syntax.
    pub property: &'a str,
    /// The SHA-256 of the file that says what was solved.
    pub sha256: &'a str,
    /// The number of states.
    pub states: usize,
    /// Whether a state has a choice of this number.
    pub is_choice: &'a dyn Fn(StateId, u32) -> bool,
}

/// Reads a solution.
///
/// # Errors
/// [`SolutionFileError`] if it is of something else, damaged, or says what cannot be.
pub fn read(bytes: &[u8], subject: &SolutionSubject<'_>) -> Result<Solution, SolutionFileError> {
    let end = bytes.iter().position(|&byte| byte == b'\n').unwrap_or(bytes.len());
    let (line, rest) = bytes.split_at(end);
    let header: Header =
        serde_json::from_slice(line).map_err(|error| SolutionFileError::Header(error.to_string()))?;
    let same = |what: &str, found: &str, expected: &str| match found == expected {
        true => Ok(()),
        false => {
            let [found, expected] = [found, expected].map(|text| format!("{what} {text}"));
            Err(SolutionFileError::Other { found, expected })
        }
    };
    same("the format", &header.format, FORMAT)?;
    same("the property", &header.property, subject.property)?;
    same("the model", &header.model, subject.sha256)?;
    same("states:", &header.states.to_string(), &subject.states.to_string())?;
    let mut numbers = Numbers { rest: rest.get(1..).unwrap_or_default() };
    numbers.require(&header)?;
    let values = ValueBounds { lower: numbers.values(header.states)?, upper: numbers.values(header.states)? };
    if let Some(state) = (0..header.states).find(|&s| values.lower[s] > values.upper[s]) {
        let found = format!("bounds {} and {}", values.lower[state], values.upper[state]);
        return Err(SolutionFileError::Number {
            state,
            found,
            expected: "a lower bound up to the upper one",
        });
    }
    let policy = numbers.policy(subject, &header)?;
    let history = (0..header.history).map(|_| numbers.values(header.states)).collect::<Result<_, _>>()?;
    let Header { status, iterations, .. } = header;
    Ok(Solution { values, status, iterations, policy: Some(policy), evidence: None, history })
}

/// The numbers that are still to be read.
struct Numbers<'a> {
    rest: &'a [u8],
}

impl Numbers<'_> {
    /// Whether there are as many bytes as the header says, so that what follows cannot run out of them.
    fn require(&self, header: &Header) -> Result<(), SolutionFileError> {
        let (n, m, h) = (header.states as u64, header.changes as u64, header.history as u64);
        let values = h.saturating_add(2).saturating_mul(n).saturating_mul(8);
        let expected = values.saturating_add(4 * n).saturating_add(m.saturating_mul(12));
        match self.rest.len() as u64 == expected {
            true => Ok(()),
            false => Err(SolutionFileError::Length { found: self.rest.len(), expected }),
        }
    }

    fn next<const N: usize>(&mut self) -> [u8; N] {
        match self.rest.split_first_chunk() {
            Some((chunk, rest)) => {
                self.rest = rest;
                *chunk
            }
            None => [0; N],
        }
    }

    /// A probability of every state.
    fn values(&mut self, states: usize) -> Result<Vec<f64>, SolutionFileError> {
        let value = |state| {
            let value = f64::from_le_bytes(self.next());
            match (0.0..=1.0).contains(&value) {
                true => Ok(value),
                false => {
                    let found = value.to_string();
                    Err(SolutionFileError::Number { state, found, expected: "a probability" })
                }
            }
        };
        (0..states).map(value).collect()
    }

    fn policy(
        &mut self,
        subject: &SolutionSubject<'_>,
        header: &Header,
    ) -> Result<Policy, SolutionFileError> {
        let wrong =
            |state, found: String, expected| Err(SolutionFileError::Number { state, found, expected });
        let counts: Vec<u32> = (0..header.states).map(|_| u32::from_le_bytes(self.next())).collect();
        if counts.iter().map(|&count| u64::from(count)).sum::<u64>() != header.changes as u64 {
            return wrong(0, "other numbers of changes".into(), "as many as the first line says");
        }
        let most = header.horizon.unwrap_or(1);
        let mut changes = Vec::with_capacity(header.changes);
        for (state, &count) in counts.iter().enumerate() {
            let mut before = 0;
            for _ in 0..count {
                let left = u64::from_le_bytes(self.next());
                let choice = u32::from_le_bytes(self.next());
                if left <= before || left > most {
                    return wrong(state, format!("{left} steps left"), "ascending numbers up to the horizon");
                }
                if !(subject.is_choice)(StateId::from_index(state), choice) {
                    return wrong(state, format!("choice {choice}"), "a choice of the state");
                }
                before = left;
                changes.push((StateId::from_index(state), left, choice));
            }
        }
        Ok(match header.horizon {
            Some(horizon) => Policy::time_varying(horizon, header.states, &changes),
            None => {
                let mut choices = vec![NO_CHOICE; header.states];
                changes.iter().for_each(|&(state, _, choice)| choices[state.index()] = choice);
                Policy::stationary(&choices)
            }
        })
    }
}
