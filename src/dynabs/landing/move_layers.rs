//! The moves of a stencil as states of an interval MDP: places, and boxes that nature picks a place from.

use super::moves::Move;
use super::picks::push_any;
use imdp::model::{Rows, StateId};
use std::collections::BTreeMap;

/// By coordinate, where a box begins in an array and how many places it has.
type Part = Vec<(usize, usize)>;

/// The states of one move: those of the places it begins at, then those of the boxes that it leads to.
#[derive(Debug)]
pub(super) struct MoveLayer<'a> {
    of: &'a Move,
    first: usize,
    boxes: BTreeMap<Part, usize>,
}

impl<'a> MoveLayer<'a> {
    /// The states of a move, numbered from `first`.
    pub(super) fn new(of: &'a Move, first: usize) -> Self {
        let mut boxes = BTreeMap::new();
        each(of, |place| {
            (0..of.taps.len()).for_each(|tap| {
                boxes.entry(part(of, place, tap)).or_insert(0);
            });
        });
        boxes.values_mut().enumerate().for_each(|(index, number)| *number = index);
        Self { of, first, boxes }
    }

    fn places(&self) -> usize {
        self.of.from.iter().map(|span| span.len).product()
    }

    /// The state after the last one.
    pub(super) fn end(&self) -> usize {
        self.first + self.places() + self.boxes.len()
    }

    /// The state of a place, given by indices.
    pub(super) fn of_place(&self, place: &[usize]) -> StateId {
        let flat = self.of.from.iter().zip(place).fold(0, |at, (span, place)| at * span.len + place);
        StateId::from_index(self.first + flat)
    }

    /// Adds the rows of all states, in their order; `then` has the state of a place after the move.
    pub(super) fn push_rows(&self, rows: &mut Rows, lost: StateId, then: impl Fn(&[usize]) -> StateId) {
        let first_box = self.first + self.places();
        each(self.of, |place| {
            let mut entries: BTreeMap<usize, (f64, f64)> = BTreeMap::new();
            for (tap, upper) in self.of.uppers.iter().enumerate() {
                let number = self.boxes.get(&part(self.of, place, tap)).copied().unwrap_or_default();
                let lower = self.of.taps[tap].lower;
                match entries.get_mut(&number) {
                    None => {
                        entries.insert(number, (lower, *upper));
                    }
                    Some(entry) => {
                        entry.0 = if lower > 0.0 { (entry.0 + lower).next_down() } else { entry.0 };
                        entry.1 = (entry.1 + upper).next_up().min(1.0);
                    }
                }
            }
            if self.of.elsewhere > 0.0 {
                rows.push_entry(lost, 0.0, self.of.elsewhere.min(1.0));
            }
            for (number, (lower, upper)) in entries {
                rows.push_entry(StateId::from_index(first_box + number), lower, upper);
            }
            rows.finish_row();
        });
        for part in self.boxes.keys() {
            let count: usize = part.iter().map(|(_, count)| count).product();
            let place = |mut index: usize| {
                let mut place = vec![0; part.len()];
                for (j, &(first, count)) in part.iter().enumerate().rev() {
                    place[j] = (first + index % count) % self.of.to[j].len;
                    index /= count;
                }
                then(&place)
            };
            push_any(rows, (0..count).map(place).collect());
        }
    }
}

/// Where a tap leads from a place, given by indices.
fn part(of: &Move, place: &[usize], tap: usize) -> Part {
    let tap = &of.taps[tap];
    let along = |j: usize| {
        let position = of.from[j].first + place[j] as i64 + tap.first[j];
        of.to[j].part(position, tap.size[j])
    };
    (0..place.len()).map(along).collect()
}

/// All places that a move begins at, row-major.
fn each(of: &Move, mut visit: impl FnMut(&[usize])) {
    let mut place = vec![0; of.from.len()];
    for _ in 0..of.from.iter().map(|span| span.len).product::<usize>() {
        visit(&place);
        for j in (0..place.len()).rev() {
            place[j] += 1;
            if place[j] < of.from[j].len {
                break;
            }
            place[j] = 0;
        }
    }
}
