//! What keeps a formula from becoming an automaton.

/// A formula for which no automaton is made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LtlError {
    /// There are too many temporal operators.
    #[error("found {found} different subformulas with F, G, U, W or R; expected at most {limit}")]
    Operators {
        /// How many there are.
        found: usize,
        /// How many are allowed.
        limit: usize,
    },
    /// There are too many propositions.
    #[error("found {found} different state formulas in a formula; expected at most {limit}")]
    Propositions {
        /// How many there are.
        found: usize,
        /// How many are allowed.
        limit: usize,
    },
    /// A bound on steps is unfolded, and would take too long.
    #[error(
        "found a bound of {found} steps inside of a larger path formula; expected at most {limit}; alone, as in P=? [ F<=1000 \"a\" ], \
         any number will do"
    )]
    Steps {
        /// The steps.
        found: u64,
        /// How many are allowed.
        limit: u64,
    },
    /// No prefix of a word decides the formula, by its form.
    #[error(
        "found a formula in which something has to hold for ever or again and again, and something else to come; expected one \
         that is safe or co-safe"
    )]
    Undecided,
    /// What remains of a formula becomes too large.
    #[error("found a formula whose automaton becomes too large; expected a simpler one")]
    Size,
}
