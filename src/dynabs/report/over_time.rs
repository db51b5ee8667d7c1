//! States and inputs of the drawn runs over time.

use super::frame::Frame;
use super::markup::{Plot, group};
use super::numbers::coordinate;
use super::paths::shift;
use super::scene::Scene;
use crate::controller::{Trajectory, TrajectoryStep};

/// The most plots of either kind.
const MOST_PLOTS: usize = 12;

/// The most points of a plot.
const MOST_POINTS: usize = 5_000;

/// The size of a frame.
const SIZE: (f64, f64) = (300.0, 120.0);

/// An input: what it is called, and what U leaves of it.
pub(super) struct InputAxis {
    /// Its name, with its unit.
    pub(super) title: String,
    pub(super) limits: Option<(f64, f64)>,
}

/// A plot for every coordinate of the state, then for every input.
pub(super) fn over_time(scene: &Scene<'_>) -> Vec<Plot> {
    let states = (0..scene.dimension().min(MOST_PLOTS)).map(|j| state(scene, j));
    let inputs = (0..scene.inputs.len().min(MOST_PLOTS)).filter_map(|j| input(scene, j));
    states.chain(inputs).collect()
}

/// As many of the first runs as have few points.
fn shown<'s>(scene: &'s Scene<'_>) -> impl Iterator<Item = &'s Trajectory> {
    let mut points = 0;
    scene
        .trajectories
        .iter()
        .enumerate()
        .take_while(move |(i, run)| {
            points += run.steps.len();
            *i == 0 || points <= MOST_POINTS
        })
        .map(|(_, run)| run)
}

/// How many runs the plots show.
pub(super) fn number_of_runs(scene: &Scene<'_>) -> usize {
    shown(scene).count()
}

fn last_step(scene: &Scene<'_>) -> f64 {
    let last = shown(scene).filter_map(|run| run.steps.last()).map(|step| step.step).max();
    last.unwrap_or(1).max(1) as f64
}

fn state(scene: &Scene<'_>, j: usize) -> Plot {
    let frame = Frame::new(SIZE, (0.0, last_step(scene)), scene.range(j));
    let wrap = scene.periods[j].map(|_| frame.height);
    let line = |run: &Trajectory| {
        let place = |step: &TrajectoryStep| (frame.x.at(step.step as f64), frame.y.at(step.state[j]));
        let (mut d, mut before) = (String::new(), None);
        for (x, y) in run.steps.iter().map(place) {
            match before {
                None => d += &format!("M{} {}", coordinate(x), coordinate(y)),
                Some((x0, y0)) => {
                    let dy = shift(y0, y, wrap);
                    if dy != 0.0 {
                        d += &format!(
                            "L{} {}M{} {}",
                            coordinate(x),
                            coordinate(y + dy),
                            coordinate(x0),
                            coordinate(y0 - dy)
                        );
                    }
                    d += &format!("L{} {}", coordinate(x), coordinate(y));
                }
            }
            before = Some((x, y));
        }
        d
    };
    plot(scene, &frame, format!("state-{}", j + 1), &scene.title(j), "", line)
}

/// An input as steps, which hold until the next; `None` where there is nothing to draw.
fn input(scene: &Scene<'_>, j: usize) -> Option<Plot> {
    let InputAxis { title, limits } = &scene.inputs[j];
    let applied =
        || shown(scene).flat_map(|run| &run.steps).filter_map(|step| step.input.as_ref()).map(|u| u[j]);
    let (least, most) = applied()
        .fold(limits.unwrap_or((f64::INFINITY, f64::NEG_INFINITY)), |(least, most), u| {
            (least.min(u), most.max(u))
        });
    if applied().next().is_none() || !(most - least).is_finite() {
        return None;
    }
    let margin = if most > least { 0.08 * (most - least) } else { 1.0 };
    let frame = Frame::new(SIZE, (0.0, last_step(scene)), (least - margin, most + margin));
    let limit = |at: f64| {
        format!(
            "<path class=\"threshold\" d=\"M{} {}h{}\"/>",
            frame.left,
            coordinate(frame.y.at(at)),
            frame.width
        )
    };
    let limits = limits.map_or(String::new(), |(lower, upper)| limit(lower) + &limit(upper));
    let line = |run: &Trajectory| {
        let mut d = String::new();
        for (step, u) in run.steps.iter().filter_map(|step| Some((step.step as f64, step.input.as_ref()?[j])))
        {
            let (x, y) = (coordinate(frame.x.at(step)), coordinate(frame.y.at(u)));
            d += &if d.is_empty() { format!("M{x} {y}") } else { format!("V{y}") };
            d += &format!("H{}", coordinate(frame.x.at(step + 1.0)));
        }
        d
    };
    Some(plot(scene, &frame, format!("input-{}", j + 1), title, &limits, line))
}

fn plot(
    scene: &Scene<'_>,
    frame: &Frame,
    id: String,
    title: &str,
    under: &str,
    line: impl Fn(&Trajectory) -> String,
) -> Plot {
    let traces = |satisfied: bool, class: &str| -> String {
        let runs = shown(scene).filter(|run| run.outcome.satisfied == satisfied).map(&line);
        runs.filter(|d| !d.is_empty()).map(|d| format!("<path class=\"{class}\" d=\"{d}\"/>")).collect()
    };
    let content = format!(
        "<defs>{}</defs>\n<g clip-path=\"url(#{id}-clip)\">\n{}</g>\n{}",
        frame.clip(&id),
        group("traces", &(under.to_owned() + &traces(true, "trace") + &traces(false, "trace lost"))),
        group("axes", &frame.axes("step", title))
    );
    Plot {
        width: frame.left + frame.width + 16.0,
        height: frame.height + 64.0,
        title: format!("{}: {title} over time", scene.name),
        description:
            "Simulated runs; dashed are those that did not satisfy the task, and the limits of the input."
                .into(),
        content,
        id,
    }
}
