//! The value function over a plane.

use super::frame::Frame;
use super::markup::{Plot, group};
use super::numbers::{coordinate, short};
use super::outlines::outlines;
use super::palette::{LEVELS, colour};
use super::paths::{arrows, runs};
use super::regions::{hatch, regions};
use super::scene::Scene;
use super::tiles::tiles;
use super::view::View;
use std::ops::Range;

/// The size of the frame of the map.
const SIZE: (f64, f64) = (548.0, 420.0);

/// The value function over a plane, with regions, vector field and runs.
pub(super) fn heat_map(scene: &Scene<'_>, view: &View) -> Plot {
    let id = "map";
    let frame = map_frame(scene, view);
    let (across, up) = view.names(scene);
    let inside = [
        group("heat", &squares(scene, view, &frame)),
        group("regions", &(regions(scene, view, &frame, id) + &outlines(scene, view, &frame))),
        group("arrows", &arrows(scene, view, &frame)),
        group("runs", &runs(scene, view, &frame)),
        group("pick", ""),
    ];
    let content = format!(
        "<defs>{}{}{}</defs>\n<g clip-path=\"url(#{id}-clip)\">\n{}</g>\n{}{}",
        frame.clip(id),
        hatch(id),
        gradient(),
        inside.concat(),
        group("axes", &frame.axes(&across, &up)),
        group("scale", &colour_bar(scene, &frame)),
    );
    Plot {
        id: id.to_owned(),
        width: 720.0,
        height: frame.height + 64.0,
        title: format!("{}: {} over {across} and {up}", scene.name, scene.value_name()),
        description: description(scene, view),
        content,
    }
}

/// The frame of a map of a plane.
pub(super) fn map_frame(scene: &Scene<'_>, view: &View) -> Frame {
    let frame_of = if view.is_equal(scene) { Frame::equal } else { Frame::new };
    frame_of(SIZE, view.range_across(scene), scene.range(view.up))
}

/// What a heat map shows, in words.
fn description(scene: &Scene<'_>, view: &View) -> String {
    let at = view.at(scene, view.fixed());
    format!(
        "The {}{at}, from dark ({}) to light ({}); the unsafe region is hatched, the \
         {} outlined; arrows point from the centers of cells towards the mean of the next state; lines are {} \
         simulated runs.",
        scene.value_name(),
        short(scene.scale.from),
        short(scene.scale.to),
        scene.wanted_name,
        scene.trajectories.len()
    )
}

/// One path per colour.
fn squares(scene: &Scene<'_>, view: &View, frame: &Frame) -> String {
    let level = |columns: Range<u32>, rows: Range<u32>| {
        let least = columns.flat_map(|i| rows.clone().map(move |j| (i, j))).map(|(i, j)| {
            let (cell, step) = view.cell(scene, i, j);
            scene.values.at(step)[cell.index()]
        });
        Some(scene.scale.level(least.fold(1.0, f32::min)))
    };
    let paths = tiles((scene, view), frame, LEVELS, level);
    let drawn = paths.iter().enumerate().filter(|(_, path)| !path.is_empty());
    drawn.map(|(level, path)| format!("<path fill=\"{}\" d=\"{path}\"/>", colour(level))).collect()
}

fn gradient() -> String {
    let stops = (0..LEVELS).map(|level| {
        let offset = coordinate(level as f64 / (LEVELS - 1) as f64);
        format!("<stop offset=\"{offset}\" stop-color=\"{}\"/>", colour(level))
    });
    format!(
        "<linearGradient id=\"map-colours\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">{}</linearGradient>\n",
        stops.collect::<String>()
    )
}

/// All colours, with the values that they stand for, and what these are.
fn colour_bar(scene: &Scene<'_>, frame: &Frame) -> String {
    let left = frame.left + frame.width + 20.0;
    let (top, height) = (frame.top, frame.height);
    let mut text = format!(
        "<rect class=\"border\" fill=\"url(#map-colours)\" x=\"{left}\" y=\"{top}\" width=\"16\" height=\"{height}\" \
         style=\"fill:url(#map-colours)\"/>"
    );
    for (place, label) in scene.scale.labels() {
        let y = top + height * (1.0 - place);
        text += &format!(
            "<path class=\"tick\" d=\"M{} {}h5\"/><text class=\"number\" x=\"{}\" y=\"{}\">{}</text>",
            left + 16.0,
            coordinate(y),
            left + 25.0,
            coordinate(y + 4.0),
            label
        );
    }
    let (x, middle) = (left + 84.0, top + height / 2.0);
    let name = scene.value_name();
    text + &format!(
        "<text class=\"name\" transform=\"translate({x} {middle}) rotate(-90)\" text-anchor=\"middle\">{name}</text>"
    )
}
