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
    pub(super) fn find(
        row: Row<'_>,
        Scratch { values, open }: &mut Scratch,
        slack: f64,
        (critical, first): (&mut u32, &Before),
        before: impl Fn(f64, f64) -> bool + Copy,
    ) -> Self {
        let mut sums = *first;
        // The threshold comes after the one and before the other.
        let (mut too_early, mut too_late) = (None, None);
        let mut round = 0;
        loop {
            // Rounding keeps sums monotone, so where there is too much room there is an earlier value.
            let is_late = sums.room > slack;
            if !is_late && sums.room_with >= slack {
                break;
            }
            let guess = sums.value;
            *(if is_late { &mut too_late } else { &mut too_early }) = Some(guess);
            let next = if round < NEIGHBOURS {
                nearest(values, guess, |a, b| if is_late { before(b, a) } else { before(a, b) })
            } else {
                open.clear();
                open.extend(values.iter().copied().filter(|&value| {
                    too_early.is_none_or(|bound| before(bound, value))
                        && too_late.is_none_or(|bound| before(value, bound))
                }));
                let middle = open.len() / 2;
                (!open.is_empty()).then(|| *open.select_nth_unstable_by(middle, f64::total_cmp).1)
            };
            // Without another one all room is too little.
            let Some(next) = next else { break };
            sums = Before::new(row, values, next, before);
            round += 1;
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

/// The value that is next after `from`; `precedes(a, b)` says that `a` comes before `b` on the way.
fn nearest(values: &[f64], from: f64, precedes: impl Fn(f64, f64) -> bool) -> Option<f64> {
    let mut next: Option<f64> = None;
    for &value in values {
        if precedes(from, value) && next.is_none_or(|next| precedes(value, next)) {
            next = Some(value);
        }
    }
    next
}

impl Before {
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
