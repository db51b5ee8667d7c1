//! How much room noise has between the steps of a group before something unsafe is met.

/// How far a limit lies from the center of the noise so far, in its standard deviations by the samples that decide about
/// proportions: coarse, so that there are few events, and chosen in advance.
pub(super) const RUNGS: [f64; 6] = [1.0, 1.5, 2.0, 2.5, 3.0, 4.0];

/// The most dimensions that limits are kept for.
pub(super) const MOST_DIMENSIONS: usize = 8;

/// Limits on the noise so far, the same at every step in between: per side, a rung of the ladder, or none.
///
/// Side `2j` is below the center in dimension `j`, side `2j + 1` above.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Room {
    /// Four bits a side: the rung counted from 1, 0 for no limit.
    sides: u64,
}

impl Room {
    /// The rung that limits a side, if one does.
    pub(super) fn limit(self, side: usize) -> Option<usize> {
        ((self.sides >> (4 * side) & 15) as usize).checked_sub(1)
    }

    /// This room with at most a rung to a side.
    pub(super) fn limited(self, side: usize, rung: usize) -> Self {
        let rung = self.limit(side).map_or(rung, |limit| limit.min(rung)) as u64;
        Self { sides: self.sides & !(15 << (4 * side)) | (rung + 1) << (4 * side) }
    }

    /// How many sides are limited.
    pub(super) fn num_limits(self) -> usize {
        (0..2 * MOST_DIMENSIONS).filter(|&side| self.limit(side).is_some()).count()
    }

    /// The least rung, if there is a limit.
    pub(super) fn least(self) -> Option<usize> {
        (0..2 * MOST_DIMENSIONS).filter_map(|side| self.limit(side)).min()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_only_tighten() {
        let room = Room::default().limited(3, 4).limited(15, 2).limited(3, 5).limited(15, 0);
        assert_eq!((room.limit(3), room.limit(15), room.limit(0)), (Some(4), Some(0), None));
        assert_eq!((room.num_limits(), room.least()), (2, Some(0)));
        assert_eq!(Room::default().least(), None);
    }
}
