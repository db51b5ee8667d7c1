//! Which cells a row lists: nested windows around the target, and how much noise may lie outside them.
//!
//! The boxes `{η : |η_j − c_j| ≤ t h_j for all j}` have one parameter `t`. Their center `c` and proportions `h`
//! are learned from a few samples, their size from all others, so that given the first ones the family
//! is fixed. With the `j` farthest of `N` samples left out, `t` is the `(j+1)`-th largest distance, and
//!
//! `P(η outside) ≤ ε_j`, where `Σ_{i≤j} C(N,i) ε_jⁱ (1 − ε_j)^{N−i} = level`,
//!
//! except with probability `level`, whatever the distribution: the mass beyond the `(j+1)`-th largest of `N` numbers
//! is stochastically at most `Beta(j+1, N−j)` (Wilks, *Ann. Math. Stat.* 12, 1941). For `j = 0` this is
//! `ε = 1 − level^{1/N}`; a bounding box in `ℝⁿ`, with its `2n` free sides, would have to pay for `j = 2n − 1`.
//!
//! Where all targets sit alike in their cells, distance is measured in whole cells (that of a cell is the least
//! distance of its points): the boxes grow by one layer of cells at a time, and what a sample needs of the
//! last layer in one dimension does not make the others any longer.
//!
//! **Between the steps of a group.** Where something unsafe must be avoided at every original step, the noise is that of
//! all partial sums `ξ_1 … ξ_d` together, with a center and proportions for each of them, and the distance is the
//! largest. The number of events stays the same. For the lower bounds of a row the samples inside matter: given the
//! edge of a window, the `(j+1)`-th farthest sample, they are independent with the law of the noise conditioned on being
//! inside ([`pac`](super::pac)). Equal distances are told apart by independent uniform numbers, for that alone.
//!
//! A distance is what this program computes from the sample, a fixed function of the noise; roundings make it larger,
//! and what is no number is infinitely far away. So whatever lies inside by its computed distance is inside in truth.

mod lottery;
mod shape;

use super::cell_box::CellBox;
use super::placement::Placement;
use super::room::{RUNGS, Room};
use crate::Warning;
use crate::noise::NoiseSamples;
use crate::partition::Grid;
use crate::statistics::{lower_bound, upper_bound};
pub(super) use lottery::shape_samples;
use shape::Shape;

/// The number of windows that a row can be made with.
pub(super) const WINDOWS: usize = 4;

/// Shape samples outside a window contradict its bound if they are so unlikely.
const CONTRADICTION: f64 = 1e-6;

/// The noise that windows are for.
#[derive(Clone, Copy)]
pub(super) struct Stack<'a> {
    /// That of whole groups of steps.
    pub(super) last: &'a NoiseSamples,
    /// The partial sums after every step in between; none if nothing has to be avoided there.
    pub(super) between: &'a [NoiseSamples],
    /// The dimensions in which it matters where the state is in between.
    pub(super) watched: &'a [bool],
}

/// Nested windows, the largest first, and bounds on the mass outside them.
#[derive(Clone, Debug)]
pub(super) struct Windows {
    last: Shape,
    /// Per step in between.
    between: Vec<Shape>,
    /// Whether distance is measured in whole cells at the end of a group.
    of_cells: bool,
    reaches: Vec<f64>,
    /// Per window, the bound on the mass outside.
    unseen: Vec<f64>,
    /// Per window, how many samples are inside, apart from its edge and those that decided about proportions.
    inside: Vec<u64>,
    /// Per sample, how many of the windows count it as inside: the first ones.
    depths: Vec<u8>,
    /// How many of the samples that decided about proportions lie outside the largest window, and how many there are.
    shape_outside: (u64, u64),
}

impl Windows {
    /// Windows that leave out the `discard`, `discard + 1`, … farthest samples; `levels` are those of their events.
    ///
    /// With a `shared` placement distance is measured in its cells.
    pub(super) fn new(
        stack: Stack<'_>,
        grid: &Grid,
        shared: Option<&Placement>,
        discard: usize,
        levels: &[f64],
    ) -> Self {
        let number = stack.last.len();
        let members = lottery::shape_members(number);
        let last = Shape::learn(stack.last, &members, grid, &vec![true; grid.dimension()]);
        let between: Vec<Shape> =
            stack.between.iter().map(|sums| Shape::learn(sums, &members, grid, stack.watched)).collect();
        let distance = |i: usize| {
            let noise = stack.last.get(i);
            let at_end = match shared {
                Some(placement) => last.distance_of_cells(&placement.spread(noise), placement),
                None => last.distance(noise),
            };
            let steps = between.iter().zip(stack.between);
            steps.map(|(shape, sums)| shape.distance(sums.get(i))).fold(at_end, f64::max)
        };
        let distances: Vec<f64> = (0..number).map(distance).collect();
        let ties = lottery::ties(number);
        let mut order: Vec<usize> = (0..number).filter(|i| members.binary_search(i).is_err()).collect();
        order.sort_unstable_by(|&a, &b| distances[b].total_cmp(&distances[a]).then(ties[b].cmp(&ties[a])));

        let mut windows = Self {
            of_cells: shared.is_some(),
            reaches: vec![],
            unseen: vec![],
            inside: vec![],
            depths: vec![0; number],
            shape_outside: (0, members.len() as u64),
            last,
            between,
        };
        for (rank, &level) in (discard..).zip(levels) {
            let Some(&edge) = order.get(rank) else { break };
            windows.reaches.push(distances[edge]);
            windows.unseen.push(upper_bound(rank as u64, order.len() as u64, level));
            windows.inside.push((order.len() - rank - 1) as u64);
        }
        for (rank, &sample) in order.iter().enumerate() {
            windows.depths[sample] = rank.saturating_sub(discard).min(windows.reaches.len()) as u8;
        }
        let reach = windows.reaches.first().copied().unwrap_or(f64::INFINITY);
        windows.shape_outside.0 = members.iter().filter(|&&i| distances[i] > reach).count() as u64;
        windows
    }

    /// The cells of every window.
    pub(super) fn cells(&self, placement: &Placement) -> Vec<CellBox> {
        let cells = |&reach: &f64| {
            if self.of_cells {
                self.last.cells_within(reach, placement)
            } else {
                let (lower, upper) = self.last.sides(reach);
                placement.spread_of_box(&lower, &upper)
            }
        };
        self.reaches.iter().map(cells).collect()
    }

    /// Where the noise so far is after a step in between, counted from 0, if it is in a window: lower and upper corner.
    pub(super) fn between(&self, window: usize, step: usize) -> (Vec<f64>, Vec<f64>) {
        self.between[step].sides(self.reaches[window])
    }

    /// Where the noise so far is after a step in between, counted from 0, if it stays within a rung: lower and upper corner.
    pub(super) fn rung(&self, rung: usize, step: usize) -> (Vec<f64>, Vec<f64>) {
        self.between[step].sides(RUNGS[rung])
    }

    /// Whether coordinates count from the target, for all actions alike.
    pub(super) fn are_shared(&self) -> bool {
        self.of_cells
    }

    /// How many samples did not decide about proportions.
    pub(super) fn independent(&self) -> u64 {
        self.depths.len() as u64 - self.shape_outside.1
    }

    /// Per sample, whether it stays in a room for certain in between, as a depth: in all windows or in none. Those that decided
    /// about proportions are in none.
    pub(super) fn depths_in(&self, room: Room, between: &[NoiseSamples]) -> Vec<u8> {
        let members = lottery::shape_members(self.depths.len());
        let within: Vec<_> = self.between.iter().map(|shape| shape.room(room)).collect();
        let stays = |i: usize| {
            within.iter().zip(between).all(|((lower, upper), sums)| {
                let noise = sums.get(i);
                (0..lower.len()).all(|j| {
                    let (x, error) = (noise.value(j), noise.error(j));
                    lower[j] <= (x - error).next_down() && (x + error).next_up() <= upper[j]
                })
            })
        };
        let depth = |i| if members.binary_search(&i).is_err() && stays(i) { WINDOWS as u8 } else { 0 };
        (0..self.depths.len()).map(depth).collect()
    }

    /// Per window, a bound on the mass outside; the largest window first.
    pub(super) fn unseen(&self) -> &[f64] {
        &self.unseen
    }

    /// Per window, how many samples lie inside, of those that neither decided about proportions nor are its edge.
    pub(super) fn inside(&self) -> &[u64] {
        &self.inside
    }

    /// Per sample, how many of the windows count it as inside: the first ones.
    pub(super) fn depths(&self) -> &[u8] {
        &self.depths
    }

    /// A warning if the samples that decided about proportions contradict the bound of the largest window.
    pub(super) fn contradiction(&self) -> Option<Warning> {
        let (outside, number) = self.shape_outside;
        let unseen = self.unseen.first().copied()?;
        let is_one = number > 0 && lower_bound(outside, number, CONTRADICTION) > unseen;
        is_one.then_some(Warning::ContradictedWindows { outside, number, unseen })
    }
}

/// The larger of two distances; what is no number is infinitely far away.
fn farther(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::NoiseSample;
    use imdp::numeric::from_decimal;

    fn windows(values: Vec<f64>) -> Windows {
        let exact = |x: f64| vec![from_decimal(x).unwrap()];
        let grid = Grid::new(&exact(0.0), &exact(10.0), &[10]).unwrap();
        let samples = NoiseSamples::new(1, values);
        let stack = Stack { last: &samples, between: &[], watched: &[] };
        Windows::new(stack, &grid, None, 0, &[1e-3; WINDOWS])
    }

    #[test]
    fn no_distance_is_nan() {
        let mut values = vec![0.25; 400];
        (values[7], values[11], values[300]) = (1e155, -1e300, f64::NAN);
        let windows = windows(values);
        assert!(windows.reaches.windows(2).all(|pair| pair[0] >= pair[1]));
        assert_eq!(windows.reaches[0], f64::INFINITY);
        assert!(windows.last.distance(NoiseSample::exact(&[f64::NAN])) == f64::INFINITY);
    }

    #[test]
    fn depths_say_which_windows_a_sample_is_in() {
        let values: Vec<f64> = (0..320).map(f64::from).collect();
        let windows = windows(values);
        assert_eq!(windows.depths.iter().filter(|&&depth| depth == 0).count(), 20 + 1);
        for window in 0..WINDOWS {
            let inside = windows.depths.iter().filter(|&&depth| usize::from(depth) > window).count();
            assert_eq!(inside as u64, windows.inside[window]);
        }
    }

    #[test]
    fn a_contradiction_is_noticed() {
        let members = lottery::shape_members(800);
        let mut values = vec![0.25; 800];
        assert_eq!(windows(values.clone()).contradiction(), None);
        members.iter().for_each(|&i| values[i] = if i % 2 == 0 { 40.0 } else { -40.0 });
        let warning = windows(values).contradiction();
        assert!(matches!(warning, Some(Warning::ContradictedWindows { number: 48, .. })), "{warning:?}");
    }
}
