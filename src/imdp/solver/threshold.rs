//! Up to which value the slack of a row is poured.

use crate::model::Row;

/// How many sums are interleaved; they are added up in the same way whatever the threshold.
const LANES: usize = 4;

/// So often the next value is tried before the middle one of all that are left.
const NEIGHBOURS: u32 = 2;

/// What pouring slack into a row comes to.
pub(super) struct Threshold {
    /// The share of the expectation that was poured.
    pub(super) poured: f64,
    /// The slack that found no room.
    pub(super) left: f64,
}

/// The values of a row's successors, and room to select from them.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    pub(super) values: Vec<f64>,
    open: Vec<f64>,
}

/// Sums over the successors whose values come before a threshold.
struct Before {
    /// Of their room `u − l`.
    room: f64,
    /// Of the room of those at the threshold as well.
    room_with: f64,
    /// Of their room times value.
    share: f64,
}

impl Threshold {
    /// Pours `slack` into a row with such values, those that come `before` others first.
    ///
    /// `critical` is the position of the last one in the last iteration, and is replaced by the present one.
    pub(super) fn find(
        row: Row<'_>,
        Scratch { values, open }: &mut Scratch,
        slack: f64,
        critical: &mut u32,
        before: impl Fn(f64, f64) -> bool + Copy,
    ) -> Self {
        let first_guess = values[(*critical as usize).min(values.len() - 1)];
        let mut guess = first_guess;
        // The threshold comes after the one and before the other.
        let (mut too_early, mut too_late) = (None, None);
        let mut round = 0;
        let sums = loop {
            let sums = Before::new(row, values, guess, before);
            // Rounding keeps sums monotone, so where there is too much room there is an earlier value.
            let is_late = sums.room > slack;
            if !is_late && sums.room_with >= slack {
                break sums;
            }
            *(if is_late { &mut too_late } else { &mut too_early }) = Some(guess);
            open.clear();
            open.extend(values.iter().copied().filter(|&value| {
                too_early.is_none_or(|bound| before(bound, value))
                    && too_late.is_none_or(|bound| before(value, bound))
            }));
            let nearest = |a: f64, b: f64| if before(a, b) == is_late { b } else { a };
            guess = match open.len() {
                // All room is too little.
                0 => break sums,
                _ if round < NEIGHBOURS => open.iter().copied().fold(open[0], nearest),
                number => *open.select_nth_unstable_by(number / 2, f64::total_cmp).1,
            };
            round += 1;
        };
        if guess != first_guess
            && let Some(position) = values.iter().position(|&value| value == guess)
        {
            *critical = position as u32;
        }
        let left = (slack - sums.room_with).max(0.0);
        let at_threshold = slack.min(sums.room_with) - sums.room;
        Self { poured: sums.share + at_threshold.max(0.0) * guess, left }
    }
}

impl Before {
    fn new(row: Row<'_>, values: &[f64], threshold: f64, before: impl Fn(f64, f64) -> bool) -> Self {
        let (mut room, mut room_with, mut share) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        let mut add = |lane: usize, value: f64, lower: f64, upper: f64| {
            let own = upper - lower;
            let inside = if before(value, threshold) { own } else { 0.0 };
            room[lane] += inside;
            share[lane] += inside * value;
            room_with[lane] += if before(threshold, value) { 0.0 } else { own };
        };
        let (values, lower, upper) =
            (values.chunks_exact(LANES), row.lower.chunks_exact(LANES), row.upper.chunks_exact(LANES));
        let rest = values.remainder().iter().zip(lower.remainder()).zip(upper.remainder());
        rest.enumerate().for_each(|(lane, ((&value, &lower), &upper))| add(lane, value, lower, upper));
        for ((value, lower), upper) in values.zip(lower).zip(upper) {
            for lane in 0..LANES {
                add(lane, value[lane], lower[lane], upper[lane]);
            }
        }
        let sum = |lanes: [f64; LANES]| (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
        Self { room: sum(room), room_with: sum(room_with), share: sum(share) }
    }
}
