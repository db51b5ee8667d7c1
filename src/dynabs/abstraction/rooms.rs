//! Actions that keep clear of what is unsafe only if there is room for the noise: targets with rows of their own.

use super::enabled::EnabledActions;
use super::room::{RUNGS, Room};
use super::targets::Targets;
use imdp::model::{RowId, RowRange};
use std::collections::HashSet;

/// There are at most so many rows with a room for every target,
const ROWS_PER_TARGET: usize = 16;

/// with so many entries in all.
const MOST_ENTRIES: usize = 1 << 22;

/// The rooms that rows are made with.
#[derive(Clone, Debug, Default)]
pub(super) struct Rooms {
    /// All of them, ascending.
    pub(super) distinct: Vec<Room>,
    /// Per target that stands there again, the number of its room.
    pub(super) of_copy: Vec<usize>,
}

/// Cells with actions that need a room, found little by little.
///
/// As soon as there are too many different rows, the tightest rooms are left out.
pub(super) struct Needed {
    most_rows: usize,
    /// Rooms with a limit below this rung are left out.
    least: usize,
    /// Number of the cell, target and room, ascending by cell and target.
    of_cells: Vec<(u32, RowId, Room)>,
    rows: HashSet<(RowId, Room)>,
}

impl Needed {
    /// None yet; a row has at most `row_length` entries.
    pub(super) fn new(targets: &Targets, row_length: usize) -> Self {
        let most_rows = (ROWS_PER_TARGET * targets.len()).min(MOST_ENTRIES / row_length.max(1));
        Self { most_rows, least: 0, of_cells: vec![], rows: HashSet::new() }
    }

    /// The least rung that a room may be limited to; none if there is no room for any more.
    pub(super) fn least(&self) -> Option<usize> {
        Some(self.least).filter(|&least| least < RUNGS.len())
    }

    /// Adds what further cells need; what needs no limit at all has no row of its own.
    pub(super) fn add(&mut self, of_cells: Vec<(u32, RowId, Room)>) {
        let is_left = |least, room: &Room| room.least() >= Some(least);
        for (cell, target, room) in of_cells {
            if is_left(self.least, &room) {
                self.of_cells.push((cell, target, room));
                self.rows.insert((target, room));
            }
        }
        while self.rows.len() > self.most_rows {
            self.least += 1;
            self.rows.retain(|(_, room)| is_left(self.least, room));
            self.of_cells.retain(|(_, _, room)| is_left(self.least, room));
        }
    }
}

impl Rooms {
    /// Gives every target a row of its own for each of its rooms, after those of the targets.
    pub(super) fn new(
        actions: EnabledActions,
        needed: Needed,
        targets: &Targets,
    ) -> (Self, Targets, EnabledActions) {
        let mut rows: Vec<(RowId, Room)> = needed.rows.iter().copied().collect();
        rows.sort_unstable();
        let mut distinct: Vec<Room> = rows.iter().map(|(_, room)| *room).collect();
        distinct.sort_unstable();
        distinct.dedup();
        let number = |room: &Room| distinct.partition_point(|other| other < room);
        let of_copy = rows.iter().map(|(_, room)| number(room)).collect();
        let again = rows.iter().map(|(row, _)| targets.of_row(*row).1).collect();
        let row_of = |target, room| {
            let copy = rows.partition_point(|&other| other < (target, room));
            RowId::from_index(targets.len() + copy)
        };
        if rows.is_empty() {
            return (Self::default(), targets.clone(), actions);
        }
        let mut all = EnabledActions::default();
        let (mut ranges, mut more) = (actions.ranges.iter(), needed.of_cells.iter().peekable());
        for (cell, &number) in actions.ranges_per_cell.iter().enumerate() {
            let before = all.ranges.len();
            all.ranges.extend(ranges.by_ref().take(number as usize));
            while let Some(&(_, target, room)) = more.next_if(|(of, ..)| *of as usize == cell) {
                let row = row_of(target, room);
                match all.ranges[before..].last_mut() {
                    Some(previous) if previous.last.next() == row => previous.last = row,
                    _ => all.ranges.push(RowRange { first: row, last: row }),
                }
            }
            all.ranges_per_cell.push((all.ranges.len() - before) as u32);
        }
        (Self { distinct, of_copy }, targets.standing_again(again), all)
    }
}
