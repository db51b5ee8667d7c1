//! Exact value iteration.

use super::super::policy::NO_CHOICE;
use super::super::query::{Direction, Players};
use super::part::Part;
use super::work::{Inexact, Work, digits};
use crate::model::StateId;
use crate::numeric::Rational;
use crate::numeric::common_multiple;
use num_bigint::BigUint;
use num_traits::{One, Zero};

/// What a digit that is kept costs: more memory than time.
const KEPT: u64 = 32;

/// Values with some number of steps left, and what the policy does then.
#[derive(Clone)]
pub(super) struct Level {
    /// Numerators: of the part's states, then of what lies outside.
    numerators: Vec<BigUint>,
    denominator: BigUint,
    /// By state of the part.
    pub choices: Vec<u32>,
}

impl Level {
    /// Values of the part's states and of what lies outside, before the first step.
    pub(super) fn of_rationals(values: Vec<Rational>) -> Self {
        let denominators = values.iter().map(|value| value.denom().magnitude());
        let denominator = denominators.fold(BigUint::one(), common_multiple);
        let numerator =
            |value: &Rational| value.numer().magnitude() * (&denominator / value.denom().magnitude());
        Self { numerators: values.iter().map(numerator).collect(), choices: vec![], denominator }
    }

    /// Makes the values of some states outside of the part 0.
    pub(super) fn lose_outside(&mut self, part: &Part, lost: impl Fn(StateId) -> bool) {
        let outside = self.numerators[part.states.len()..].iter_mut().zip(&part.outside);
        outside.filter(|(_, state)| lost(**state)).for_each(|(numerator, _)| numerator.set_zero());
    }

    /// The values of the first `count` states.
    pub(super) fn rationals(&self, count: usize) -> Vec<Rational> {
        let value = |n: &BigUint| Rational::new(n.clone().into(), self.denominator.clone().into());
        self.numerators[..count].iter().map(value).collect()
    }
}

/// The values after so many steps from the given ones, and those with fewer steps, if wanted, as long as they change.
///
pub(super) fn iterate(
    part: &Part,
    mut level: Level,
    steps: u64,
    players: Players,
    record: bool,
    work: &mut Work<'_>,
) -> Result<(Level, Vec<Level>), Inexact> {
    let count = part.states.len();
    level.choices = vec![NO_CHOICE; count];
    let mut levels = vec![];
    let entries = part.entries() + part.rows.len() as u64 + 1;
    for _ in 0..steps {
        let width = digits(&level.denominator);
        work.spend(entries * width * digits(&part.scale))?;
        let weights: Vec<BigUint> = part
            .rows
            .iter()
            .map(|row| row.expectation(&row.respond(&level.numerators, players.nature), &level.numerators))
            .collect();
        let mut numerators: Vec<BigUint> = Vec::with_capacity(level.numerators.len());
        let mut choices = level.choices.clone();
        for (options, choice) in part.options.iter().zip(&mut choices) {
            let weight = |option: usize| &weights[options[option] as usize];
            let better = |option: usize, than: usize| match players.policy {
                Direction::Min => weight(option) < weight(than),
                Direction::Max => weight(option) > weight(than),
            };
            // The choice stays where it is as good as any.
            let mut best = if *choice == NO_CHOICE { 0 } else { *choice as usize };
            for option in 0..options.len() {
                best = if better(option, best) { option } else { best };
            }
            *choice = best as u32;
            numerators.push(weight(best).clone());
        }
        numerators.extend(level.numerators[count..].iter().map(|n| n * &part.scale));
        let is_same =
            level.numerators[..count].iter().zip(&numerators).all(|(old, new)| old * &part.scale == *new);
        level = Level { numerators, denominator: level.denominator * &part.scale, choices };
        if record {
            work.spend(KEPT * (count as u64 + 1) * width)?;
            levels.push(level.clone());
        }
        if is_same {
            break;
        }
    }
    Ok((level, levels))
}
