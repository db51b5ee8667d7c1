//! What a run must meet infinitely often, and what finitely often.

use super::Condition;

/// More alternatives than this are given up.
pub(super) const MAX_ALTERNATIVES: usize = 4096;

/// A condition of `Fin` and `Inf` over sets of edges.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum AcceptanceCondition {
    Constant(bool),
    /// `Inf(set)`; with numbers from the number of sets on, the complement of a set is meant.
    Infinitely(usize),
    /// `Fin(set)`
    Finitely(usize),
    And(Vec<Self>),
    Or(Vec<Self>),
}

impl AcceptanceCondition {
    /// The condition that holds where this one does not.
    pub(super) fn negation(&self) -> Self {
        let all = |operands: &[Self]| operands.iter().map(Self::negation).collect();
        match self {
            Self::Constant(value) => Self::Constant(!value),
            Self::Infinitely(set) => Self::Finitely(*set),
            Self::Finitely(set) => Self::Infinitely(*set),
            Self::And(operands) => Self::Or(all(operands)),
            Self::Or(operands) => Self::And(all(operands)),
        }
    }

    /// The alternatives one of which a run must satisfy; none if there are too many.
    pub(super) fn alternatives(&self) -> Option<Vec<Condition>> {
        let one =
            |finitely: Vec<usize>, infinitely: Vec<usize>| Some(vec![Condition { finitely, infinitely }]);
        match self {
            Self::Constant(true) => one(vec![], vec![]),
            Self::Constant(false) => Some(vec![]),
            Self::Infinitely(set) => one(vec![], vec![*set]),
            Self::Finitely(set) => one(vec![*set], vec![]),
            Self::Or(operands) => {
                let mut all = vec![];
                for operand in operands {
                    all.extend(operand.alternatives()?);
                }
                (all.len() <= MAX_ALTERNATIVES).then_some(all)
            }
            Self::And(operands) => {
                let mut all = Self::Constant(true).alternatives()?;
                for operand in operands {
                    let own = operand.alternatives()?;
                    if all.len() * own.len() > MAX_ALTERNATIVES {
                        return None;
                    }
                    all = all.iter().flat_map(|a| own.iter().map(|b| a.and(b))).collect();
                }
                Some(all)
            }
        }
    }
}

impl Condition {
    fn and(&self, other: &Self) -> Self {
        let both = |a: &[usize], b: &[usize]| {
            let mut all = [a, b].concat();
            all.sort_unstable();
            all.dedup();
            all
        };
        Self {
            finitely: both(&self.finitely, &other.finitely),
            infinitely: both(&self.infinitely, &other.infinitely),
        }
    }
}
