//! Up to which value the slack of a row is poured.

use crate::model::Row;

/// How many sums are interleaved; they are added up in the same way whatever the threshold.
const LANES: usize = 4;

/// If so many thresholds were too near the last one, it is computed how far away it is; what rounding makes of that, is near again.
const FAR: u32 = 1;

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
    /// With their room.
    open: Vec<(f64, f64)>,
}

/// Sums over the successors whose values come before a threshold.
#[derive(Clone, Copy, Debug)]
pub(super) struct Before {
    /// The threshold.
    value: f64,
    /// Of their room `u − l`.
    room: f64,
    /// Of the room of those at the threshold as well.
    room_with: f64,
    /// Of their room times value.
    share: f64,
}

/// What is known of a row after one look at it.
pub(super) struct FirstPass {
    /// The least value of a successor that can have any mass; the others bound nothing.
    pub(super) lowest: f64,
    /// The greatest one.
    pub(super) highest: f64,
    /// `Σ l V` in four interleaved sums, which the error bound for one sum covers as well.
    pub(super) base: f64,
    /// The sums for the threshold of the last iteration.
    pub(super) before: Before,
}

impl FirstPass {
    /// Of a row with such values; `critical` is the position of the threshold of the last iteration.
    #[inline(always)]
    pub(super) fn new(
        row: Row<'_>,
        Scratch { values, .. }: &Scratch,
        critical: u32,
        before: impl Fn(f64, f64) -> bool,
    ) -> Self {
        let threshold = values[(critical as usize).min(values.len() - 1)];
        // Arrays that stay in registers, which a closure over them would not.
        let (mut lowest, mut highest, mut base) =
            ([f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES], [0.0; LANES]);
        let (mut room, mut room_with, mut share) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        let (values, lower, upper) =
            (values.as_chunks::<LANES>(), row.lower.as_chunks::<LANES>(), row.upper.as_chunks::<LANES>());
        for ((values, lower), upper) in values.0.iter().zip(lower.0).zip(upper.0) {
            for lane in 0..LANES {
                let value = values[lane];
                let (low, high) =
                    if upper[lane] > 0.0 { (value, value) } else { (f64::INFINITY, f64::NEG_INFINITY) };
                lowest[lane] = if low < lowest[lane] { low } else { lowest[lane] };
                highest[lane] = if high > highest[lane] { high } else { highest[lane] };
                base[lane] += lower[lane] * value;
                let own = upper[lane] - lower[lane];
                let inside = if before(value, threshold) { own } else { 0.0 };
                room[lane] += inside;
                share[lane] += inside * value;
                room_with[lane] += if before(threshold, value) { 0.0 } else { own };
            }
        }
        let mut rest = 0.0;
        let tail = values.1.iter().zip(lower.1).zip(upper.1).enumerate();
        for (lane, ((&value, &lower), &upper)) in tail {
            if upper > 0.0 {
                (lowest[0], highest[0]) = (value.min(lowest[0]), value.max(highest[0]));
            }
            rest += lower * value;
            let own = upper - lower;
            let inside = if before(value, threshold) { own } else { 0.0 };
            room[lane] += inside;
            share[lane] += inside * value;
            room_with[lane] += if before(threshold, value) { 0.0 } else { own };
        }
        Self {
            lowest: lowest.into_iter().fold(f64::INFINITY, f64::min),
            highest: highest.into_iter().fold(f64::NEG_INFINITY, f64::max),
            base: sum(base) + rest,
            before: Before {
                value: threshold,
                room: sum(room),
                room_with: sum(room_with),
                share: sum(share),
            },
        }
    }
}

/// Interleaved sums, put together.
fn sum(lanes: [f64; LANES]) -> f64 {
    (lanes[0] + lanes[1]) + (lanes[2] + lanes[3])
}

impl Threshold {
    /// Pours `slack` into a row with such values, those that come `before` others first.
    ///
    /// `critical` is the position of the last one in the last iteration, with the sums for it, and is replaced by the present one.
    #[inline(always)]
    pub(super) fn find(
        row: Row<'_>,
        Scratch { values, open }: &mut Scratch,
        slack: f64,
        (critical, first): (&mut u32, &Before),
        before: impl Fn(f64, f64) -> bool + Copy,
    ) -> Self {
        let mut sums = *first;
        for round in 0.. {
            // Rounding keeps sums monotone, so where there is too much room there is an earlier value, and the search never turns.
            let is_late = sums.room > slack;
            if !is_late && sums.room_with >= slack {
                break;
            }
            let guess = sums.value;
            let is_ahead = |value: f64| if is_late { before(value, guess) } else { before(guess, value) };
            let next = if round == FAR {
                let needed = if is_late { slack } else { slack - sums.room_with };
                open.clear();
                let rooms = row.upper.iter().zip(row.lower).map(|(upper, lower)| upper - lower);
                open.extend(values.iter().copied().zip(rooms).filter(|&(value, _)| is_ahead(value)));
                filled(open, needed, before)
            } else {
                let ahead = values.iter().copied().filter(|&value| is_ahead(value));
                ahead.reduce(|a, b| if before(a, b) == is_late { b } else { a })
            };
            // Without another one all room is too little.
            let Some(next) = next else { break };
            sums = Before::new(row, values, next, before);
        }
        if sums.value != first.value
            && let Some(position) = values.iter().position(|&value| value == sums.value)
        {
            *critical = position as u32;
        }
        let left = (slack - sums.room_with).max(0.0);
        let at_threshold = slack.min(sums.room_with) - sums.room;
        Self { poured: sums.share + at_threshold.max(0.0) * sums.value, left }
    }
}

/// The first value up to which successors have the room that is needed, or else the last one; to within rounding.
fn filled(
    mut open: &mut [(f64, f64)],
    mut needed: f64,
    before: impl Fn(f64, f64) -> bool + Copy,
) -> Option<f64> {
    let order = |a: &(f64, f64), b: &(f64, f64)| before(b.0, a.0).cmp(&before(a.0, b.0));
    while open.len() > 1 {
        let (early, middle, late) = open.select_nth_unstable_by(open.len() / 2, order);
        let room: f64 = early.iter().map(|(_, room)| room).sum();
        if room >= needed {
            open = early;
        } else if room + middle.1 >= needed || late.is_empty() {
            return Some(middle.0);
        } else {
            needed -= room + middle.1;
            open = late;
        }
    }
    open.first().map(|(value, _)| *value)
}

impl Before {
    #[inline(always)]
    fn new(row: Row<'_>, values: &[f64], threshold: f64, before: impl Fn(f64, f64) -> bool) -> Self {
        // Arrays that stay in registers, which a closure over them would not.
        let (mut room, mut room_with, mut share) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        let (values, lower, upper) =
            (values.as_chunks::<LANES>(), row.lower.as_chunks::<LANES>(), row.upper.as_chunks::<LANES>());
        for ((values, lower), upper) in values.0.iter().zip(lower.0).zip(upper.0) {
            for lane in 0..LANES {
                let (value, own) = (values[lane], upper[lane] - lower[lane]);
                let inside = if before(value, threshold) { own } else { 0.0 };
                room[lane] += inside;
                share[lane] += inside * value;
                room_with[lane] += if before(threshold, value) { 0.0 } else { own };
            }
        }
        let rest = values.1.iter().zip(lower.1).zip(upper.1).enumerate();
        for (lane, ((&value, &lower), &upper)) in rest {
            let own = upper - lower;
            let inside = if before(value, threshold) { own } else { 0.0 };
            room[lane] += inside;
            share[lane] += inside * value;
            room_with[lane] += if before(threshold, value) { 0.0 } else { own };
        }
        Self { value: threshold, room: sum(room), room_with: sum(room_with), share: sum(share) }
    }
}
