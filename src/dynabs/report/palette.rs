//! The colours of values: viridis, perceptually uniform and safe for the colour-blind.

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

/// The level of a probability, `0 .. LEVELS`.
pub(super) fn level(value: f32) -> usize {
    ((f64::from(value) * LEVELS as f64) as usize).min(LEVELS - 1)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn from_dark_to_light() {
        assert_eq!((colour(0), colour(LEVELS - 1)), ("#440154".into(), "#fde725".into()));
        assert_eq!((level(0.0), level(0.5), level(1.0)), (0, LEVELS / 2, LEVELS - 1));
        let light = |level| {
            let text = colour(level);
            let part = |i: usize| f64::from(u8::from_str_radix(&text[i..i + 2], 16).unwrap());
            0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5)
        };
        assert!((1..LEVELS).all(|i| light(i) > light(i - 1)));
    }
}
