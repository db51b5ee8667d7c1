//! How many samples land in cells of each kind, counted along runs.

use super::super::cell_box::CellBox;
use super::super::cell_counts::{CellCounts, Count, RegionCounts};
use super::{Ground, Runs};
use imdp::model::StateId;

/// Samples that land in one cell for certain, in runs; and the others, which are few.
pub(in super::super) struct Hits {
    runs: Runs,
    /// By position in the runs.
    counts: Vec<Count>,
    /// The sum of those before each position, and of all.
    before: Vec<Count>,
    spread: Vec<(CellBox, Count)>,
}

impl Hits {
    /// Those of a landing.
    pub(in super::super) fn new(landing: &CellCounts, ground: &Ground) -> Self {
        let table = landing.table();
        let mut by_position = vec![Count::default(); table.volume()];
        let mut spread = vec![];
        for (cells, count) in landing.groups() {
            match cells.is_single() {
                true => by_position[table.position(&cells.lower)] = *count,
                false => spread.push((cells.clone(), *count)),
            }
        }
        let runs = Runs::new(table, ground, |position| by_position[position].possible > 0);
        let counts: Vec<Count> = by_position.into_iter().filter(|count| count.possible > 0).collect();
        let mut before = vec![Count::default()];
        for (i, count) in counts.iter().enumerate() {
            let mut sum = before[i];
            sum.add(count, true, true);
            before.push(sum);
        }
        Self { runs, counts, before, spread }
    }

    /// How many land in goal cells, and how many in lost cells or outside, with origin `origin`.
    pub(in super::super) fn in_regions(&self, ground: &Ground, origin: &[i32]) -> RegionCounts {
        let mut counts = RegionCounts::default();
        // Lost are all that are not found in other cells.
        counts.lost.add(&self.before[self.counts.len()], true, true);
        self.runs.for_each(ground, origin, |first, position, length| {
            counts.lost.add(&self.before[position], true, true);
            counts.lost.subtract(&self.before[position + length]);
            for (&state, count) in ground.states[first..first + length].iter().zip(&self.counts[position..]) {
                if !ground.lists(state) {
                    let own = if state == StateId(0) { &mut counts.lost } else { &mut counts.goal };
                    own.add(count, true, true);
                }
            }
        });
        for (cells, count) in &self.spread {
            let (mut goal, mut lost, mut all) = (0usize, 0usize, 0usize);
            cells.for_each(|cell| {
                all += 1;
                match ground.state(cell, origin) {
                    Some(state) if ground.lists(state) => {}
                    None | Some(StateId(0)) => lost += 1,
                    Some(_) => goal += 1,
                }
            });
            counts.goal.add(count, goal == all, goal > 0);
            counts.lost.add(count, lost == all, lost > 0);
        }
        counts
    }
}
