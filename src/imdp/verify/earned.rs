//! What choices earn and lead to, exactly; perhaps infinite.

use super::masses::{Which, meets, without};
use super::one_step::ExactRows;
use super::{Rejection, Side};
use crate::exact::{ExactValues, Nature, Replaced};
use crate::model::{RewardStructure, RowBuffer, RowId, StateId};
use crate::numeric::{Rational, from_dyadic};
use num_traits::Zero;
use std::collections::BTreeMap;

/// Whole numbers below this are what was written.
const EXACT: f64 = (1u64 << 53) as f64;

/// Sums of numbers below this, and the powers of two above them, are finite doubles.
pub(super) const LARGEST: f64 = 1e300;

/// A reward as it was written, rounded to a side where the double may be another number.
pub(super) fn reading(value: f64, side: Side) -> f64 {
    match side {
        _ if value.fract() == 0.0 && value < EXACT => value,
        Side::Lower => value.next_down().max(0.0),
        Side::Upper => value.next_up(),
    }
}

/// A double as an exact number.
pub(super) fn exact(value: f64) -> Rational {
    from_dyadic(value).unwrap_or_default()
}

/// The values of the next step, and the expectations of rows as they are asked for.
pub(super) struct Outlook<'a> {
    rows: &'a ExactRows<'a>,
    rewards: &'a RewardStructure,
    nature: Nature,
    side: Side,
    discount: &'a Rational,
    /// By state; perhaps infinite.
    values: &'a [f64],
    /// Values are divided by this power of two, so that they are at most 1.
    scale: f64,
    scaled: Vec<f64>,
    replaced: Replaced,
    known: BTreeMap<RowId, Option<Rational>>,
    /// How many expectations were computed.
    pub evaluated: u64,
}

impl<'a> Outlook<'a> {
    pub(super) fn new(
        rows: &'a ExactRows<'a>,
        rewards: &'a RewardStructure,
        (nature, side): (Nature, Side),
        discount: &'a Rational,
        values: &'a [f64],
    ) -> Self {
        let finite = values.iter().copied().filter(|value| value.is_finite());
        let branches = rewards.branches.values().flatten().map(|&reward| reading(reward, side));
        let largest = finite.fold(0.0, f64::max) + branches.fold(0.0, f64::max);
        let mut scale: f64 = 1.0;
        while scale <= largest {
            scale *= 2.0;
        }
        let mut replaced = Replaced::new();
        let mut scaled = Vec::with_capacity(values.len());
        for (s, &value) in values.iter().enumerate() {
            let small = if value.is_finite() { value / scale } else { 0.0 };
            // Below the range of doubles, division loses digits.
            if value.is_finite() && small * scale != value {
                replaced.insert(StateId::from_index(s), exact(value) / exact(scale));
            }
            scaled.push(small);
        }
        let known = BTreeMap::new();
        Self { rows, rewards, nature, side, discount, values, scale, scaled, replaced, known, evaluated: 0 }
    }

    /// What a choice leads to, as it is worth today: `opt_p p·(γ V + rewards of branches)`; `None` if it is infinite.
    pub(super) fn of_choice(&mut self, choice: u64, row: RowId) -> Result<Option<Rational>, Rejection> {
        if let Some(of_branches) = self.rewards.branches.get(&choice) {
            let values = &self.values;
            let buffer = &mut RowBuffer::default();
            let successors = self.rows.model.rows().row(row, buffer).successors;
            let value = |(&s, &reward): (&StateId, &f64)| match values[s.index()].is_finite() {
                true => exact(values[s.index()]) * self.discount + exact(reading(reward, self.side)),
                false => Rational::zero(),
            };
            let own: Vec<Rational> = successors.iter().zip(of_branches).map(value).collect();
            return self.expectation(row, Some(&own));
        }
        if let Some(known) = self.known.get(&row) {
            return Ok(known.clone());
        }
        let found = self.expectation(row, None)?.map(|later| later * self.discount);
        self.known.insert(row, found.clone());
        Ok(found)
    }

    /// The expectation of a row; `own` are values by position in place of those of the successors.
    fn expectation(&mut self, id: RowId, own: Option<&[Rational]>) -> Result<Option<Rational>, Rejection> {
        self.evaluated += 1;
        let buffer = &mut RowBuffer::default();
        let row = self.rows.model.rows().row(id, buffer);
        let exact_row = self.rows.get(id)?;
        let infinite: Vec<bool> =
            row.successors.iter().map(|s| !self.values[s.index()].is_finite()).collect();
        let positions: Vec<StateId> = StateId::first(row.len()).collect();
        let mut left_out = None;
        if infinite.contains(&true) {
            let which = if self.nature == Nature::Min { Which::Every } else { Which::Some };
            let unavoidable = meets(exact_row, &infinite, which);
            if unavoidable {
                return Ok(None);
            }
            left_out = Some(without(row, &infinite).ok_or(Rejection::NoDistribution { row: id })?);
        }
        let exact_row = left_out.as_ref().unwrap_or(exact_row);
        // Only the values of this row are needed.
        let (mut doubles, mut replaced) = (vec![0.0; row.len()], Replaced::new());
        for (position, &successor) in positions.iter().zip(row.successors) {
            match (own, self.replaced.get(&successor)) {
                (Some(own), _) => {
                    let value = own[position.index()].clone() / exact(self.scale);
                    replaced.insert(*position, value);
                }
                (None, Some(value)) => {
                    replaced.insert(*position, value.clone());
                }
                (None, None) => doubles[position.index()] = self.scaled[successor.index()],
            }
        }
        let values = ExactValues::with(&doubles, &replaced);
        let raw = exact_row.expectation(&positions, &values, self.nature);
        Ok(Some(Rational::new(raw.numer().clone(), raw.denom().clone()) * exact(self.scale)))
    }
}

/// What a state and one of its choices earn, whatever comes of it.
pub(super) fn earned(rewards: &RewardStructure, state: usize, choice: Option<u64>, side: Side) -> Rational {
    let of_choice = choice.map_or(0.0, |choice| rewards.of_choice(choice));
    exact(reading(rewards.of_state(state), side)) + exact(reading(of_choice, side))
}
