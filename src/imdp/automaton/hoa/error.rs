//! What is wrong with a file.

/// A file is no deterministic automaton that can be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {kind}")]
pub struct HoaError {
    /// The line, counted from 1.
    pub line: usize,
    /// What is wrong there.
    pub kind: HoaErrorKind,
}

/// What is wrong.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum HoaErrorKind {
    /// Something else was expected.
    #[error("found {found}; expected {expected}")]
    Unexpected {
        /// What stands there.
        found: String,
        /// What should.
        expected: String,
    },
    /// A header item is needed and missing.
    #[error("found no `{item}` in the header; expected one, such as `{example}`")]
    Missing {
        /// The item.
        item: &'static str,
        /// What it looks like.
        example: &'static str,
    },
    /// A number is out of range.
    #[error("found {what} {found}; expected one below {limit}, as the header says")]
    Range {
        /// What the number is of.
        what: &'static str,
        /// The number.
        found: u64,
        /// What it must be below.
        limit: u64,
    },
    /// More than what is supported.
    #[error("found {found} {what}; expected at most {limit}")]
    TooMany {
        /// What there are too many of.
        what: &'static str,
        /// How many there are.
        found: u64,
        /// How many are allowed.
        limit: u64,
    },
    /// Two edges of a state can be taken with the same letter.
    #[error(
        "found two edges of state {state} for the same letter; expected a deterministic automaton; Spot writes one with \
         `ltl2tgba --deterministic --generic`, or `autfilt --determinize`"
    )]
    Nondeterministic {
        /// The state.
        state: u64,
    },
    /// Several states are entered at once.
    #[error("found a conjunction of states (an alternating automaton); expected a single state")]
    Alternating,
    /// There are several initial states.
    #[error("found several initial states; expected one, for the automaton must be deterministic")]
    SeveralStarts,
    /// A state is described twice.
    #[error("found state {state} for the second time; expected it once")]
    Twice {
        /// The state.
        state: u64,
    },
    /// Parentheses are too deep.
    #[error("found more than {limit} parentheses or negations inside of each other; expected less")]
    TooDeep {
        /// How deep they may be.
        limit: usize,
    },
}
