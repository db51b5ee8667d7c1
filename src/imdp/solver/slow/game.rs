//! A cyclic part in fixed point, and strategies for it that are optimal up to rounding.
//!
//! Once both sides have chosen, what is left is a process that is left almost surely, and its values are the solution
//! of linear equations (`elimination`), made accurate to the last unit by iterated refinement. The minimising sides
//! answer the maximising ones optimally, then those improve, and so on (Hoffman and Karp): values only rise from
//! round to round, and a strategy that leads out is only replaced where that is strictly better, so by one that leads
//! out too.

use super::super::query::Direction;
use super::elimination::{Elimination, Process};
use super::fixed::ONE;
use super::fixed_row::FixedRow;
use super::ways_out::{WaysOut, ways_out};

/// Advantages of so few units are no reason to change a strategy.
const TOLERANCE: u128 = 16;

/// Equations are solved when no state misses its value by more units.
const RESIDUAL: u128 = 4;

/// Refinements of a solution, each worth about ten digits.
const REFINEMENTS: usize = 8;

/// Few rounds are needed as a rule; there could be as many as strategies.
const ROUNDS: usize = 1000;

/// A state, or an end component that is one for the side that can move in it at will.
#[derive(Debug)]
pub(super) struct Node {
    /// The rows to choose from.
    pub options: Vec<u32>,
    /// Who chooses.
    pub optimum: Direction,
    /// By how many units its value must be on the safe side of what its row says.
    pub offset: u128,
}

/// Nodes, and values outside.
#[derive(Debug)]
pub(super) struct Game {
    pub nature: Direction,
    pub nodes: Vec<Node>,
    pub rows: Vec<FixedRow>,
    /// The values of what is reached outside; a target `nodes + i` has `outside[i]`.
    pub outside: Vec<u128>,
    /// Whether values are to be raised by the offsets, or lowered.
    pub raised: bool,
    /// The multiplications allowed for one solution of the equations.
    pub budget: u64,
}

/// What both sides do.
#[derive(Clone, Debug)]
pub(super) struct Strategy {
    /// The row of every node.
    pub choices: Vec<u32>,
    /// The distribution of every row, in units.
    masses: Vec<Vec<u128>>,
}

impl Game {
    /// Optimal strategies and their values, those of the outside at the end; `None` if there is no way to find them.
    pub(super) fn solve(&self, stop: &dyn Fn() -> bool) -> Option<(Strategy, Vec<u128>)> {
        let mut strategy = self.ways_out()?;
        for _ in 0..ROUNDS {
            if stop() {
                return None;
            }
            let values = self.evaluate(&strategy)?;
            if !self.improve(&mut strategy, &values, Direction::Min)
                && !self.improve(&mut strategy, &values, Direction::Max)
            {
                return Some((strategy, values));
            }
        }
        None
    }

    /// A strategy by which the maximising sides lead out, whatever the minimising ones do.
    fn ways_out(&self) -> Option<Strategy> {
        let states: Vec<_> = self.nodes.iter().map(|node| (&*node.options, node.optimum)).collect();
        let promising: Vec<bool> = self.outside.iter().map(|&value| value > 0).collect();
        let WaysOut { choices, closeness } = ways_out(&states, &self.rows, &promising, self.nature)?;
        let masses = self.rows.iter().map(|row| row.respond(&closeness, self.nature)).collect();
        Some(Strategy { choices, masses })
    }

    /// The values under a strategy: `x = P x ± offset` within nodes, up to [`RESIDUAL`], but never less than 0.
    fn evaluate(&self, strategy: &Strategy) -> Option<Vec<u128>> {
        let nodes = self.nodes.len();
        // Where the offsets eat up everything, 0 is a lower bound: such nodes count as outside.
        let mut lost = vec![false; nodes];
        for _ in 0..ROUNDS {
            let equations = Elimination::new(self.process(strategy, &lost), &mut self.budget.clone())?;
            let mut values = vec![0; nodes];
            values.extend(&self.outside);
            let before = lost.clone();
            for _ in 0..=REFINEMENTS {
                let residual: Vec<i128> = (0..nodes)
                    .map(|i| if lost[i] { 0 } else { self.residual(i, strategy, &values) })
                    .collect();
                if residual.iter().all(|r| r.unsigned_abs() <= RESIDUAL) {
                    return Some(values);
                }
                let correction = equations.solve(residual.iter().map(|&r| r as f64).collect());
                for (i, change) in correction.into_iter().enumerate().filter(|(i, _)| !before[*i]) {
                    if change.is_nan() || change > 2.0 * ONE as f64 {
                        return None;
                    }
                    let value = values[i] as i128 + change.max(-2.0 * ONE as f64) as i128;
                    lost[i] |= value < 0;
                    values[i] = value.clamp(0, 2 * ONE as i128) as u128;
                }
                if lost != before {
                    break;
                }
            }
            if lost == before {
                return None;
            }
        }
        None
    }

    /// How many units are missing to `P x ± offset` in a node.
    fn residual(&self, node: usize, strategy: &Strategy, values: &[u128]) -> i128 {
        let row = strategy.choices[node] as usize;
        let sum = self.rows[row].expectation(&strategy.masses[row], values).floor() as i128;
        let offset = self.nodes[node].offset as i128;
        if self.raised { sum + offset - values[node] as i128 } else { sum - offset - values[node] as i128 }
    }

    fn process(&self, strategy: &Strategy, lost: &[bool]) -> Process<f64> {
        let mut process = Process { rows: vec![], exits: vec![] };
        for (&id, &is_lost) in strategy.choices.iter().zip(lost) {
            let (row, masses) = (&self.rows[id as usize], &strategy.masses[id as usize]);
            let (mut entries, mut exit): (Vec<(u32, u128)>, u128) = (vec![], 0);
            for (&target, &mass) in row.targets.iter().zip(masses) {
                if is_lost || lost.get(target as usize).is_none_or(|&lost| lost) {
                    exit += mass;
                } else {
                    entries.push((target, mass));
                }
            }
            entries.sort_unstable();
            entries.dedup_by(|next, kept| {
                let same = next.0 == kept.0;
                kept.1 += if same { next.1 } else { 0 };
                same
            });
            let probability = |mass: u128| mass as f64 / ONE as f64;
            process
                .rows
                .push(entries.into_iter().map(|(target, mass)| (target, probability(mass))).collect());
            process.exits.push(probability(exit));
        }
        process
    }

    /// Changes the strategy of one direction wherever that is strictly better; returns whether it is anywhere.
    fn improve(&self, strategy: &mut Strategy, values: &[u128], who: Direction) -> bool {
        let better = |a: u128, b: u128| match who {
            Direction::Min => a + TOLERANCE < b,
            Direction::Max => a > b + TOLERANCE,
        };
        let mut responded = vec![false; self.rows.len()];
        let mut weights = Vec::with_capacity(self.rows.len());
        for (i, row) in self.rows.iter().enumerate() {
            let mut weight = row.expectation(&strategy.masses[i], values).floor();
            if self.nature == who {
                let response = row.respond(values, who);
                let other = row.expectation(&response, values).floor();
                if better(other, weight) {
                    (strategy.masses[i], weight, responded[i]) = (response, other, true);
                }
            }
            weights.push(weight);
        }
        let mut changed = false;
        for (i, node) in (0..).zip(&self.nodes) {
            let choice = &mut strategy.choices[i as usize];
            changed |= responded[*choice as usize];
            if node.optimum != who {
                continue;
            }
            for &option in &node.options {
                // Who stays in an end component for ever gains nothing.
                let stays = |id: u32| {
                    let row = &self.rows[id as usize];
                    let entries = row.targets.iter().zip(&strategy.masses[id as usize]);
                    entries.filter(|(_, mass)| **mass > 0).all(|(&target, _)| target == i)
                };
                if better(weights[option as usize], weights[*choice as usize]) && !stays(option) {
                    *choice = option;
                    changed = true;
                }
            }
        }
        changed
    }
}
