//! What is a formula, what is a number, what is a path formula.

use super::constant::{Constant, constant};
use super::parser::{Parser, Result};
use super::tree::{
    Asked, BinaryOperator, Filter, FilterOperator, Function, Measured, Node, NodeKind, Operator, RewardPath,
    StepBound, StepBounds, Structure, TemporalOperator, UntilOperator,
};
use super::{ParseErrorKind, Relation, unsupported};
use num_traits::ToPrimitive;

/// What an expression is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Type {
    Formula,
    Number,
    /// A variable, which may be either.
    Either,
    /// Something that holds along a path.
    Path,
}

const FORMULA: &str = "a formula (compare a number with something, as in x=1)";
const NUMBER: &str = "a number (a variable, or + - * / of numbers)";
const REWARD_PATH: &str = "F and a formula, another co-safe path formula, C, C<=k or I=k";
const PATH: &str = "a path formula, with one of the operators X, F, G, U, W and R";

impl Parser<'_> {
    /// What an expression is.
    ///
    /// # Errors
    /// [`ParseError`](super::ParseError) at the part that does not fit.
    pub(super) fn infer(&self, node: &Node) -> Result<Type> {
        Ok(match &node.kind {
            NodeKind::True | NodeKind::False | NodeKind::Label(_) => Type::Formula,
            NodeKind::Integer(_) | NodeKind::Decimal(_) => Type::Number,
            NodeKind::Variable(_) => Type::Either,
            NodeKind::Not(operand) => self.logical([&**operand])?,
            NodeKind::And(operands) | NodeKind::Or(operands) => self.logical(operands)?,
            NodeKind::Binary(BinaryOperator::Implies | BinaryOperator::Iff, left, right) => {
                self.logical([&**left, &**right])?
            }
            NodeKind::Binary(BinaryOperator::Compare(comparison), left, right) => {
                self.comparison(*comparison, left, right)?;
                Type::Formula
            }
            NodeKind::Binary(_, left, right) => self.numbers([&**left, &**right])?,
            NodeKind::Negate(operand) => self.numbers([&**operand])?,
            NodeKind::Call(Function::Minimum | Function::Maximum, arguments) => self.numbers(arguments)?,
            NodeKind::Call(_, arguments) => self.numbers(arguments)?,
            NodeKind::Conditional(parts) => self.conditional(parts)?,
            NodeKind::Temporal(operator, bounds, operand) => {
                self.bounds(bounds)?;
                let inside = self.logical([&**operand])?;
                if inside == Type::Path && !bounds.is_none() {
                    return Err(self.error_at(node.span, unsupported::BOUNDED_LTL));
                }
                debug_assert!(*operator != TemporalOperator::Next || bounds.is_none());
                Type::Path
            }
            NodeKind::Until(_, bounds, operands) => {
                self.bounds(bounds)?;
                let inside = self.logical(operands.iter())?;
                if inside == Type::Path && !bounds.is_none() {
                    return Err(self.error_at(node.span, unsupported::BOUNDED_LTL));
                }
                Type::Path
            }
            NodeKind::Automaton(path) => {
                path.propositions.iter().try_for_each(|(_, formula)| self.state_formula(formula))?;
                Type::Path
            }
            NodeKind::Operator(operator) => self.operator_type(operator)?,
            NodeKind::Filter(filter) => self.filter_type(filter)?,
        })
    }

    /// Operands of `!`, `&` and their like.
    fn logical<'n>(&self, operands: impl IntoIterator<Item = &'n Node>) -> Result<Type> {
        let mut all = Type::Formula;
        for operand in operands {
            match self.infer(operand)? {
                Type::Number => return Err(self.wrong_kind(operand, FORMULA)),
                Type::Path => all = Type::Path,
                Type::Formula | Type::Either => {}
            }
        }
        Ok(all)
    }

    fn numbers<'n>(&self, operands: impl IntoIterator<Item = &'n Node>) -> Result<Type> {
        for operand in operands {
            self.as_number(operand, self.infer(operand)?)?;
        }
        Ok(Type::Number)
    }

    /// A node of the type that was inferred, where a number is meant.
    fn as_number(&self, node: &Node, inferred: Type) -> Result<()> {
        match inferred {
            Type::Number | Type::Either => Ok(()),
            Type::Path => Err(self.error_at(node.span, unsupported::PATH_OUTSIDE)),
            Type::Formula => Err(self.wrong_kind(node, NUMBER)),
        }
    }

    /// A formula that is no path formula.
    fn state_formula(&self, node: &Node) -> Result<()> {
        self.as_state_formula(node, self.infer(node)?)
    }

    /// A node of the type that was inferred, where a formula that is no path formula is meant.
    fn as_state_formula(&self, node: &Node, inferred: Type) -> Result<()> {
        match inferred {
            Type::Number => Err(self.wrong_kind(node, FORMULA)),
            Type::Path => Err(self.error_at(node.span, unsupported::PATH_OUTSIDE)),
            Type::Formula | Type::Either => Ok(()),
        }
    }

    /// `=` and `!=` also compare formulas.
    fn comparison(&self, comparison: Relation, left: &Node, right: &Node) -> Result<()> {
        let is_equality = matches!(comparison, Relation::Equal | Relation::NotEqual);
        if !is_equality {
            return self.numbers([left, right]).map(drop);
        }
        // Inferred once: what nests would take twice as long with every level.
        let types = (self.infer(left)?, self.infer(right)?);
        if matches!(types, (Type::Formula, _) | (_, Type::Formula)) {
            self.as_state_formula(left, types.0)?;
            return self.as_state_formula(right, types.1);
        }
        self.as_number(left, types.0)?;
        self.as_number(right, types.1)
    }

    fn conditional(&self, [condition, then, otherwise]: &[Node; 3]) -> Result<Type> {
        self.state_formula(condition)?;
        let types = (self.infer(then)?, self.infer(otherwise)?);
        match types {
            (Type::Formula, _) | (_, Type::Formula) => {
                self.as_state_formula(then, types.0)?;
                self.as_state_formula(otherwise, types.1)?;
                Ok(Type::Formula)
            }
            (Type::Either, Type::Either) => Ok(Type::Either),
            _ => {
                self.as_number(then, types.0)?;
                self.as_number(otherwise, types.1)?;
                Ok(Type::Number)
            }
        }
    }

    fn operator_type(&self, operator: &Operator) -> Result<Type> {
        match &operator.measured {
            Measured::Probability(path) => {
                if self.infer(path)? != Type::Path {
                    return Err(self.wrong_kind(path, PATH));
                }
                self.no_automaton_inside(path)?;
            }
            Measured::Reward(structure, path) => {
                if let Structure::Number(number) = structure {
                    self.steps(number, 1)?;
                }
                self.reward_path_type(path)?;
            }
        }
        match &operator.asked {
            Asked::Value(_) => Ok(Type::Number),
            Asked::ForAll(_, threshold) => {
                self.threshold(threshold, matches!(operator.measured, Measured::Probability(_)))?;
                Ok(Type::Formula)
            }
        }
    }

    /// An automaton is a path formula as a whole, or its negation.
    fn no_automaton_inside(&self, path: &Node) -> Result<()> {
        match &path.kind {
            NodeKind::Automaton(_) => Ok(()),
            NodeKind::Not(operand) => self.no_automaton_inside(operand),
            kind => kind.children().into_iter().try_for_each(|child| self.no_automaton(child)),
        }
    }

    fn no_automaton(&self, node: &Node) -> Result<()> {
        match &node.kind {
            NodeKind::Automaton(_) => Err(self.error_at(node.span, unsupported::AUTOMATON)),
            // What stands in its brackets has been looked at.
            NodeKind::Operator(_) => Ok(()),
            kind => kind.children().into_iter().try_for_each(|child| self.no_automaton(child)),
        }
    }

    fn reward_path_type(&self, path: &RewardPath) -> Result<()> {
        match path {
            RewardPath::Reach(node) => match &node.kind {
                _ if is_cosafe(node, true) => match self.infer(node)? {
                    Type::Path => Ok(()),
                    _ => Err(self.wrong_kind(node, REWARD_PATH)),
                },
                _ => match self.infer(node)? {
                    Type::Path => Err(self.error_at(node.span, unsupported::REWARD_PATH)),
                    _ => Err(self.wrong_kind(node, REWARD_PATH)),
                },
            },
            RewardPath::Cumulative(bound, discount) => {
                if let Some(bound) = bound {
                    self.step_count(bound)?;
                }
                match discount {
                    Some(factor) => self.threshold(factor, true).map(drop),
                    None => Ok(()),
                }
            }
            RewardPath::Instantaneous(steps) => self.steps(steps, 0).map(drop),
        }
    }

    fn filter_type(&self, filter: &Filter) -> Result<Type> {
        if let Some(states) = &filter.states {
            self.state_formula(states)?;
        }
        let operand = self.infer(&filter.operand)?;
        if operand == Type::Path {
            return Err(self.error_at(filter.operand.span, unsupported::PATH_OUTSIDE));
        }
        match filter.operator {
            FilterOperator::Count | FilterOperator::ForAll | FilterOperator::Exists => {
                self.state_formula(&filter.operand)?;
            }
            FilterOperator::State | FilterOperator::First | FilterOperator::Print => return Ok(operand),
            _ => {
                self.numbers([&filter.operand])?;
            }
        }
        Ok(match filter.operator {
            FilterOperator::ForAll | FilterOperator::Exists => Type::Formula,
            _ => Type::Number,
        })
    }

    fn bounds(&self, bounds: &StepBounds) -> Result<()> {
        let (least, most) = self.step_range(bounds)?;
        match most {
            Some(most) if most < least => {
                let span = bounds.upper.as_ref().map_or_else(|| self.span(), |bound| bound.steps.span);
                let found = format!("{least} and {most}");
                Err(self.error_at(span, ParseErrorKind::EmptyRange { found }))
            }
            _ => Ok(()),
        }
    }

    /// The first and the last step at which something may happen; without a bound, 0 and none.
    pub(super) fn step_range(&self, bounds: &StepBounds) -> Result<(u64, Option<u64>)> {
        let least = match &bounds.lower {
            None => 0,
            // `>k` starts one later.
            Some(bound) => self.steps(&bound.steps, 0)? + u64::from(bound.is_strict),
        };
        let most = bounds.upper.as_ref().map(|bound| self.step_count(bound)).transpose()?;
        Ok((least, most))
    }

    /// The last step of `<=k` or `<k`.
    pub(super) fn step_count(&self, bound: &StepBound) -> Result<u64> {
        let least = u8::from(bound.is_strict);
        Ok(self.steps(&bound.steps, least)? - u64::from(least))
    }

    /// A whole number from `least` on.
    pub(super) fn steps(&self, node: &Node, least: u8) -> Result<u64> {
        let value = constant(node).and_then(Constant::number).filter(|value| value.is_integer());
        let steps = value.and_then(|value| value.to_integer().to_u64());
        match steps.filter(|steps| *steps >= u64::from(least) && i32::try_from(*steps).is_ok()) {
            Some(steps) => Ok(steps),
            None => {
                self.no_constant_without_value(node)?;
                let found = self.text(node.span).to_owned();
                Err(self.error_at(node.span, ParseErrorKind::Steps { least, found }))
            }
        }
    }

    /// What is left of names in a number that must be known is a constant nobody defines.
    pub(super) fn no_constant_without_value(&self, node: &Node) -> Result<()> {
        if let NodeKind::Variable(name) = &node.kind {
            return Err(self.error_at(node.span, ParseErrorKind::Undefined { name: name.clone() }));
        }
        node.kind.children().into_iter().try_for_each(|child| self.no_constant_without_value(child))
    }
}

/// Whether a path formula has `X`, `F` and `U` where it counts positively, and `X`, `G`, `W` and `R` elsewhere only: then a
/// beginning of a run shows that it holds.
fn is_cosafe(node: &Node, is_positive: bool) -> bool {
    match &node.kind {
        NodeKind::Not(operand) => is_cosafe(operand, !is_positive),
        NodeKind::And(operands) | NodeKind::Or(operands) => {
            operands.iter().all(|operand| is_cosafe(operand, is_positive))
        }
        NodeKind::Binary(BinaryOperator::Implies, left, right) => {
            is_cosafe(left, !is_positive) && is_cosafe(right, is_positive)
        }
        NodeKind::Binary(BinaryOperator::Iff, left, right) => {
            [left, right].into_iter().all(|operand| is_cosafe(operand, true) && is_cosafe(operand, false))
        }
        NodeKind::Temporal(operator, bounds, operand) => {
            let fits = match operator {
                TemporalOperator::Next => true,
                TemporalOperator::Finally => is_positive || bounds.upper.is_some(),
                TemporalOperator::Globally => !is_positive || bounds.upper.is_some(),
            };
            fits && is_cosafe(operand, is_positive)
        }
        NodeKind::Until(operator, bounds, operands) => {
            let is_until = *operator == UntilOperator::Until;
            (is_until == is_positive || bounds.upper.is_some())
                && operands.iter().all(|operand| is_cosafe(operand, is_positive))
        }
        NodeKind::Automaton(_) => false,
        // What is no path formula is known at once.
        _ => true,
    }
}
