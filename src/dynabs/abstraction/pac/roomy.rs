//! The bounds of rows for noise that has to stay in a room between the steps of a group.

use super::super::action_counts::ActionCounts;
use super::super::room::Room;
use super::bounds::DIGITS;
use super::events::squared_distances;
use super::prepared::Prepared;
use crate::noise::NoiseSamples;
use crate::statistics::{lower_bound, upper_bound};
use imdp::numeric::{round_decimal_down, round_decimal_up};
use std::collections::HashMap;
use std::sync::Arc;

/// The bounds that rows with a room are made with.
pub(super) struct RoomBounds {
    /// Of the cells of the landing's table, from below, of those that stay in the room; bounds from above are those of all.
    pub(super) lower: Arc<[f64]>,
    /// How much noise leaves the room at most.
    pub(super) leaving: f64,
}

impl RoomBounds {
    /// Counts the samples that stay in a room.
    pub(super) fn new(
        room: Room,
        prepared: &Prepared,
        landings: &ActionCounts<'_>,
        between: &[NoiseSamples],
    ) -> Option<Self> {
        let depths = prepared.windows.depths_in(room, between);
        let landing = landings.with_depths(&depths)?;
        let number = prepared.windows.independent();
        let origin = vec![0; landing.table().lower.len()];
        let squares = squared_distances(landing.table(), &origin);
        let mut known: HashMap<(u32, u64), f64> = HashMap::new();
        let lower = landing.counts().iter().zip(squares).map(|(count, square)| {
            let certain = count.certain[0];
            *known.entry((certain, square)).or_insert_with(|| {
                let level = prepared.levels.cell_in_room(square, room);
                round_decimal_down(lower_bound(certain.into(), number, level), DIGITS)
            })
        });
        let stay = depths.iter().filter(|&&depth| depth > 0).count() as u64;
        let leaving = upper_bound(number - stay, number, prepared.levels.leaving(room));
        Some(Self { lower: lower.collect(), leaving: round_decimal_up(leaving, DIGITS).min(1.0) })
    }
}
