//! Outlines of the regions that a task names, in a plane.

use super::frame::Frame;
use super::markup::escape;
use super::numbers::coordinate;
use super::scene::Scene;
use super::view::{Axis, View};
use crate::task::{HalfSpace, NamedRegion};

/// A region with a name, as shapes that are intersections of half-spaces.
pub(super) struct Outlined {
    pub(super) name: String,
    pub(super) shapes: Vec<Vec<HalfSpace>>,
}

impl Outlined {
    /// The regions of a task; what is unsafe is drawn as such.
    pub(super) fn of(regions: &[NamedRegion]) -> Vec<Self> {
        let named = regions.iter().filter(|region| region.name != "unsafe");
        named.map(|region| Self { name: region.name.clone(), shapes: region.half_spaces() }).collect()
    }
}

/// The outline and the name of every region where the plane through the center of the picked cell cuts it.
pub(super) fn outlines(scene: &Scene<'_>, view: &View, frame: &Frame) -> String {
    let outline = |region: &Outlined| {
        let polygons = region.shapes.iter().map(|shape| cut(scene, view, frame, shape));
        let polygons: Vec<_> = polygons.filter(|polygon| polygon.len() > 2).collect();
        let (x, y) = middle(polygons.first()?, frame);
        let d: String = polygons.iter().map(|polygon| path(polygon, frame)).collect();
        let name = escape(&region.name);
        // The halo is a text of its own: not all programs know the order of painting.
        let text = |class: &str| {
            format!("<text class=\"{class}\" x=\"{x}\" y=\"{y}\" text-anchor=\"middle\">{name}</text>")
        };
        Some(format!(
            "<path class=\"casing\" d=\"{d}\"/><path class=\"named outline\" d=\"{d}\"/>{}{}",
            text("halo"),
            text("named")
        ))
    };
    scene.named.iter().filter_map(outline).collect()
}

/// What half-spaces leave of the frame (the corners of a convex polygon), by cutting off one after the other.
fn cut(scene: &Scene<'_>, view: &View, frame: &Frame, shape: &[HalfSpace]) -> Vec<(f64, f64)> {
    let (x, y) = (&frame.x, &frame.y);
    let mut polygon = vec![(x.from, y.from), (x.to, y.from), (x.to, y.to), (x.from, y.to)];
    for HalfSpace { normal, offset, .. } in shape {
        let center = |j: usize| scene.center(j, view.slice[j]);
        let offset = view.fixed().fold(*offset, |offset, j| offset - normal[j] * center(j));
        let across = match view.across {
            Axis::Time => 0.0,
            Axis::State(j) => normal[j],
        };
        let room = |&(x, y): &(f64, f64)| offset - across * x - normal[view.up] * y;
        let ends = polygon.iter().zip(polygon.iter().cycle().skip(1));
        let kept = ends.flat_map(|(from, to)| {
            let (before, after) = (room(from), room(to));
            let share = before / (before - after);
            let crossing = (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1));
            let crosses = (before >= 0.0) != (after >= 0.0);
            [(before >= 0.0).then_some(*from), crosses.then_some(crossing)].into_iter().flatten()
        });
        polygon = kept.collect();
    }
    polygon
}

fn path(polygon: &[(f64, f64)], frame: &Frame) -> String {
    let corner =
        |&(x, y): &(f64, f64)| format!("{} {}", coordinate(frame.x.at(x)), coordinate(frame.y.at(y)));
    format!("M{}Z", polygon.iter().map(corner).collect::<Vec<_>>().join("L"))
}

/// The mean of the corners.
fn middle(polygon: &[(f64, f64)], frame: &Frame) -> (String, String) {
    let sum = polygon.iter().fold((0.0, 0.0), |sum, corner| (sum.0 + corner.0, sum.1 + corner.1));
    let number = polygon.len() as f64;
    (coordinate(frame.x.at(sum.0 / number)), coordinate(frame.y.at(sum.1 / number)))
}
