//! Goal and unsafe regions in a plane.

use super::frame::{Frame, Scale};
use super::numbers::coordinate;
use super::scene::Scene;
use super::sides::sides;
use super::view::{Axis, View};
use crate::partition::Region;

/// Both regions where they meet the plane: rectangles, outlined as unions.
pub(super) fn regions(scene: &Scene<'_>, view: &View, frame: &Frame, id: &str) -> String {
    let mut text = String::new();
    for (class, list) in [("unsafe", scene.unsafe_), ("goal", scene.wanted)] {
        let boxes: String = list.iter().filter_map(|region| rectangle(scene, view, frame, region)).collect();
        if boxes.is_empty() {
            continue;
        }
        // The fill covers the inner half of the outlines: what is left surrounds the union.
        text += &format!("<path class=\"{class} outline\" d=\"{boxes}\"/>");
        if class == "unsafe" {
            text += &format!("<path class=\"unsafe cover\" d=\"{boxes}\"/>");
            text += &format!("<path fill=\"url(#{id}-hatch)\" d=\"{boxes}\"/>");
        }
    }
    text
}

/// The hatching of the unsafe region.
pub(super) fn hatch(id: &str) -> String {
    format!(
        "<pattern id=\"{id}-hatch\" width=\"7\" height=\"7\" patternUnits=\"userSpaceOnUse\" \
         patternTransform=\"rotate(45)\"><path class=\"hatch\" d=\"M0 0v7\"/></pattern>\n"
    )
}

/// The part of a region in the plane, as a path; `None` if it is elsewhere.
fn rectangle(scene: &Scene<'_>, view: &View, frame: &Frame, region: &Region) -> Option<String> {
    if !view.fixed().all(|j| view.meets(scene, region, j)) {
        return None;
    }
    let across = match view.across {
        Axis::Time => (f64::NEG_INFINITY, f64::INFINITY),
        Axis::State(j) => sides(region, j),
    };
    let (x0, x1) = within(across, &frame.x)?;
    let (y0, y1) = within(sides(region, view.up), &frame.y)?;
    Some(format!("M{x0} {y0}H{x1}V{y1}H{x0}Z"))
}

fn within((lower, upper): (f64, f64), scale: &Scale) -> Option<(String, String)> {
    let (lower, upper) = (lower.max(scale.from), upper.min(scale.to));
    (lower < upper).then(|| (coordinate(scale.at(lower)), coordinate(scale.at(upper))))
}
