//! The targets that leave room in all half-spaces of a cell: the points of a lattice in a polytope, scanned in lines.
//!
//! Dimension by dimension, every half-space bounds a coordinate by what the dimensions after it can contribute at most. Where one
//! dimension has to serve two half-spaces at once, each of them alone allows far more than both: so scans look at *sums* of two
//! half-spaces as well, with weights that cancel a later dimension. A sum holds wherever both of its half-spaces do. It only
//! rules out what neither allows, with more than rounding to spare, and never decides that an action is enabled.

use super::Targets;
use crate::system::SteeringConstraint;
use imdp::model::{RowId, RowRange};

/// By which part of all that is added up sums are relaxed, which is far above rounding.
const RELAXED: f64 = 1e-9;

/// Half-spaces are added if the dimension to be cancelled has at least this part of what each of them depends on most.
const SHARE: f64 = 0.1;

/// The scan over target points, prepared for one set of constraints.
pub(super) struct Scan<'a> {
    constraints: &'a [SteeringConstraint],
    sums: Vec<Sum>,
    /// Per dimension `k`, the coefficient `α_k` of every half-space, those of the constraints and then those of the sums,
    normals: Vec<Vec<f64>>,
    /// the least that dimensions after `k` can contribute to `α·d`,
    least_after: Vec<Vec<f64>>,
    /// the most,
    most_after: Vec<Vec<f64>>,
    /// the most that dimensions from `k` on can,
    most_from: Vec<Vec<f64>>,
    /// and a bound on `|α·d|` over dimensions from `k` on.
    magnitudes: Vec<Vec<f64>>,
    /// By how much more than nothing there must be room, in terms of what is added up, for rounding not to matter.
    spare: f64,
}

/// Two constraints, added with weights.
struct Sum {
    parts: [(usize, f64); 2],
}

/// What the coordinates of the dimensions before one leave to it.
#[derive(Clone)]
pub(super) struct Level {
    /// Per half-space, what is left of its bound.
    slack: Vec<f64>,
    /// The half-spaces that some target may still be outside of, ascending.
    active: Vec<usize>,
}

impl<'a> Scan<'a> {
    pub(super) fn new(targets: &Targets, constraints: &'a [SteeringConstraint]) -> Self {
        let axes = targets.axes().unwrap_or_default();
        let sums = sums(axes, constraints);
        let normal = |k: usize| -> Vec<f64> {
            let of_sum =
                |sum: &Sum| sum.parts.iter().map(|&(i, weight)| weight * constraints[i].target[k]).sum();
            constraints.iter().map(|constraint| constraint.target[k]).chain(sums.iter().map(of_sum)).collect()
        };
        let normals: Vec<Vec<f64>> = (0..axes.len()).map(normal).collect();
        let zero = vec![vec![0.0; constraints.len() + sums.len()]; axes.len()];
        let mut scan = Self {
            constraints,
            sums,
            normals,
            least_after: zero.clone(),
            most_after: zero.clone(),
            most_from: zero.clone(),
            magnitudes: zero,
            spare: 16.0 * (axes.len() + 1) as f64 * f64::EPSILON,
        };
        for k in (0..axes.len()).rev() {
            let ends = [axes[k][0], axes[k][axes[k].len() - 1]];
            for (i, alpha) in scan.normals[k].iter().enumerate() {
                let [a, b] = ends.map(|x| alpha * x);
                let after = scan.magnitudes.get(k + 1).map_or(0.0, |after| after[i]);
                scan.magnitudes[k][i] = after + a.abs().max(b.abs());
                scan.most_from[k][i] = scan.most_after[k][i] + a.max(b);
                if k > 0 {
                    scan.least_after[k - 1][i] = scan.least_after[k][i] + a.min(b);
                    scan.most_after[k - 1][i] = scan.most_from[k][i];
                }
            }
        }
        scan
    }

    /// Room for the scan of one cell after the other.
    pub(super) fn levels(&self) -> Vec<Level> {
        let half_spaces = self.constraints.len() + self.sums.len();
        vec![Level { slack: vec![0.0; half_spaces], active: vec![] }; self.normals.len()]
    }

    /// Adds the targets that leave room in all constraints of a cell, given what the cell leaves to `α·d`.
    pub(super) fn run(
        &self,
        targets: &Targets,
        slack: &[f64],
        levels: &mut [Level],
        ranges: &mut Vec<RowRange>,
    ) {
        let mut found = Found { start: ranges.len(), ranges };
        match (targets.axes(), levels.first_mut()) {
            (Some(axes), Some(root)) => {
                root.slack[..slack.len()].copy_from_slice(slack);
                for (of_sum, sum) in root.slack[slack.len()..].iter_mut().zip(&self.sums) {
                    let added = sum.parts.iter().map(|&(i, weight)| {
                        let all = slack[i].abs() + self.magnitudes[0][i];
                        weight * slack[i] + RELAXED * weight * all
                    });
                    *of_sum = added.sum();
                }
                root.active.clear();
                root.active.extend(0..root.slack.len());
                self.lattice(axes, 0, 0, levels, &mut found);
            }
            _ => self.list(targets, slack, &mut found),
        }
    }

    /// Looks for the coordinates of dimension `k`, then of those after it.
    fn lattice(&self, axes: &[Vec<f64>], k: usize, base: usize, levels: &mut [Level], found: &mut Found<'_>) {
        let Some((Level { slack, active }, deeper)) = levels.split_first_mut() else { return };
        let axis = &axes[k];
        let base = base * axis.len();
        let least = |i: usize| slack[i] - self.least_after[k][i];
        if deeper.is_empty() {
            return self.line(axes, k, base / axis.len(), self.own(active), least, found);
        }
        // Where there is room for whatever comes after, with more than rounding to spare, it need not be looked at.
        let spare = |i: usize| self.spare * (slack[i].abs() + self.magnitudes[k][i]);
        active.retain(|&i| {
            let room = slack[i] - self.most_from[k][i] - spare(i);
            room < 0.0 || room.is_nan()
        });
        let Some((first, last)) = self.feasible(axis, k, active, least) else { return };
        let most = |i: usize| slack[i] - self.most_after[k][i] - spare(i);
        let whole = self.feasible(axis, k, self.own(active), most);
        let behind: usize = axes[k + 1..].iter().map(Vec::len).product();
        for (i, &x) in axis.iter().enumerate().take(last + 1).skip(first) {
            if let Some((first, last)) = whole.filter(|&(first, last)| first <= i && i <= last) {
                if i == first {
                    found.push((base + first) * behind, (base + last + 1) * behind - 1);
                }
                continue;
            }
            let left = |i: usize| slack[i] - self.normals[k][i] * x;
            match deeper {
                // The last dimension gives a range: nothing is kept for it.
                [_] => self.line(axes, k + 1, base + i, self.own(active), left, found),
                [next, ..] => {
                    next.active.clone_from(active);
                    active.iter().for_each(|&i| next.slack[i] = left(i));
                    self.lattice(axes, k + 1, base + i, deeper, found);
                }
                [] => {}
            }
        }
    }

    /// Looks along the last dimension `k`, where the half-spaces have so much room.
    fn line(
        &self,
        axes: &[Vec<f64>],
        k: usize,
        base: usize,
        half_spaces: &[usize],
        room: impl Fn(usize) -> f64,
        found: &mut Found<'_>,
    ) {
        let base = base * axes[k].len();
        if let Some((first, last)) = self.feasible(&axes[k], k, half_spaces, room) {
            found.push(base + first, base + last);
        }
    }

    /// Those half-spaces that are constraints, not sums of them.
    fn own<'b>(&self, active: &'b [usize]) -> &'b [usize] {
        &active[..active.partition_point(|&i| i < self.constraints.len())]
    }

    /// The indices along dimension `k` for which there is room in these half-spaces, as an inclusive range.
    fn feasible(
        &self,
        axis: &[f64],
        k: usize,
        half_spaces: &[usize],
        room: impl Fn(usize) -> f64,
    ) -> Option<(usize, usize)> {
        let (mut first, mut last) = (0usize, axis.len() - 1);
        let spacing = if axis.len() > 1 { (axis[last] - axis[0]) / last as f64 } else { 1.0 };
        for &i in half_spaces {
            let alpha = self.normals[k][i];
            let room = room(i);
            // Monotone in x even in floating point, so the feasible indices are a range.
            let fits = |index: usize| alpha * axis[index] <= room;
            // No number, or less than any: a sum that overflowed decides for nobody.
            if room.is_nan() || room == f64::NEG_INFINITY {
                return None;
            }
            if alpha == 0.0 {
                if room < 0.0 {
                    return None;
                }
                continue;
            }
            if fits(first) && fits(last) {
                continue;
            }
            let guess = ((room / alpha - axis[0]) / spacing).clamp(first as f64, last as f64) as usize;
            if alpha > 0.0 {
                let mut end = guess;
                while end < last && fits(end + 1) {
                    end += 1;
                }
                while !fits(end) {
                    if end == first {
                        return None;
                    }
                    end -= 1;
                }
                last = end;
            } else {
                let mut start = guess;
                while start > first && fits(start - 1) {
                    start -= 1;
                }
                while !fits(start) {
                    if start == last {
                        return None;
                    }
                    start += 1;
                }
                first = start;
            }
        }
        Some((first, last))
    }

    fn list(&self, targets: &Targets, slack: &[f64], found: &mut Found<'_>) {
        let mut point = vec![0.0; targets.dimension()];
        for target in targets.ids() {
            targets.point(target, &mut point);
            let enabled = self.constraints.iter().zip(slack).all(|(constraint, &slack)| {
                constraint.target.iter().zip(&point).fold(slack, |rest, (alpha, x)| rest - alpha * x) >= 0.0
            });
            if enabled {
                found.push(target.index(), target.index());
            }
        }
    }
}

/// The sums of two constraints that have a dimension after the first one mostly in common, which is cancelled.
fn sums(axes: &[Vec<f64>], constraints: &[SteeringConstraint]) -> Vec<Sum> {
    let extents: Vec<f64> = axes.iter().map(|axis| axis[axis.len() - 1] - axis[0]).collect();
    let span = |i: usize, k: usize| constraints[i].target[k].abs() * extents[k];
    let largest = |i: usize| (0..axes.len()).map(|k| span(i, k)).fold(0.0, f64::max);
    let mut sums = vec![];
    for k in 1..axes.len() {
        let counts = |&i: &usize| span(i, k) > 0.0 && span(i, k) >= SHARE * largest(i);
        let with: Vec<usize> = (0..constraints.len()).filter(counts).collect();
        for (number, &i) in with.iter().enumerate() {
            for &j in &with[number + 1..] {
                let (a, b) = (constraints[i].target[k], constraints[j].target[k]);
                let parts = [(i, 1.0 / a.abs()), (j, 1.0 / b.abs())];
                let left = |k: usize| -> f64 {
                    parts.iter().map(|&(i, weight)| weight * constraints[i].target[k]).sum::<f64>().abs()
                        * extents[k]
                };
                // Opposite sides of one band say nothing together.
                let says = (0..k).any(|k| {
                    left(k) >= SHARE * (span(i, k) / a.abs()).max(span(j, k) / b.abs()) && left(k) > 0.0
                });
                let is_finite = parts.iter().all(|(_, weight)| weight.is_finite());
                if a * b < 0.0 && says && is_finite && sums.len() < 4 * constraints.len() {
                    sums.push(Sum { parts });
                }
            }
        }
    }
    sums
}

/// The ranges of one cell, behind those of others.
struct Found<'a> {
    start: usize,
    ranges: &'a mut Vec<RowRange>,
}

impl Found<'_> {
    /// Adds the rows of a range of targets, merged with what they continue.
    fn push(&mut self, first: usize, last: usize) {
        let (first, last) = (RowId::from_index(first), RowId::from_index(last));
        match self.ranges[self.start..].last_mut() {
            Some(previous) if previous.last.next() == first => previous.last = last,
            _ => self.ranges.push(RowRange { first, last }),
        }
    }
}
