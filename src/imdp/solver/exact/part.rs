//! What can be reached from some states, with the bounds of its rows over one denominator.

use super::super::query::Direction;
use super::super::slow::Leads;
use super::work::{Inexact, Work, digits};
use crate::model::{ExactRow, Numerators};
use crate::model::{IntervalMdp, RowBuffer, RowId, StateId, StateSet};
use crate::numeric::common_multiple;
use num_bigint::BigUint;
use num_traits::{One, Zero};

/// What a bound costs beside its digits: it is stored with its state.
const ENTRY: u64 = 64;

/// States whose values depend on choices, and what they lead to.
pub(super) struct Part {
    /// Ascending.
    pub states: Vec<StateId>,
    /// By position, the rows to choose from; their order is that of the choices.
    pub options: Vec<Vec<u32>>,
    pub rows: Vec<Row>,
    /// What lies outside, ascending: its values are known.
    pub outside: Vec<StateId>,
    /// The denominator of all bounds.
    pub scale: BigUint,
}

/// Bounds `lower/scale` and `(lower + room)/scale`; `slack/scale` is left to be distributed.
#[derive(Clone)]
pub(super) struct Row {
    /// Positions: of states, then of what lies outside.
    pub targets: Vec<u32>,
    pub lower: Vec<BigUint>,
    pub room: Vec<BigUint>,
    pub slack: BigUint,
}

impl Part {
    /// What can be reached from the wanted states through moving ones.
    pub(super) fn new(
        model: &IntervalMdp,
        moving: &StateSet,
        wanted: &StateSet,
        work: &mut Work<'_>,
    ) -> Result<Self, Inexact> {
        let (mut known, mut outside) = (moving.clone(), StateSet::with_capacity(model.num_states()));
        known.intersect_with(wanted);
        let mut queue: Vec<StateId> = known.ones().map(StateId::from_index).collect();
        let mut taken = StateSet::with_capacity(model.rows().len());
        let mut found: Vec<(RowId, Numerators<BigUint>)> = vec![];
        while let Some(state) = queue.pop() {
            for row in model.choices().rows(state) {
                work.spend(ENTRY)?;
                if taken.put(row.index()) {
                    continue;
                }
                let buffer = &mut RowBuffer::default();
                let row_content = model.rows().row(row, buffer);
                let successors = row_content.successors;
                work.spend(ENTRY * successors.len() as u64)?;
                let exact = ExactRow::new(row_content).ok_or(Inexact::Unproved)?.into_numerators();
                for (_, &s) in successors.iter().enumerate().filter(|(i, _)| possible(&exact, *i)) {
                    match moving.contains(s.index()) {
                        false => outside.insert(s.index()),
                        true if known.put(s.index()) => {}
                        true => queue.push(s),
                    }
                }
                found.push((row, exact));
            }
        }
        found.sort_unstable_by_key(|(row, _)| *row);
        let mut scale = BigUint::one();
        for (_, exact) in &found {
            scale = common_multiple(scale, &exact.scale);
            work.spend(ENTRY * digits(&scale) * digits(&scale))?;
        }
        let list = |set: &StateSet| set.ones().map(StateId::from_index).collect::<Vec<_>>();
        let (states, outside) = (list(&known), list(&outside));
        let index = |row: RowId| found.binary_search_by_key(&row, |(row, _)| *row).map_or(0, |at| at as u32);
        let options = states.iter().map(|&s| model.choices().rows(s).map(index).collect()).collect();
        let mut part = Self { states, options, rows: vec![], outside, scale };
        for (row, exact) in &found {
            work.spend(exact.lower.len() as u64 * digits(&part.scale))?;
            let buffer = &mut RowBuffer::default();
            let row = part.row(model.rows().row(*row, buffer).successors, exact);
            part.rows.push(row);
        }
        Ok(part)
    }

    fn row(&self, successors: &[StateId], exact: &Numerators<BigUint>) -> Row {
        let factor = &self.scale / &exact.scale;
        let scaled = |number: &BigUint| number * &factor;
        let possible: Vec<usize> = (0..successors.len()).filter(|&i| possible(exact, i)).collect();
        Row {
            targets: possible.iter().map(|&i| self.target(successors[i])).collect(),
            lower: possible.iter().map(|&i| scaled(&exact.lower[i])).collect(),
            room: possible.iter().map(|&i| scaled(&exact.room[i])).collect(),
            slack: scaled(&exact.slack),
        }
    }

    /// The position of a state of the part.
    pub(super) fn position(&self, state: StateId) -> Option<usize> {
        self.states.binary_search(&state).ok()
    }

    /// All states that values are about: those of the part, then those outside.
    pub(super) fn all(&self) -> impl Iterator<Item = StateId> + '_ {
        self.states.iter().chain(&self.outside).copied()
    }

    fn target(&self, state: StateId) -> u32 {
        let outside = || self.states.len() + self.outside.binary_search(&state).unwrap_or_default();
        self.position(state).unwrap_or_else(outside) as u32
    }

    /// The number of bounds of all rows.
    pub(super) fn entries(&self) -> u64 {
        self.rows.iter().map(|row| row.targets.len() as u64).sum()
    }
}

/// Whether a successor can have any mass.
fn possible(row: &Numerators<BigUint>, i: usize) -> bool {
    !row.lower[i].is_zero() || !row.room[i].is_zero()
}

impl Row {
    /// A distribution, over the scale, that attains the optimum over values.
    pub(super) fn respond<V: Ord>(&self, values: &[V], nature: Direction) -> Vec<BigUint> {
        let value = |i: usize| &values[self.targets[i] as usize];
        let mut order: Vec<usize> = (0..self.targets.len()).collect();
        match nature {
            Direction::Min => order.sort_by(|&i, &j| value(i).cmp(value(j))),
            Direction::Max => order.sort_by(|&i, &j| value(j).cmp(value(i))),
        }
        let (mut masses, mut left) = (self.lower.clone(), self.slack.clone());
        for i in order {
            if left.is_zero() {
                break;
            }
            let poured = (&self.room[i]).min(&left).clone();
            masses[i] += &poured;
            left -= poured;
        }
        masses
    }

    /// `Σ p V` for masses over the scale.
    pub(super) fn expectation(&self, masses: &[BigUint], values: &[BigUint]) -> BigUint {
        self.targets.iter().zip(masses).map(|(&target, mass)| mass * &values[target as usize]).sum()
    }

    /// The row that has no other distribution than this one.
    pub(super) fn fixed(&self, masses: &[BigUint]) -> Self {
        let room = vec![BigUint::zero(); masses.len()];
        Self { targets: self.targets.clone(), lower: masses.to_vec(), room, slack: BigUint::zero() }
    }
}

impl Leads for Row {
    fn targets(&self) -> &[u32] {
        &self.targets
    }

    fn hits(&self, nature: Direction, inside: impl Fn(u32) -> bool) -> bool {
        let inside: Vec<bool> = self.targets.iter().map(|&target| inside(target)).collect();
        let within = || (0..inside.len()).filter(|&i| inside[i]);
        match nature {
            // All that is poured may go elsewhere, as far as there is room.
            Direction::Min => {
                let elsewhere: BigUint =
                    (0..inside.len()).filter(|&i| !inside[i]).map(|i| &self.room[i]).sum();
                within().any(|i| !self.lower[i].is_zero()) || (elsewhere < self.slack)
            }
            Direction::Max => within()
                .any(|i| !self.lower[i].is_zero() || (!self.room[i].is_zero() && !self.slack.is_zero())),
        }
    }
}
