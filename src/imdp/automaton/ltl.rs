//! Formulas, and their negation normal form.

use super::LtlError;
use super::formulas::{Dnf, Formulas, Modal};

/// A formula of linear temporal logic over propositions that are numbered from 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ltl {
    /// Holds always.
    True,
    /// Holds if the proposition does now.
    Proposition(u32),
    /// Holds if the operand does not.
    Not(Box<Self>),
    /// Holds if all operands do.
    And(Vec<Self>),
    /// Holds if some operand does.
    Or(Vec<Self>),
    /// `X`: holds if the operand does in the next step.
    Next(Box<Self>),
    /// `F`: holds if the operand does some time from now on.
    Finally(Box<Self>),
    /// `G`: holds if the operand does for ever from now on.
    Globally(Box<Self>),
    /// `a U b`: `b` some time, and `a` until then.
    Until(Box<Self>, Box<Self>),
    /// `a W b`: `a U b`, or `a` for ever.
    Weak(Box<Self>, Box<Self>),
    /// `a R b`: `b` up to and including the time of the first `a`, or for ever.
    Release(Box<Self>, Box<Self>),
}

/// `a M b` is the negation of `¬a W ¬b` and the strong form of `R`: it has no syntax of its own.
impl Ltl {
    /// The formula or its negation, in normal form.
    pub(super) fn normal(&self, positive: bool, formulas: &mut Formulas) -> Result<Dnf, LtlError> {
        Ok(match self {
            Self::True => {
                if positive {
                    Dnf::truth()
                } else {
                    Dnf::falsity()
                }
            }
            Self::Proposition(index) => formulas.modal(Modal::Literal(*index, positive)),
            Self::Not(operand) => operand.normal(!positive, formulas)?,
            Self::And(operands) => combine(operands, positive, positive, formulas)?,
            Self::Or(operands) => combine(operands, !positive, positive, formulas)?,
            Self::Next(operand) => {
                let operand = operand.normal(positive, formulas)?;
                formulas.modal(Modal::Next(operand))
            }
            Self::Finally(operand) => {
                let operand = operand.normal(positive, formulas)?;
                if positive { formulas.finally(operand) } else { formulas.globally(operand) }
            }
            Self::Globally(operand) => {
                let operand = operand.normal(positive, formulas)?;
                if positive { formulas.globally(operand) } else { formulas.finally(operand) }
            }
            Self::Until(left, right) => {
                let (left, right) = (left.normal(positive, formulas)?, right.normal(positive, formulas)?);
                if positive { formulas.until(left, right) } else { formulas.release(left, right) }
            }
            Self::Weak(left, right) => {
                let (left, right) = (left.normal(positive, formulas)?, right.normal(positive, formulas)?);
                if positive { formulas.weak(left, right) } else { formulas.strong(left, right) }
            }
            Self::Release(left, right) => {
                let (left, right) = (left.normal(positive, formulas)?, right.normal(positive, formulas)?);
                if positive { formulas.release(left, right) } else { formulas.until(left, right) }
            }
        })
    }

    /// The number of propositions: the largest one and those below it.
    pub(super) fn propositions(&self) -> usize {
        match self {
            Self::True => 0,
            Self::Proposition(index) => *index as usize + 1,
            Self::Not(operand) | Self::Next(operand) | Self::Finally(operand) | Self::Globally(operand) => {
                operand.propositions()
            }
            Self::And(operands) | Self::Or(operands) => {
                operands.iter().map(Self::propositions).max().unwrap_or(0)
            }
            Self::Until(left, right) | Self::Weak(left, right) | Self::Release(left, right) => {
                left.propositions().max(right.propositions())
            }
        }
    }
}

fn combine(operands: &[Ltl], all: bool, positive: bool, formulas: &mut Formulas) -> Result<Dnf, LtlError> {
    let mut result = if all { Dnf::truth() } else { Dnf::falsity() };
    for operand in operands {
        let operand = operand.normal(positive, formulas)?;
        result = if all { result.and(&operand)? } else { result.or(&operand) };
    }
    Ok(result)
}
