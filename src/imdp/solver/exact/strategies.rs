//! Optimal strategies of both sides and their exact values, without a bound on the steps.

use super::super::query::{Direction, Players};
use super::super::slow::{Elimination, Number, Process, WaysOut, ways_out};
use super::part::{Part, Row};
use super::work::{Inexact, Work, digits};
use crate::model::StateSet;
use crate::numeric::Rational;
use crate::numeric::common_multiple;
use num_bigint::BigUint;
use num_traits::{One, Zero};

/// What both sides do.
struct Strategies {
    /// By state, a row of the part.
    rows: Vec<u32>,
    /// By row, a distribution over the scale.
    masses: Vec<Vec<BigUint>>,
}

/// The least fixed point, every state of which is positive, and what the policy chooses.
///
/// Values outside are 1 in the `certain` states and 0 elsewhere.
pub(super) fn solve(
    part: &Part,
    certain: &StateSet,
    players: Players,
    work: &mut Work<'_>,
) -> Result<(Vec<Rational>, Vec<u32>), Inexact> {
    let promising: Vec<bool> = part.outside.iter().map(|&s| certain.contains(s.index())).collect();
    let all: Vec<_> = part.options.iter().map(|options| (&**options, players.policy)).collect();
    let WaysOut { choices, closeness } =
        ways_out(&all, &part.rows, &promising, players.nature).ok_or(Inexact::Unproved)?;
    let masses = part.rows.iter().map(|row| row.respond(&closeness, players.nature)).collect();
    let mut strategies = Strategies { rows: choices, masses };
    loop {
        let values = evaluate(part, &strategies, &promising, work)?;
        let common = Common::new(values, &promising, work)?;
        if !improve(part, &mut strategies, &common, players, Direction::Min, work)?
            && !improve(part, &mut strategies, &common, players, Direction::Max, work)?
        {
            prove(part, &strategies, &common, &promising, players)?;
            let choice = |(options, row): (&Vec<u32>, &u32)| options.iter().position(|option| option == row);
            let choices = part.options.iter().zip(&strategies.rows).map(choice);
            let choices = choices.map(|choice| choice.unwrap_or_default() as u32).collect();
            return Ok((common.values, choices));
        }
    }
}

/// Values over one denominator.
struct Common {
    values: Vec<Rational>,
    /// Of all states, then of what lies outside.
    numerators: Vec<BigUint>,
}

impl Common {
    fn new(values: Vec<Rational>, promising: &[bool], work: &mut Work<'_>) -> Result<Self, Inexact> {
        let mut denominator = BigUint::one();
        for value in &values {
            denominator = common_multiple(denominator, value.denom().magnitude());
            let size = digits(&denominator);
            work.spend(64 * size * size)?;
        }
        let numerator =
            |value: &Rational| value.numer().magnitude() * (&denominator / value.denom().magnitude());
        let mut numerators: Vec<BigUint> = values.iter().map(numerator).collect();
        let outside = |&one: &bool| if one { denominator.clone() } else { BigUint::zero() };
        numerators.extend(promising.iter().map(outside));
        Ok(Self { values, numerators })
    }
}

/// The values under strategies: `x = P x + r`.
fn evaluate(
    part: &Part,
    strategies: &Strategies,
    promising: &[bool],
    work: &mut Work<'_>,
) -> Result<Vec<Rational>, Inexact> {
    let states = part.states.len();
    let mut process = Process { rows: vec![], exits: vec![] };
    let mut right = vec![];
    for &id in &strategies.rows {
        let (mut entries, mut exit, mut won): (Vec<(u32, BigUint)>, _, _) =
            (vec![], BigUint::zero(), BigUint::zero());
        let masses = &strategies.masses[id as usize];
        for (&target, mass) in part.rows[id as usize].targets.iter().zip(masses) {
            match promising.get((target as usize).wrapping_sub(states)) {
                None => entries.push((target, mass.clone())),
                Some(&promising) => {
                    exit += mass;
                    won += if promising { mass.clone() } else { BigUint::zero() };
                }
            }
        }
        let probability = |mass: BigUint| Rational::new(mass.into(), part.scale.clone().into());
        entries.sort_unstable_by_key(|entry| entry.0);
        process.rows.push(entries.into_iter().map(|(target, mass)| (target, probability(mass))).collect());
        process.exits.push(probability(exit));
        right.push(probability(won));
    }
    work.spend(right.iter().map(Number::cost).sum())?;
    match Elimination::new(process, &mut work.left) {
        Some(equations) => Ok(equations.solve(right)),
        None if work.left == 0 => Err(Inexact::TooLarge),
        None => Err(Inexact::Unproved),
    }
}

/// Changes the strategy of one direction wherever that is strictly better; returns whether it is anywhere.
fn improve(
    part: &Part,
    strategies: &mut Strategies,
    common: &Common,
    players: Players,
    who: Direction,
    work: &mut Work<'_>,
) -> Result<bool, Inexact> {
    let values = &common.numerators;
    let width = values.iter().map(digits).max().unwrap_or(1);
    work.spend((part.entries() + part.rows.len() as u64) * width * digits(&part.scale))?;
    let better = |a: &BigUint, b: &BigUint| if who == Direction::Min { a < b } else { a > b };
    let (mut changed, mut weights) = (false, vec![]);
    for (row, masses) in part.rows.iter().zip(&mut strategies.masses) {
        let mut weight = row.expectation(masses, values);
        if players.nature == who {
            let response = row.respond(values, who);
            let other = row.expectation(&response, values);
            if better(&other, &weight) {
                (*masses, weight, changed) = (response, other, true);
            }
        }
        weights.push(weight);
    }
    if players.policy == who {
        for (options, row) in part.options.iter().zip(&mut strategies.rows) {
            for &option in options {
                if better(&weights[option as usize], &weights[*row as usize]) {
                    (*row, changed) = (option, true);
                }
            }
        }
    }
    Ok(changed)
}

/// Checks `T(x) = x`, and that the maximising sides leave the part whatever the minimising ones do.
fn prove(
    part: &Part,
    strategies: &Strategies,
    common: &Common,
    promising: &[bool],
    players: Players,
) -> Result<(), Inexact> {
    let values = &common.numerators;
    let weight = |row: &Row| row.expectation(&row.respond(values, players.nature), values);
    let weights: Vec<BigUint> = part.rows.iter().map(weight).collect();
    let of_state = |options: &Vec<u32>| {
        let weights = options.iter().map(|&row| &weights[row as usize]);
        if players.policy == Direction::Min { weights.min() } else { weights.max() }
    };
    let is_fixed = part
        .options
        .iter()
        .zip(values)
        .all(|(options, value)| of_state(options).is_some_and(|weight| *weight == value * &part.scale));
    let rows: Vec<Row> = match players.nature {
        Direction::Min => part.rows.clone(),
        Direction::Max => {
            part.rows.iter().zip(&strategies.masses).map(|(row, masses)| row.fixed(masses)).collect()
        }
    };
    let chosen: Vec<[u32; 1]> = strategies.rows.iter().map(|&row| [row]).collect();
    let options = |(all, chosen): (&'_ Vec<u32>, &'_ [u32; 1])| -> Vec<u32> {
        if players.policy == Direction::Min { all.clone() } else { chosen.to_vec() }
    };
    let options: Vec<Vec<u32>> = part.options.iter().zip(&chosen).map(options).collect();
    let options: Vec<_> = options.iter().map(|options| (&**options, players.policy)).collect();
    let leads_out = ways_out(&options, &rows, &vec![true; promising.len()], players.nature).is_some();
    (is_fixed && leads_out).then_some(()).ok_or(Inexact::Unproved)
}
