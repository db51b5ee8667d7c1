//! The value function along one dimension.

use super::frame::Frame;
use super::markup::{Plot, group};
use super::numbers::coordinate;
use super::regions::hatch;
use super::scene::Scene;
use super::sides::sides;
use super::view::{Axis, View};
use crate::partition::Region;

/// The size of the frame of a cross-section.
const SIZE: (f64, f64) = (632.0, 220.0);

/// The value through the plane's cell, along the plane's first dimension of the state.
pub(super) fn section(scene: &Scene<'_>, view: &View) -> Plot {
    let id = "section";
    let along = match view.across {
        Axis::State(j) => j,
        Axis::Time => view.up,
    };
    let frame = Frame::new(SIZE, scene.range(along), (0.0, 1.05));
    let name = scene.names[along].clone();
    let content = format!(
        "<defs>{}{}</defs>\n<g clip-path=\"url(#{id}-clip)\">\n{}{}</g>\n{}",
        frame.clip(id),
        hatch(id),
        group("regions", &bands(scene, view, along, &frame)),
        group("curve", &curve(scene, view, along, &frame)),
        group("axes", &frame.axes(&scene.title(along), scene.value_name()))
    );
    let at = view.at(scene, (0..scene.dimension()).filter(|&j| j != along));
    Plot {
        id: id.to_owned(),
        width: 720.0,
        height: 284.0,
        title: format!("{}: {} along {name}{at}", scene.name, scene.value_name()),
        description: "A step function, constant in every cell; goal and unsafe region are bands.".into(),
        content,
    }
}

/// The parts of the line that lie in the goal or the unsafe region.
fn bands(scene: &Scene<'_>, view: &View, along: usize, frame: &Frame) -> String {
    let on_line = |region: &&Region| {
        (0..scene.dimension()).filter(|&j| j != along).all(|j| view.meets(scene, region, j))
    };
    let bottom = frame.top + frame.height;
    let path = |list: &[Region]| -> String {
        let band = |region: &Region| {
            let (lower, upper) = sides(region, along);
            let (lower, upper) = (lower.max(frame.x.from), upper.min(frame.x.to));
            let [x0, x1] = [lower, upper].map(|x| coordinate(frame.x.at(x)));
            if lower < upper { format!("M{x0} {}H{x1}V{bottom}H{x0}Z", frame.top) } else { String::new() }
        };
        list.iter().filter(on_line).map(band).collect()
    };
    let (avoid, goal) = (path(scene.unsafe_), path(scene.wanted));
    let mut text = String::new();
    if !avoid.is_empty() {
        text += &format!("<path fill=\"url(#section-hatch)\" d=\"{avoid}\"/>");
    }
    if !goal.is_empty() {
        text += &format!("<path class=\"goal band\" d=\"{goal}\"/>");
    }
    text
}

/// The values as a step function, and the threshold if there is one.
fn curve(scene: &Scene<'_>, view: &View, along: usize, frame: &Frame) -> String {
    let values = scene.values.at(view.step);
    let mut coordinates = view.slice.clone();
    let faces = &scene.faces()[along];
    let cells = faces.len() - 1;
    let (mut d, mut before) = (String::new(), String::new());
    for (i, &face) in faces[..cells].iter().enumerate() {
        coordinates[along] = i as u32;
        let value = values[scene.grid.cell(&coordinates).index()];
        let y = coordinate(frame.y.at(f64::from(value)));
        match i {
            0 => d += &format!("M{} {y}", frame.left),
            _ if y != before => d += &format!("H{}V{y}", coordinate(frame.x.at(face))),
            _ => {}
        }
        before = y;
    }
    d += &format!("H{}", coordinate(frame.x.at(faces[cells])));
    let threshold = scene.threshold.map_or(String::new(), |threshold| {
        let y = coordinate(frame.y.at(threshold));
        format!("<path class=\"threshold\" d=\"M{} {y}h{}\"/>", frame.left, frame.width)
    });
    format!("{threshold}<path class=\"value\" d=\"{d}\"/>")
}
