//! The closed loop in a plane: the vector field, and simulated runs.

use super::frame::Frame;
use super::numbers::coordinate;
use super::palette::{FIRST_LIGHT_LEVEL, level};
use super::scene::Scene;
use super::view::{Axis, View};
use crate::controller::{Decision, Trajectory};

/// The most arrows along one side.
const MOST_ARROWS: u32 = 20;

/// An arrow from the center of every few cells towards the mean of the next state, shortened to its place.
pub(super) fn arrows(scene: &Scene<'_>, view: &View, frame: &Frame) -> String {
    let (columns, rows) = view.size(scene);
    let (stride_x, stride_y) = (columns.div_ceil(MOST_ARROWS), rows.div_ceil(MOST_ARROWS));
    let place = (frame.width / f64::from(columns) * f64::from(stride_x))
        .min(frame.height / f64::from(rows) * f64::from(stride_y));
    let mut paths = [String::new(), String::new()];
    for i in (stride_x / 2..columns).step_by(stride_x as usize) {
        for j in (stride_y / 2..rows).step_by(stride_y as usize) {
            let (cell, step) = view.cell(scene, i, j);
            let Some(next) = scene.mean_successor(cell, step) else { continue };
            let (from, to) = match view.across {
                Axis::Time => (f64::from(i), f64::from(i) + 1.0),
                Axis::State(dimension) => (scene.center(dimension, i), next[dimension]),
            };
            let (x, y) = (frame.x.at(from), frame.y.at(scene.center(view.up, j)));
            let (dx, dy) = (frame.x.at(to) - x, frame.y.at(next[view.up]) - y);
            let light = usize::from(level(scene.values.at(step)[cell.index()]) >= FIRST_LIGHT_LEVEL);
            paths[light] += &arrow((x, y), (dx, dy), 0.85 * place);
        }
    }
    let [on_dark, on_light] = paths;
    format!(
        "<path class=\"arrow on-dark\" d=\"{on_dark}\"/><path class=\"arrow on-light\" d=\"{on_light}\"/>"
    )
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

/// The runs: lines through the grouped instants, the failed ones last and so on top.
pub(super) fn runs(scene: &Scene<'_>, view: &View, frame: &Frame) -> String {
    let d = scene.group_steps as f64;
    let mut drawn = [String::new(), String::new()];
    for trajectory in &scene.trajectories {
        let pair = |step: u64, state: &[f64]| {
            let across = match view.across {
                Axis::Time => step as f64 / d,
                Axis::State(dimension) => state[dimension],
            };
            format!("{} {}", coordinate(frame.x.at(across)), coordinate(frame.y.at(state[view.up])))
        };
        let asked = trajectory.steps.iter().filter(|step| step.decision.is_some());
        let pairs: Vec<_> = asked.map(|step| pair(step.step, &step.state)).collect();
        let class = class(trajectory);
        // A line of no length with round ends is a dot.
        let dots: String = pairs.iter().map(|pair| format!("M{pair}h0")).collect();
        let line = format!("M{}", pairs.join("L"));
        drawn[usize::from(!trajectory.outcome.satisfied)] += &format!(
            "<path class=\"casing\" d=\"{line}\"/><path class=\"{class}\" d=\"{line}\"/><path class=\"dots {class}\" \
             d=\"{dots}\"/>"
        );
    }
    let text = drawn.concat();
    let start: Vec<_> = match view.across {
        Axis::Time => vec![0.0, scene.start[view.up]],
        Axis::State(dimension) => vec![scene.start[dimension], scene.start[view.up]],
    };
    text + &format!(
        "<circle class=\"start\" cx=\"{}\" cy=\"{}\" r=\"4.5\"/>",
        coordinate(frame.x.at(start[0])),
        coordinate(frame.y.at(start[1]))
    )
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
