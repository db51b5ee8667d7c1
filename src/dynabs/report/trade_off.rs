//! What several settings of a model promise, against what they cost.

use super::frame::Frame;
use super::markup::{Plot, escape, group};
use super::numbers::{coordinate, round_step, short, thousands, ticks};

/// The size of the frame.
const SIZE: (f64, f64) = (632.0, 320.0);

/// Bounds against costs, of one model.
#[derive(Clone, Debug, PartialEq)]
pub struct TradeOff {
    /// What is looked at.
    pub title: String,
    /// What a cost is a number of.
    pub cost: String,
    /// The bound that is wanted, if one is.
    pub wanted: Option<f64>,
    /// The settings.
    pub points: Vec<TradeOffPoint>,
}

/// One setting.
#[derive(Clone, Debug, PartialEq)]
pub struct TradeOffPoint {
    /// What it is called.
    pub name: String,
    /// What it costs, at least 0.
    pub cost: f64,
    /// What it promises: a probability.
    pub bound: f64,
    /// Whether it is the choice.
    pub is_chosen: bool,
}

impl TradeOff {
    /// As an SVG file: the costs on a logarithmic axis, a line above everything that is cheaper, what is wanted, the choice.
    pub fn svg(&self) -> String {
        let id = "trade-off";
        let (across, marks) = self.decades();
        let (up, bounds) = self.bounds();
        let frame = Frame::new(SIZE, across, up);
        let content = format!(
            "<defs>{}</defs>\n<g clip-path=\"url(#{id}-clip)\">\n{}{}</g>\n{}{}",
            frame.clip(id),
            self.wanted(&frame),
            self.best(&frame),
            group("axes", &frame.labelled((&self.cost, marks), ("lower bound", bounds))),
            group("points", &self.drawn(&frame)),
        );
        let plot = Plot {
            id: id.to_owned(),
            width: frame.left + frame.width + 24.0,
            height: frame.height + 64.0,
            title: format!("{}: lower bound over {}", self.title, self.cost),
            description:
                "One dot for every setting that was tried; the line is the best bound for at most so much."
                    .into(),
            content,
        };
        plot.standalone()
    }

    /// From where to where costs go, as powers of ten, and round numbers between.
    fn decades(&self) -> ((f64, f64), Vec<(f64, String)>) {
        let powers = self.points.iter().map(|point| power(point.cost));
        let (least, most) = powers.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        let (least, most) = if least <= most { (least, most) } else { (0.0, 1.0) };
        let (from, to) = ((least * 4.0 - 0.25).floor() / 4.0, (most * 4.0 + 0.25).ceil() / 4.0);
        let parts: &[f64] = if to - from > 3.0 { &[1.0] } else { &[1.0, 2.0, 5.0] };
        let decades = from.floor() as i32..=to.ceil() as i32;
        let numbers = decades.flat_map(|decade| parts.iter().map(move |part| part * 10f64.powi(decade)));
        let marks = numbers.map(|number| (number.log10(), thousands(number.round() as u64)));
        ((from, to), marks.filter(|&(at, _)| at >= from - 1e-9 && at <= to + 1e-9).collect())
    }

    /// From where to where bounds go, and round numbers between: to 1, and no farther down than needed.
    fn bounds(&self) -> ((f64, f64), Vec<(f64, String)>) {
        let all = self.points.iter().map(|point| point.bound).chain(self.wanted);
        let least = all.fold(1.0, f64::min);
        let step = round_step(((1.0 - least) / 5.0).max(1e-6));
        let from = ((least / step - 0.1).floor() * step).max(0.0);
        let margin = (1.0 - from) * 0.05;
        let marks = ticks(from, 1.0, 6.0).into_iter().map(|tick| (tick, short(tick)));
        ((from - margin, 1.0 + margin), marks.collect())
    }

    fn wanted(&self, frame: &Frame) -> String {
        self.wanted.map_or(String::new(), |wanted| {
            let y = coordinate(frame.y.at(wanted));
            format!("<path class=\"threshold\" d=\"M{} {y}h{}\"/>", frame.left, frame.width)
        })
    }

    /// The best bound of all that cost at most so much.
    fn best(&self, frame: &Frame) -> String {
        let mut points: Vec<&TradeOffPoint> = self.points.iter().collect();
        points.sort_by(|one, other| one.cost.total_cmp(&other.cost).then(other.bound.total_cmp(&one.bound)));
        let (mut d, mut best) = (String::new(), f64::NEG_INFINITY);
        for point in points.into_iter().filter(|point| point.bound.is_finite()) {
            if point.bound > best {
                best = point.bound;
                let [x, y] = at(frame, point);
                d += &if d.is_empty() { format!("M{x} {y}") } else { format!("H{x}V{y}") };
            }
        }
        match d.is_empty() {
            true => d,
            false => format!("<path class=\"value\" d=\"{d}H{}\"/>", frame.left + frame.width),
        }
    }

    fn drawn(&self, frame: &Frame) -> String {
        let dot = |point: &TradeOffPoint| {
            let [x, y] = at(frame, point);
            let mark = match point.is_chosen {
                true => format!(
                    "<circle class=\"start\" cx=\"{x}\" cy=\"{y}\" r=\"6\"/><text class=\"number\" x=\"{x}\" y=\"{}\" \
                     text-anchor=\"middle\">{}</text>",
                    coordinate(frame.y.at(point.bound) + 22.0),
                    escape(&point.name)
                ),
                false => format!("<circle class=\"bar\" cx=\"{x}\" cy=\"{y}\" r=\"4\"/>"),
            };
            format!("<g><title>{}: {}</title>{mark}</g>\n", escape(&point.name), short(point.bound))
        };
        self.points.iter().map(dot).collect()
    }
}

/// Where a setting is drawn.
fn at(frame: &Frame, point: &TradeOffPoint) -> [String; 2] {
    [coordinate(frame.x.at(power(point.cost))), coordinate(frame.y.at(point.bound))]
}

/// The power of ten that a cost is; nothing costs as much as one.
fn power(cost: f64) -> f64 {
    cost.max(1.0).log10()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(cost: f64, bound: f64, is_chosen: bool) -> TradeOffPoint {
        TradeOffPoint { name: "<1>".into(), cost, bound, is_chosen }
    }

    #[test]
    fn the_line_is_the_best_for_the_money() {
        let points = vec![point(1000.0, 0.9, true), point(10.0, 0.5, false), point(100.0, 0.4, false)];
        let plot = TradeOff { title: "a & b".into(), cost: "cells".into(), wanted: Some(0.8), points };
        let ((from, to), marks) = plot.decades();
        assert!(from <= 1.0 && to >= 3.0 && from > 0.0 && to < 4.0);
        assert!(marks.contains(&(2.0, "100".into())) && marks.contains(&(3.0, "1,000".into())));
        let svg = plot.svg();
        let line = svg.split("class=\"value\" d=\"").nth(1).unwrap().split('"').next().unwrap();
        // One step: the second setting costs more than the first and promises less.
        assert_eq!((line.matches('V').count(), line.matches('M').count()), (1, 1), "{line}");
        assert!(svg.contains("class=\"threshold\"") && svg.contains("&lt;1&gt;") && !svg.contains("var("));
        assert_eq!(svg.matches("class=\"start\"").count(), 1);
    }

    #[test]
    fn nothing_is_a_picture_too() {
        let plot = TradeOff { title: String::new(), cost: "cells".into(), wanted: None, points: vec![] };
        assert!(plot.svg().contains("</svg>") && !plot.svg().contains("NaN"));
        let plot = TradeOff { points: vec![point(0.0, 1.0, false)], ..plot };
        assert!(!plot.svg().contains("NaN") && !plot.svg().contains("inf"));
    }
}
