//! Numbers as they are shown.

use imdp::numeric::shortest_decimal;

/// A number with up to six significant digits and a real minus sign.
pub(super) fn short(x: f64) -> String {
    let rounded = format!("{x:.5e}").parse().unwrap_or(x);
    shortest_decimal(rounded + 0.0).replace('-', "−")
}

/// A coordinate of a plot: two decimals at most.
pub(super) fn coordinate(x: f64) -> String {
    let text = format!("{x:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// `x` with six significant digits, for embedding.
pub(super) fn compact(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(x)
}

/// `x1` with a real subscript.
pub(super) fn subscripted(name: &str, index: usize) -> String {
    let digits = index.to_string();
    let lowered = digits.chars().map(|digit| {
        let value = digit.to_digit(10).unwrap_or_default();
        char::from_u32(0x2080 + value).unwrap_or(digit)
    });
    name.chars().chain(lowered).collect()
}

/// `(1, 2, 3)`.
pub(super) fn tuple(x: &[f64]) -> String {
    format!("({})", x.iter().map(|&x| short(x)).collect::<Vec<_>>().join(", "))
}

/// 1, 2 or 5 times a power of ten, at least `rough`.
pub(super) fn round_step(rough: f64) -> f64 {
    let power = 10f64.powf(rough.log10().floor());
    [1.0, 2.0, 5.0, 10.0].iter().map(|m| m * power).find(|step| *step >= rough).unwrap_or(rough)
}

/// Round numbers in `[from, to]`, about `count` of them, 1, 2 or 5 times a power of ten apart.
pub(super) fn ticks(from: f64, to: f64, count: f64) -> Vec<f64> {
    let step = round_step((to - from) / count);
    // Ends that are ticks but for a rounding error count.
    let slack = 1e-9;
    let (first, last) = ((from / step - slack).ceil(), (to / step + slack).floor());
    (0..).map(|i| first + f64::from(i)).take_while(|i| *i <= last).map(|i| compact(i * step)).collect()
}

/// A number with commas between groups of three digits.
pub fn thousands(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::with_capacity(digits.len() * 4 / 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!(short(-0.123_456_789), "−0.123457");
        assert_eq!((short(0.0), short(-0.0), short(1e-7)), ("0".into(), "0".into(), "1e−7".into()));
        assert_eq!(
            (coordinate(-0.001), coordinate(12.5), coordinate(300.0)),
            ("0".into(), "12.5".into(), "300".into())
        );
        assert_eq!(subscripted("x", 12), "x₁₂");
    }

    #[test]
    fn ticks_are_round() {
        assert_eq!(ticks(-41.0, 41.0, 6.0), [-40.0, -20.0, 0.0, 20.0, 40.0]);
        assert_eq!(ticks(0.0, 1.0, 5.0), [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]);
        assert_eq!(ticks(-0.02, 0.02, 4.0), [-0.02, -0.01, 0.0, 0.01, 0.02]);
    }

    #[test]
    fn groups_of_three() {
        let numbers = [(0, "0"), (999, "999"), (1_000, "1,000"), (39_773_745, "39,773,745")];
        for (n, text) in numbers {
            assert_eq!(thousands(n), text);
        }
    }
}
