//! Why a number is not covered.

use std::fmt;

/// Why the answer to a property says nothing about the system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gap {
    /// The model is in reference mode.
    Published,
    /// The file has raised lower bounds.
    RaisedBounds,
    /// A lower bound of a formula that is true in `failed`.
    TrueInFailed,
    /// An upper bound of a formula that is false in `failed`.
    FalseInFailed,
    /// The formula depends on what comes after `reached`.
    AfterReached,
    /// The formula reads variables, or labels of cells, in `reached`.
    ReadsReached,
    /// The question is not about one probability.
    Expression,
}

impl fmt::Display for Gap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Published => "reference mode repeats the published tool's intervals, which are no guarantee",
            Self::RaisedBounds => "lower bounds of 0 are raised in model.tra; model.dynabs has them as they are",
            Self::TrueInFailed => {
                "the formula is true in \"failed\", where noise counts that no row lists, whatever it really does"
            }
            Self::FalseInFailed => {
                "the formula is false in \"failed\", where noise counts that no row lists, although it may make it true"
            }
            Self::Expression => "only questions of one probability of F, G, U or X, without others inside, are covered",
            Self::AfterReached => {
                "the model stays in \"reached\", but a run ends there: of what comes after it nothing is known. Ask for an \
                 until that ends in \"reached\", such as !\"failed\" U \"reached\""
            }
            Self::ReadsReached => {
                "the formula reads in \"reached\" what has no meaning there: variables, or labels of single cells"
            }
        })
    }
}
