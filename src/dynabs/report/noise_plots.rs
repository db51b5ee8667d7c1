//! The noise, and cells to compare it with.

use super::frame::Frame;
use super::markup::{Plot, group};
use super::numbers::coordinate;
use super::scene::Scene;
use super::view::{Axis, View};

/// How much of the noise is drawn.
pub(super) const DRAWN: usize = 1000;

/// The most bars of a plot, and the most lines between cells.
const MOST_BARS: f64 = 60.0;

/// The most plots of single coordinates.
const MOST_PLOTS: usize = 12;

/// The noise in the plane of the first view, if it has two coordinates, then coordinate by coordinate.
pub(super) fn noise_plots(scene: &Scene<'_>, view: &View) -> Vec<Plot> {
    let is_noisy = |j: &usize| scene.noise_draws.iter().any(|draw| draw[*j] != 0.0);
    let plane = match view.across {
        Axis::State(across) if is_noisy(&across) && is_noisy(&view.up) => {
            Some(scatter(scene, across, view.up))
        }
        _ => None,
    };
    let single = (0..scene.dimension()).filter(is_noisy).take(MOST_PLOTS).map(|j| bars(scene, j));
    plane.into_iter().chain(single).collect()
}

fn cell_width(scene: &Scene<'_>, j: usize) -> f64 {
    let (lower, upper) = scene.range(j);
    (upper - lower) / (scene.faces()[j].len() - 1) as f64
}

/// As far from 0 as the noise goes, and one and a half cells at least.
fn extent(scene: &Scene<'_>, j: usize) -> f64 {
    let farthest = scene.noise_draws.iter().map(|draw| draw[j].abs()).fold(0.0, f64::max);
    (1.05 * farthest).max(1.5 * cell_width(scene, j))
}

/// The faces of cells, one of which has 0 in its middle; none if they were too many.
fn faces(scene: &Scene<'_>, j: usize) -> Vec<f64> {
    let (width, extent) = (cell_width(scene, j), extent(scene, j));
    let most = (extent / width - 0.5).floor();
    if 2.0 * most > MOST_BARS {
        return vec![];
    }
    let count = 2 * most as usize + 2;
    (0..count).map(|i| (i as f64 - most - 0.5) * width).collect()
}

fn scatter(scene: &Scene<'_>, across: usize, up: usize) -> Plot {
    let (x, y) = (extent(scene, across), extent(scene, up));
    let frame = Frame::new((300.0, 240.0), (-x, x), (-y, y));
    let upright = faces(scene, across)
        .into_iter()
        .map(|x| format!("M{} {}v{}", coordinate(frame.x.at(x)), frame.top, frame.height));
    let level = faces(scene, up)
        .into_iter()
        .map(|y| format!("M{} {}h{}", frame.left, coordinate(frame.y.at(y)), frame.width));
    let dot = |draw: &Vec<f64>| {
        format!("M{} {}h0", coordinate(frame.x.at(draw[across])), coordinate(frame.y.at(draw[up])))
    };
    let content = format!(
        "<path class=\"tick\" d=\"{}\"/><path class=\"sample\" d=\"{}\"/>",
        upright.chain(level).collect::<String>(),
        scene.noise_draws.iter().map(dot).collect::<String>()
    );
    plot(scene, &frame, "noise".into(), (&noise_of(scene, across), &noise_of(scene, up)), &content)
}

/// Shares of the noise, by cells.
fn bars(scene: &Scene<'_>, j: usize) -> Plot {
    let cells = faces(scene, j);
    let (extent, width) = (extent(scene, j), cell_width(scene, j));
    // Where cells are too small to be seen bars are wider.
    let width = if cells.is_empty() { 2.0 * extent / MOST_BARS } else { width };
    let most = (extent / width).ceil();
    let mut numbers = vec![0usize; 2 * most as usize + 1];
    for draw in &scene.noise_draws {
        let i = (draw[j] / width).round().clamp(-most, most) + most;
        numbers[i as usize] += 1;
    }
    let share = |number: usize| number as f64 / scene.noise_draws.len() as f64;
    let highest = numbers.iter().map(|&number| share(number)).fold(0.0, f64::max);
    let frame = Frame::new((300.0, 120.0), (-extent, extent), (0.0, 1.05 * highest));
    let bar = |(i, &number): (usize, &usize)| {
        let center = (i as f64 - most) * width;
        let [x0, x1] = [center - width / 2.0, center + width / 2.0].map(|x| coordinate(frame.x.at(x)));
        format!("M{x0} {}H{x1}V{}H{x0}Z", coordinate(frame.y.at(share(number))), coordinate(frame.y.at(0.0)))
    };
    let drawn: String = numbers.iter().enumerate().filter(|(_, number)| **number > 0).map(bar).collect();
    let content = format!("<path class=\"bar\" d=\"{drawn}\"/>");
    plot(scene, &frame, format!("noise-{}", j + 1), (&noise_of(scene, j), "share"), &content)
}

fn noise_of(scene: &Scene<'_>, j: usize) -> String {
    format!("noise of {}", scene.title(j))
}

fn plot(scene: &Scene<'_>, frame: &Frame, id: String, (across, up): (&str, &str), content: &str) -> Plot {
    let content = format!(
        "<defs>{}</defs>\n<g clip-path=\"url(#{id}-clip)\">\n{content}</g>\n{}",
        frame.clip(&id),
        group("axes", &frame.axes(across, up))
    );
    Plot {
        width: frame.left + frame.width + 16.0,
        height: frame.height + 64.0,
        title: format!("{}: {up} over {across}", scene.name),
        description: "What is known of the noise, beside cells, one of which has 0 in its middle.".into(),
        content,
        id,
    }
}
