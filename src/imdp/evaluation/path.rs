//! The probability of a path formula.

use super::expression::Evaluator;
use super::syntax::{is_path, range};
use super::{EvaluationError, Known, Truth};
use crate::automaton::{Ltl, LtlError};
use crate::model::IntervalMdp;
use crate::property::{
    BinaryOperator, Node, NodeKind, Resolution, StepBounds, TemporalOperator, UntilOperator,
};
use crate::solver::{Event, Extremes, SolverOptions, exact_values, solve, solve_delayed};

/// `safe U[first, last] goal`
struct PathEvent {
    safe: Truth,
    goal: Truth,
    first: u64,
    last: Option<u64>,
}

impl Evaluator<'_> {
    /// Bounds on the probability of a path formula.
    pub(super) fn probability(
        &mut self,
        path: &Node,
        resolution: Resolution,
    ) -> Result<Known, EvaluationError> {
        match &path.kind {
            NodeKind::Automaton(automaton) => return self.automaton(automaton, resolution),
            NodeKind::Not(operand) => {
                return Ok(self.probability(operand, resolution.flipped())?.complement());
            }
            NodeKind::Temporal(operator, bounds, operand) if !is_path(operand) => {
                let operand = self.truth(operand)?;
                if *operator == TemporalOperator::Next {
                    return self.next(&operand, resolution);
                }
                let always = Truth::constant(true, self.model.num_states());
                let (first, last) = range(bounds);
                return match operator {
                    TemporalOperator::Globally => {
                        let event = PathEvent { safe: always, goal: operand.not(), first, last };
                        Ok(self.event(&event, resolution.flipped())?.complement())
                    }
                    _ => self.event(&PathEvent { safe: always, goal: operand, first, last }, resolution),
                };
            }
            NodeKind::Until(operator, bounds, operands) if !operands.iter().any(is_path) => {
                let (left, right) = (self.truth(&operands[0])?, self.truth(&operands[1])?);
                let (first, last) = range(bounds);
                return match operator {
                    UntilOperator::Until => {
                        self.event(&PathEvent { safe: left, goal: right, first, last }, resolution)
                    }
                    // `a W b` fails when neither holds before `b` has held.
                    UntilOperator::Weak if first == 0 => {
                        let (left, right) = (left.not(), right.not());
                        let event = PathEvent { goal: left.and(&right), safe: right, first, last };
                        Ok(self.event(&event, resolution.flipped())?.complement())
                    }
                    // `a R b` is the negation of `!a U !b`; so is a weak until whose first steps do not count.
                    UntilOperator::Release => {
                        let event = PathEvent { safe: left.not(), goal: right.not(), first, last };
                        Ok(self.event(&event, resolution.flipped())?.complement())
                    }
                    UntilOperator::Weak => Err(crate::property::PropertyError::LateWeakUntil.into()),
                };
            }
            _ => {}
        }
        let mut propositions = vec![];
        let formula = self.formula(path, &mut propositions)?;
        self.omega(&formula, &propositions, resolution)
    }

    fn next(&mut self, goal: &Truth, resolution: Resolution) -> Result<Known, EvaluationError> {
        let (model, options) = (self.model, self.options);
        let next = |goal| Event::Next { goal };
        self.between(goal.is_exact(), &mut |this: &mut Self, certain| {
            let goal = if certain { &goal.must } else { &goal.may };
            this.solved((model, &options), &next(goal), 0, resolution)
        })
    }

    fn event(&mut self, event: &PathEvent, resolution: Resolution) -> Result<Known, EvaluationError> {
        let (model, options) = (self.model, self.options);
        let PathEvent { safe, goal, first, last } = event;
        self.between(safe.is_exact() && goal.is_exact(), &mut |this: &mut Self, certain| {
            let (safe, goal) = if certain { (&safe.must, &goal.must) } else { (&safe.may, &goal.may) };
            let steps = last.map(|last| last.saturating_sub(*first));
            this.solved((model, &options), &Event::Until { safe, goal, steps }, *first, resolution)
        })
    }

    /// Bounds from the states that an event is about for certain, and from those that it may be about: more safe states and
    /// more goal states make it more probable.
    fn between(
        &mut self,
        is_exact: bool,
        solved: &mut dyn FnMut(&mut Self, bool) -> Result<Known, EvaluationError>,
    ) -> Result<Known, EvaluationError> {
        if is_exact {
            return solved(self, true);
        }
        let (lower, upper) = (solved(self, true)?, solved(self, false)?);
        Ok(Known::within(lower.bounds.lower, upper.bounds.upper))
    }

    /// What is known about the probability of an event that begins after so many steps in safe states.
    pub(super) fn solved(
        &mut self,
        (model, options): (&IntervalMdp, &SolverOptions<'_>),
        event: &Event<'_>,
        first: u64,
        resolution: Resolution,
    ) -> Result<Known, EvaluationError> {
        if let Some(checker) = &mut self.checker {
            let bounds = checker.event(model, event, first, resolution)?;
            return Ok(Known::within(bounds.lower, bounds.upper));
        }
        if let Some(wanted) = &self.exactly {
            let (lower, upper) = (vec![0.0; model.num_states()], vec![1.0; model.num_states()]);
            if self.extremes {
                let extremes = (first == 0).then(|| Extremes::new(model, event, resolution));
                let stand_in = |known: &Extremes| wanted.ones().map(|s| (s, known.stand_in(s))).collect();
                let exact = extremes.as_ref().map(stand_in).unwrap_or_default();
                return Ok(Known { exact, ..Known::within(lower, upper) });
            }
            let exact = exact_values(model, event, first, resolution, wanted, options);
            self.inexact = exact.as_ref().err().copied().or(self.inexact);
            return Ok(Known { exact: exact.unwrap_or_default(), ..Known::within(lower, upper) });
        }
        let solution = match *event {
            Event::Until { safe, goal, steps } if first > 0 => {
                let last = steps.map(|steps| steps.saturating_add(first));
                solve_delayed(model, (safe, goal), (first, last), resolution, options)?
            }
            _ => solve(model, event, resolution, options)?,
        };
        let values = self.note(solution);
        Ok(Known::within(values.lower, values.upper))
    }

    /// A path formula over propositions, which are collected.
    pub(super) fn formula(
        &mut self,
        node: &Node,
        propositions: &mut Vec<Truth>,
    ) -> Result<Ltl, EvaluationError> {
        if !is_path(node) {
            let truth = self.truth(node)?;
            let known = propositions.iter().position(|other| *other == truth);
            let index = known.unwrap_or_else(|| {
                propositions.push(truth);
                propositions.len() - 1
            });
            return Ok(Ltl::Proposition(index as u32));
        }
        if let NodeKind::Temporal(_, bounds, _) | NodeKind::Until(_, bounds, _) = &node.kind {
            let (first, last) = range(bounds);
            let found = last.map_or(first, |last| last.max(first));
            if found > MOST_UNFOLDED {
                return Err(LtlError::Steps { found, limit: MOST_UNFOLDED }.into());
            }
        }
        let mut boxed = |node: &Node, this: &mut Self| this.formula(node, propositions).map(Box::new);
        Ok(match &node.kind {
            NodeKind::Not(operand) => Ltl::Not(boxed(operand, self)?),
            NodeKind::And(operands) => Ltl::And(
                operands.iter().map(|node| self.formula(node, propositions)).collect::<Result<_, _>>()?,
            ),
            NodeKind::Or(operands) => Ltl::Or(
                operands.iter().map(|node| self.formula(node, propositions)).collect::<Result<_, _>>()?,
            ),
            NodeKind::Binary(operator, left, right) => {
                let (left, right) = (self.formula(left, propositions)?, self.formula(right, propositions)?);
                let not = |formula: &Ltl| Ltl::Not(Box::new(formula.clone()));
                match operator {
                    BinaryOperator::Implies => Ltl::Or(vec![not(&left), right]),
                    _ => Ltl::Or(vec![Ltl::And(vec![not(&left), not(&right)]), Ltl::And(vec![left, right])]),
                }
            }
            NodeKind::Temporal(operator, bounds, operand) => {
                let operand = self.formula(operand, propositions)?;
                temporal(*operator, bounds, operand)
            }
            NodeKind::Until(operator, bounds, operands) => {
                let left = self.formula(&operands[0], propositions)?;
                let right = self.formula(&operands[1], propositions)?;
                until(*operator, bounds, left, right)
            }
            _ => Ltl::True,
        })
    }
}

/// So many steps of a bound inside of LTL are unfolded at most.
const MOST_UNFOLDED: u64 = 256;

fn next(formula: Ltl, steps: u64) -> Ltl {
    (0..steps).fold(formula, |formula, _| Ltl::Next(Box::new(formula)))
}

/// `F`, `G` and `X`, with bounds unfolded.
fn temporal(operator: TemporalOperator, bounds: &StepBounds, operand: Ltl) -> Ltl {
    let (first, last) = range(bounds);
    let inside = match (operator, last) {
        (TemporalOperator::Next, _) => Ltl::Next(Box::new(operand)),
        (TemporalOperator::Finally, None) => Ltl::Finally(Box::new(operand)),
        (TemporalOperator::Globally, None) => Ltl::Globally(Box::new(operand)),
        (TemporalOperator::Finally, Some(last)) => (first..last)
            .fold(operand.clone(), |formula, _| Ltl::Or(vec![operand.clone(), Ltl::Next(Box::new(formula))])),
        (TemporalOperator::Globally, Some(last)) => (first..last).fold(operand.clone(), |formula, _| {
            Ltl::And(vec![operand.clone(), Ltl::Next(Box::new(formula))])
        }),
    };
    next(inside, first)
}

/// `U`, `W` and `R`, with bounds unfolded.
fn until(operator: UntilOperator, bounds: &StepBounds, left: Ltl, right: Ltl) -> Ltl {
    let (first, last) = range(bounds);
    let not = |formula: Ltl| Ltl::Not(Box::new(formula));
    match operator {
        UntilOperator::Release => not(until(UntilOperator::Until, bounds, not(left), not(right))),
        UntilOperator::Weak if bounds.is_none() => Ltl::Weak(Box::new(left), Box::new(right)),
        // `a W<=k b` is `a U<=k b` or `a` for so long.
        UntilOperator::Weak => Ltl::Or(vec![
            until(UntilOperator::Until, bounds, left.clone(), right),
            temporal(TemporalOperator::Globally, bounds, left),
        ]),
        UntilOperator::Until => {
            let inside = match last {
                None => Ltl::Until(Box::new(left.clone()), Box::new(right)),
                Some(last) => (first..last).fold(right.clone(), |formula, _| {
                    let later = Ltl::And(vec![left.clone(), Ltl::Next(Box::new(formula))]);
                    Ltl::Or(vec![right.clone(), later])
                }),
            };
            (0..first).fold(inside, |formula, _| Ltl::And(vec![left.clone(), Ltl::Next(Box::new(formula))]))
        }
    }
}
