//! The colours of values: viridis, perceptually uniform and safe for the colour-blind.

use super::numbers::{compact, round_step, short, ticks};

/// Viridis (S. van der Walt, N. Smith; CC0) at sixteen equally spaced places.
const STOPS: [[u8; 3]; 16] = [
    [0x44, 0x01, 0x54],
    [0x48, 0x1a, 0x6c],
    [0x47, 0x2f, 0x7d],
    [0x41, 0x44, 0x87],
    [0x39, 0x56, 0x8c],
    [0x31, 0x68, 0x8e],
    [0x2a, 0x78, 0x8e],
    [0x23, 0x88, 0x8e],
    [0x1f, 0x98, 0x8b],
    [0x22, 0xa8, 0x84],
    [0x35, 0xb7, 0x79],
    [0x54, 0xc5, 0x68],
    [0x7a, 0xd1, 0x51],
    [0xa5, 0xdb, 0x36],
    [0xd2, 0xe2, 0x1b],
    [0xfd, 0xe7, 0x25],
];

/// How many colours are told apart.
pub(super) const LEVELS: usize = 64;

/// From this level on, dark ink is easier to see than light.
pub(super) const FIRST_LIGHT_LEVEL: usize = 40;

/// The values that colours tell apart: from the darkest to the lightest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ColourScale {
    pub(super) from: f64,
    pub(super) to: f64,
}

impl ColourScale {
    /// Values that differ little have all colours between them, any others those from 0 to 1.
    pub(super) fn fitted(values: impl Iterator<Item = f32>) -> Self {
        let (least, most) = values
            .map(f64::from)
            .fold((1.0, 0.0), |(least, most): (f64, f64), value| (least.min(value), most.max(value)));
        if least > most || most - least >= 0.5 {
            return Self { from: 0.0, to: 1.0 };
        }
        let step = round_step((most - least).max(0.01) / 4.0);
        let to = compact(((most / step - 1e-9).ceil() * step).clamp(step, 1.0));
        let from = compact(((least / step + 1e-9).floor() * step).min(to - step).max(0.0));
        Self { from, to }
    }

    /// The level of a value, `0 .. LEVELS`.
    pub(super) fn level(&self, value: f32) -> usize {
        let share = (f64::from(value) - self.from) / (self.to - self.from);
        ((share * LEVELS as f64).max(0.0) as usize).min(LEVELS - 1)
    }

    /// What stands beside a bar of all colours, with the places: the ends, and round numbers between them.
    pub(super) fn labels(&self) -> Vec<(f64, String)> {
        let Self { from, to } = *self;
        let share = |x: f64| (x - from) / (to - from);
        let mut labels = vec![(0.0, if from > 0.0 { format!("≤ {}", short(from)) } else { short(from) })];
        let inner = ticks(from, to, 5.0).into_iter().filter(|&x| (0.05..=0.95).contains(&share(x)));
        labels.extend(inner.map(|x| (share(x), short(x))));
        labels.push((1.0, if to < 1.0 { format!("≥ {}", short(to)) } else { short(to) }));
        labels
    }
}

/// The colour of a level, as `#rrggbb`.
pub(super) fn colour(level: usize) -> String {
    let position = level as f64 / (LEVELS - 1) as f64 * (STOPS.len() - 1) as f64;
    let below = (position as usize).min(STOPS.len() - 2);
    let part = position - below as f64;
    let mix = |i: usize| {
        let (a, b) = (f64::from(STOPS[below][i]), f64::from(STOPS[below + 1][i]));
        (a + (b - a) * part).round() as u8
    };
    format!("#{:02x}{:02x}{:02x}", mix(0), mix(1), mix(2))
}

/// One of many colours that are told apart, none of them so dark that dark ink is hard to see on it, as `#rrggbb`.
pub(super) fn distinct(number: usize) -> String {
    // The golden angle: those that follow each other are far apart, and none comes again.
    let hue = (number as f64 * 137.508).rem_euclid(360.0) / 60.0;
    let light = [0.72, 0.6, 0.82][number % 3];
    let chroma = 0.55 * (1.0_f64 - (2.0 * light - 1.0_f64).abs());
    let part = |shift: f64| {
        let place = (hue + shift).rem_euclid(6.0);
        let share = (2.0 - (place - 3.0).abs()).clamp(0.0, 1.0);
        ((light + chroma * (share - 0.5)) * 255.0).round() as u8
    };
    format!("#{:02x}{:02x}{:02x}", part(3.0), part(1.0), part(5.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_that_differ_little_differ_in_colour() {
        let fitted = |values: &[f32]| {
            let scale = ColourScale::fitted(values.iter().copied());
            (scale.from, scale.to)
        };
        assert_eq!(fitted(&[0.0, 0.7]), (0.0, 1.0));
        assert_eq!(fitted(&[]), (0.0, 1.0));
        assert_eq!(fitted(&[0.912, 0.988]), (0.9, 1.0));
        assert_eq!(fitted(&[1.0]), (0.995, 1.0));
        assert_eq!(fitted(&[0.0]), (0.0, 0.005));
        let scale = ColourScale { from: 0.9, to: 0.98 };
        assert_eq!([0.2, 0.9, 0.99].map(|value| scale.level(value)), [0, 0, LEVELS - 1]);
        let labels: Vec<_> = scale.labels().into_iter().map(|(_, text)| text).collect();
        assert_eq!(labels, ["≤ 0.9", "0.92", "0.94", "0.96", "≥ 0.98"]);
    }

    #[test]
    fn from_dark_to_light() {
        assert_eq!((colour(0), colour(LEVELS - 1)), ("#440154".into(), "#fde725".into()));
        let whole = ColourScale { from: 0.0, to: 1.0 };
        assert_eq!([0.0, 0.5, 1.0].map(|value| whole.level(value)), [0, LEVELS / 2, LEVELS - 1]);
        let light = |level| {
            let text = colour(level);
            let part = |i: usize| f64::from(u8::from_str_radix(&text[i..i + 2], 16).unwrap());
            0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5)
        };
        assert!((1..LEVELS).all(|i| light(i) > light(i - 1)));
    }
}
