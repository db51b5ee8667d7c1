//! What must be avoided at every step.

use super::room::{RUNGS, Room};
use crate::partition::Region;
use crate::problem::{Knowledge, Problem};
use crate::task::Safety;
use imdp::numeric::{Rational, to_f64_down, to_f64_up};

/// The unsafe regions as boxes in doubles, rounded outwards, and the partition if its outside is unsafe too, rounded
/// inwards.
#[derive(Clone, Debug)]
pub(super) struct Hazards {
    boxes: Vec<Vec<Side>>,
    partition: Option<Vec<Side>>,
    watched: Vec<bool>,
}

/// `[lower, upper)` in one dimension.
#[derive(Clone, Copy, Debug)]
struct Side {
    lower: f64,
    upper: f64,
}

impl Hazards {
    /// Those that must be avoided between grouped instants too; none if nothing is unsafe or there is no step in between.
    pub(super) fn in_between(problem: &Problem) -> Option<Self> {
        let axes = problem.grid().axes();
        let outside = problem.outside_is_unsafe();
        let is_pac = matches!(problem.knowledge(), Knowledge::Samples { .. });
        let anywhere = !problem.unsafe_regions().is_empty() || outside;
        if !(is_pac && anywhere && problem.group_steps() > 1 && problem.safety() == Safety::EveryStep) {
            return None;
        }
        let is_bounded = |region: &Region, j: usize| region.lower[j].is_some() || region.upper[j].is_some();
        let partition =
            axes.iter().map(|axis| Side { lower: to_f64_up(axis.lower()), upper: to_f64_down(axis.upper()) });
        Some(Self {
            boxes: problem.unsafe_regions().iter().map(sides).collect(),
            partition: outside.then(|| partition.collect()),
            watched: (0..axes.len())
                .map(|j| outside || problem.unsafe_regions().iter().any(|region| is_bounded(region, j)))
                .collect(),
        })
    }

    /// The dimensions in which it matters where the state is.
    pub(super) fn watched(&self) -> &[bool] {
        &self.watched
    }

    /// Whether some point of a closed box may be unsafe; yes if a side is no number.
    pub(super) fn are_met(&self, lower: &[f64], upper: &[f64]) -> bool {
        let is_clear =
            |(side, (lower, upper)): (&Side, (&f64, &f64))| *upper < side.lower || *lower >= side.upper;
        let is_within =
            |(side, (lower, upper)): (&Side, (&f64, &f64))| side.lower <= *lower && *upper < side.upper;
        let corners = || lower.iter().zip(upper);
        let is_safe = (self.boxes.iter()).all(|sides| sides.iter().zip(corners()).any(is_clear))
            && self.partition.iter().all(|sides| sides.iter().zip(corners()).all(is_within));
        !is_safe
    }

    /// The room, within another, in which nothing unsafe is met; none if there is none without limits below a rung, `least`.
    ///
    /// `face` says of a side and a rung how far the state is on that side if the noise stays within the rung. Every unsafe
    /// region is kept clear of on the side on which most noise may be.
    pub(super) fn room(
        &self,
        within: Room,
        least: usize,
        face: impl Fn(usize, usize) -> f64,
    ) -> Option<Room> {
        let mut room = within;
        let farthest = |side: usize, is_clear: &dyn Fn(f64) -> bool| {
            (least..RUNGS.len()).rev().find(|&rung| is_clear(face(side, rung)))
        };
        for sides in &self.boxes {
            // The last of those with most noise, as a rung and a side.
            let mut best: Option<(usize, usize)> = None;
            let mut is_met = true;
            for side in 0..2 * sides.len() {
                let own = sides[side / 2];
                let rung = match side % 2 {
                    0 => farthest(side, &|x| x >= own.upper),
                    _ => farthest(side, &|x| x < own.lower),
                };
                let Some(rung) = rung else { continue };
                if room.limit(side).is_some_and(|limit| limit <= rung) {
                    is_met = false;
                    break;
                }
                if best.is_none_or(|(most, _)| rung >= most) {
                    best = Some((rung, side));
                }
            }
            if is_met {
                let (rung, side) = best?;
                room = room.limited(side, rung);
            }
        }
        for (j, own) in self.partition.iter().flatten().enumerate() {
            room = room.limited(2 * j, farthest(2 * j, &|x| x >= own.lower)?);
            room = room.limited(2 * j + 1, farthest(2 * j + 1, &|x| x < own.upper)?);
        }
        Some(room)
    }
}

fn sides(region: &Region) -> Vec<Side> {
    let lower = |side: &Option<Rational>| side.as_ref().map_or(f64::NEG_INFINITY, to_f64_down);
    let upper = |side: &Option<Rational>| side.as_ref().map_or(f64::INFINITY, to_f64_up);
    (region.lower.iter().zip(&region.upper)).map(|(l, u)| Side { lower: lower(l), upper: upper(u) }).collect()
}
