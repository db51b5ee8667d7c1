//! Formulas that hold along a path or do not.

use std::fmt;

use super::StateFormula;

/// A formula that holds along a path or does not.
///
/// `steps: Some(k)` bounds the operator to the first `k` steps; `F<k` is read as `F<=k-1`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PathFormula {
    /// `X φ`: in the next state.
    Next(StateFormula),
    /// `F φ` or `F<=k φ`: in some state.
    Finally {
        /// What must be reached.
        formula: StateFormula,
        /// The number of steps, if bounded.
        steps: Option<u64>,
    },
    /// `G φ` or `G<=k φ`: in all states.
    Globally {
        /// What must be kept.
        formula: StateFormula,
        /// The number of steps, if bounded.
        steps: Option<u64>,
    },
    /// `left U right` or `left U<=k right`: in some state `right`, in all before it `left`.
    Until {
        /// What must hold on the way.
        left: StateFormula,
        /// What must be reached.
        right: StateFormula,
        /// The number of steps, if bounded.
        steps: Option<u64>,
    },
}

impl PathFormula {
    /// The number of steps after which the formula is decided, if there is one.
    pub fn steps(&self) -> Option<u64> {
        match self {
            Self::Next(_) => Some(1),
            Self::Finally { steps, .. } | Self::Globally { steps, .. } | Self::Until { steps, .. } => *steps,
        }
    }

    /// What is printed behind the operator.
    fn bound(&self) -> String {
        match self {
            Self::Next(_) => String::new(),
            _ => self.steps().map(|steps| format!("<={steps}")).unwrap_or_default(),
        }
    }
}

impl fmt::Display for PathFormula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bound = self.bound();
        match self {
            Self::Next(formula) => write!(f, "X {}", operand(formula)),
            Self::Finally { formula, .. } => write!(f, "F{bound} {}", bounded_operand(&bound, formula)),
            Self::Globally { formula, .. } => write!(f, "G{bound} {}", bounded_operand(&bound, formula)),
            Self::Until { left, right, .. } => {
                write!(f, "{} U{bound} {}", operand(left), bounded_operand(&bound, right))
            }
        }
    }
}

/// An operand of a temporal operator.
///
/// PRISM's temporal operators bind weaker than all others, but not those of other tools and readers:
/// with parentheses, `a U (b & c)` is the same to all.
fn operand(formula: &StateFormula) -> String {
    match formula {
        StateFormula::And(_)
        | StateFormula::Or(_)
        | StateFormula::Implies(..)
        | StateFormula::Iff(..)
        | StateFormula::Differ(..) => format!("({formula})"),
        _ => formula.to_string(),
    }
}

/// An operand that follows a bound: `F<=8 -x=1` would continue the bound, 8-x.
fn bounded_operand(bound: &str, formula: &StateFormula) -> String {
    let operand = operand(formula);
    if !bound.is_empty() && operand.starts_with('-') { format!("({operand})") } else { operand }
}
