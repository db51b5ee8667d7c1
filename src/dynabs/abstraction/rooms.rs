//! Actions that keep clear of what is unsafe only if there is room for the noise: targets with rows of their own.

use super::between::Clear;
use super::enabled::EnabledActions;
use super::room::{RUNGS, Room};
use super::targets::Targets;
use imdp::model::{RowId, RowRange};

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

impl Rooms {
    /// Gives every target a row of its own for each of its rooms, after those of the targets; the tightest rooms are left out
    /// if there are too many. A row has at most `row_length` entries.
    pub(super) fn new(clear: Clear, targets: &Targets, row_length: usize) -> (Self, Targets, EnabledActions) {
        let Clear { actions, mut with_room } = clear;
        let most = (ROWS_PER_TARGET * targets.len()).min(MOST_ENTRIES / row_length.max(1));
        let mut rows: Vec<(RowId, Room)> = vec![];
        for least in 0..=RUNGS.len() {
            with_room.retain(|(_, _, room)| room.least() >= Some(least));
            rows = with_room.iter().map(|&(_, target, room)| (target, room)).collect();
            rows.sort_unstable();
            rows.dedup();
            if rows.len() <= most {
                break;
            }
        }
        let mut distinct: Vec<Room> = rows.iter().map(|(_, room)| *room).collect();
        distinct.sort_unstable();
        distinct.dedup();
        let number = |room: &Room| distinct.partition_point(|other| other < room);
        let of_copy = rows.iter().map(|(_, room)| number(room)).collect();
        let again = rows.iter().map(|(target, _)| target.0).collect();
        let row_of = |target, room| {
            let copy = rows.partition_point(|&other| other < (target, room));
            RowId::from_index(targets.len() + copy)
        };
        if rows.is_empty() {
            return (Self::default(), targets.clone(), actions);
        }
        let mut all = EnabledActions::default();
        let (mut ranges, mut more) = (actions.ranges.iter(), with_room.iter().peekable());
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
