//! The frame of a plot: where its numbers lie, and its axes.

use super::markup::escape;
use super::numbers::{coordinate, short, ticks};

/// A linear map from numbers to coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    pub(super) from: f64,
    pub(super) to: f64,
    start: f64,
    end: f64,
}

impl Scale {
    /// The coordinate of `x`.
    pub(super) fn at(&self, x: f64) -> f64 {
        self.start + (x - self.from) / (self.to - self.from) * (self.end - self.start)
    }
}

/// The rectangle that a plot fills.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) x: Scale,
    pub(super) y: Scale,
}

impl Frame {
    /// A frame of a given size for `x` in `across` and `y` in `up`.
    pub(super) fn new(size: (f64, f64), across: (f64, f64), up: (f64, f64)) -> Self {
        Self::at(64.0, size, across, up)
    }

    /// A frame as large as fits into `size`, and in the middle of it, where both axes have the same scale.
    pub(super) fn equal(size: (f64, f64), across: (f64, f64), up: (f64, f64)) -> Self {
        let scale = (size.0 / (across.1 - across.0)).min(size.1 / (up.1 - up.0));
        let fitting = (((across.1 - across.0) * scale).round(), ((up.1 - up.0) * scale).round());
        Self::at(64.0 + ((size.0 - fitting.0) / 2.0).floor(), fitting, across, up)
    }

    fn at(left: f64, size: (f64, f64), across: (f64, f64), up: (f64, f64)) -> Self {
        let (top, (width, height)) = (16.0, size);
        let x = Scale { from: across.0, to: across.1, start: left, end: left + width };
        let y = Scale { from: up.0, to: up.1, start: top + height, end: top };
        Self { left, top, width, height, x, y }
    }

    /// The clip path that keeps drawings inside.
    pub(super) fn clip(&self, id: &str) -> String {
        let Self { left, top, width, height, .. } = self;
        format!(
            "<clipPath id=\"{id}-clip\"><rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\"/></clipPath>\n"
        )
    }

    /// Border, ticks, and names of the axes.
    pub(super) fn axes(&self, across: &str, up: &str) -> String {
        let label = |tick: f64| (tick, short(tick));
        let marks =
            |scale: &Scale, count| ticks(scale.from, scale.to, count).into_iter().map(label).collect();
        self.labelled((across, marks(&self.x, 7.0)), (up, marks(&self.y, 6.0)))
    }

    /// Border, ticks that say something else than where they are, and names of the axes.
    pub(super) fn labelled(
        &self,
        (across, marks_across): (&str, Vec<(f64, String)>),
        (up, marks_up): (&str, Vec<(f64, String)>),
    ) -> String {
        let Self { left, top, width, height, x, y } = *self;
        let bottom = top + height;
        let mut text = format!(
            "<rect class=\"border\" x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\"/>"
        );
        for (tick, label) in marks_across {
            let at = coordinate(x.at(tick));
            text += &format!(
                "<path class=\"tick\" d=\"M{at} {bottom}v5\"/><text class=\"number\" x=\"{at}\" y=\"{}\" \
                 text-anchor=\"middle\">{label}</text>",
                bottom + 18.0
            );
        }
        for (tick, label) in marks_up {
            let at = y.at(tick);
            text += &format!(
                "<path class=\"tick\" d=\"M{left} {}h-5\"/><text class=\"number\" x=\"{}\" y=\"{}\" \
                 text-anchor=\"end\">{label}</text>",
                coordinate(at),
                left - 8.0,
                coordinate(at + 4.0)
            );
        }
        let (middle, half) = (left + width / 2.0, top + height / 2.0);
        text += &format!(
            "<text class=\"name\" x=\"{middle}\" y=\"{}\" text-anchor=\"middle\">{}</text><text class=\"name\" \
             transform=\"translate({} {half}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            bottom + 38.0,
            escape(across),
            left - 48.0,
            escape(up)
        );
        text
    }
}
