//! The closed loop in a plane: the vector field, and simulated runs.

use super::frame::Frame;
use super::numbers::{compact, coordinate};
use super::palette::FIRST_LIGHT_LEVEL;
use super::scene::Scene;
use super::view::{Axis, View};
use crate::controller::{Decision, Trajectory, TrajectoryStep};
use crate::partition::CellId;

/// The most arrows along one side.
const MOST_ARROWS: u32 = 20;

/// An arrow from the center of every few cells towards the mean of the next state, shortened to its place.
pub(super) fn arrows(scene: &Scene<'_>, view: &View, frame: &Frame) -> String {
    let paths = field((scene, view), frame, |cell, step| {
        let level = scene.scale.level(scene.values.at(step)[cell.index()]);
        Some((usize::from(level >= FIRST_LIGHT_LEVEL), scene.mean_successor(cell, step)?))
    });
    let drawn = ["on-dark", "on-light"].into_iter().zip(paths).filter(|(_, d)| !d.is_empty());
    drawn.map(|(class, d)| format!("<path class=\"arrow {class}\" d=\"{d}\"/>")).collect()
}

/// Arrows of two kinds from the centers of every few cells to where these lead, shortened to their places.
pub(super) fn field(
    (scene, view): (&Scene<'_>, &View),
    frame: &Frame,
    leads: impl Fn(CellId, usize) -> Option<(usize, Vec<f64>)>,
) -> [String; 2] {
    let (columns, rows) = view.size(scene);
    let (stride_x, stride_y) = (columns.div_ceil(MOST_ARROWS), rows.div_ceil(MOST_ARROWS));
    let place = (frame.width / f64::from(columns) * f64::from(stride_x))
        .min(frame.height / f64::from(rows) * f64::from(stride_y));
    let mut paths = [String::new(), String::new()];
    for i in (stride_x / 2..columns).step_by(stride_x as usize) {
        for j in (stride_y / 2..rows).step_by(stride_y as usize) {
            let (cell, step) = view.cell(scene, i, j);
            let Some((kind, next)) = leads(cell, step) else { continue };
            let (from, to) = match view.across {
                Axis::Time => (f64::from(i), f64::from(i) + 1.0),
                Axis::State(dimension) => (scene.center(dimension, i), next[dimension]),
            };
            let (x, y) = (frame.x.at(from), frame.y.at(scene.center(view.up, j)));
            let (dx, dy) = (frame.x.at(to) - x, frame.y.at(next[view.up]) - y);
            paths[kind] += &arrow((x, y), (dx, dy), 0.85 * place);
        }
    }
    paths
}

/// An arrow as a path, no longer than `most`.
fn arrow((x, y): (f64, f64), (dx, dy): (f64, f64), most: f64) -> String {
    let length = dx.hypot(dy);
    if length < 0.5 {
        return String::new();
    }
    let shown = length.min(most) / length;
    let (dx, dy) = (dx * shown, dy * shown);
    let head = (0.35 * dx.hypot(dy)).min(6.0) / dx.hypot(dy);
    let (hx, hy) = (dx * head, dy * head);
    let end = (x + dx, y + dy);
    let side = |sign: f64| {
        let (bx, by) = (end.0 - hx - sign * 0.5 * hy, end.1 - hy + sign * 0.5 * hx);
        format!("{} {}", coordinate(bx), coordinate(by))
    };
    let tip = format!("{} {}", coordinate(end.0), coordinate(end.1));
    format!("M{} {}L{tip}M{}L{tip}L{}", coordinate(x), coordinate(y), side(1.0), side(-1.0))
}

/// The runs: lines through the grouped instants, the failed ones last and so on top; faded where they are outside of the slice.
pub(super) fn runs(scene: &Scene<'_>, view: &View, frame: &Frame) -> String {
    let d = scene.group_steps as f64;
    let is_projected = view.fixed().next().is_some();
    let mut drawn = [String::new(), String::new()];
    for trajectory in &scene.trajectories {
        let point = |step: &TrajectoryStep| {
            let state: Vec<f64> = step.state.iter().map(|&x| compact(x)).collect();
            let across = match view.across {
                Axis::Time => step.step as f64 / d,
                Axis::State(dimension) => state[dimension],
            };
            let place = (frame.x.at(across), frame.y.at(state[view.up]));
            RunPoint { place, inside: view.is_in_slice(scene, &state) }
        };
        let asked = trajectory.steps.iter().filter(|step| step.decision.is_some());
        let points: Vec<_> = asked.map(point).collect();
        let wraps = wraps(scene, view, frame);
        let class = class(trajectory);
        let paths = |points: &[RunPoint], only: Option<bool>, faded: &str| {
            let (line, dots) = (line(points, only, wraps), dots(points, only));
            let path = |class: String, d: &str| match d {
                "" => String::new(),
                d => format!("<path class=\"{class}{faded}\" d=\"{d}\"/>"),
            };
            path("casing".into(), &line) + &path(class.into(), &line) + &path(format!("dots {class}"), &dots)
        };
        drawn[usize::from(!trajectory.outcome.satisfied)] += &match is_projected {
            false => paths(&points, None, ""),
            true => paths(&points, Some(false), " faded") + &paths(&points, Some(true), ""),
        };
    }
    let text = drawn.concat();
    let start = match view.across {
        Axis::Time => 0.0,
        Axis::State(dimension) => scene.start[dimension],
    };
    text + &format!(
        "<circle class=\"start\" cx=\"{}\" cy=\"{}\" r=\"4.5\"/>",
        coordinate(frame.x.at(start)),
        coordinate(frame.y.at(scene.start[view.up]))
    )
}

/// A state of a run in a plot.
#[derive(Clone, Copy)]
struct RunPoint {
    place: (f64, f64),
    /// Whether it is in the slice.
    inside: bool,
}

/// How far apart the ends of periodic axes are.
fn wraps(scene: &Scene<'_>, view: &View, frame: &Frame) -> [Option<f64>; 2] {
    let across = match view.across {
        Axis::Time => None,
        Axis::State(j) => scene.periods[j].map(|_| frame.width),
    };
    [across, scene.periods[view.up].map(|_| frame.height)]
}

/// What to add to the end of a line over a periodic axis so that it is no longer than half of the axis.
pub(super) fn shift(from: f64, to: f64, wrap: Option<f64>) -> f64 {
    match wrap {
        Some(length) if to - from > length / 2.0 => -length,
        Some(length) if from - to > length / 2.0 => length,
        _ => 0.0,
    }
}

/// The lines between points that are both in the slice (`Some(true)`), that are not (`Some(false)`), or all; they go out at one
/// end of a periodic axis and come in at the other.
fn line(points: &[RunPoint], only: Option<bool>, wraps: [Option<f64>; 2]) -> String {
    let pair = |(x, y): (f64, f64)| format!("{} {}", coordinate(x), coordinate(y));
    let (mut d, mut pen) = (String::new(), false);
    for ends in points.windows(2) {
        let [from, to] = [ends[0].place, ends[1].place];
        if only.is_some_and(|inside| inside != (ends[0].inside && ends[1].inside)) {
            pen = false;
            continue;
        }
        if !pen {
            d += &format!("M{}", pair(from));
        }
        let (dx, dy) = (shift(from.0, to.0, wraps[0]), shift(from.1, to.1, wraps[1]));
        if (dx, dy) != (0.0, 0.0) {
            let (out, back) = ((to.0 + dx, to.1 + dy), (from.0 - dx, from.1 - dy));
            d += &format!("L{}M{}", pair(out), pair(back));
        }
        d += &format!("L{}", pair(to));
        pen = true;
    }
    d
}

/// Dots: lines of no length with round ends.
fn dots(points: &[RunPoint], only: Option<bool>) -> String {
    let kept = points.iter().filter(|point| only.is_none_or(|inside| inside == point.inside));
    kept.map(|RunPoint { place: (x, y), .. }| format!("M{} {}h0", coordinate(*x), coordinate(*y))).collect()
}

/// How a run is drawn.
pub(super) fn class(trajectory: &Trajectory) -> &'static str {
    let goes_on = |decision| matches!(decision, Some(Decision::Act { .. }));
    match trajectory.steps.last() {
        _ if trajectory.outcome.satisfied => "satisfied run",
        Some(last) if goes_on(last.decision) => "open run",
        _ => "failed run",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(places: &[(f64, f64)], inside: &[bool]) -> Vec<RunPoint> {
        places.iter().zip(inside).map(|(&place, &inside)| RunPoint { place, inside }).collect()
    }

    #[test]
    fn lines_go_out_at_one_end_and_come_in_at_the_other() {
        let run = points(&[(5.0, 0.0), (5.0, 90.0), (5.0, 80.0)], &[true; 3]);
        assert_eq!(line(&run, None, [None, None]), "M5 0L5 90L5 80");
        assert_eq!(line(&run, None, [None, Some(100.0)]), "M5 0L5 -10M5 100L5 90L5 80");
        assert_eq!(line(&run, None, [Some(4.0), None]), "M5 0L5 90L5 80");
    }

    #[test]
    fn lines_are_in_the_slice_if_both_ends_are() {
        let run = points(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0)], &[true, true, false, true]);
        assert_eq!(line(&run, Some(true), [None, None]), "M0 0L1 0");
        assert_eq!(line(&run, Some(false), [None, None]), "M1 0L2 0L3 0");
        assert_eq!(
            (dots(&run, Some(true)).matches('M').count(), dots(&run, Some(false)).as_str()),
            (3, "M2 0h0")
        );
    }
}
