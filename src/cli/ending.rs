//! The last line of a summary: the verdict, and the value against its threshold.

use imdp::numeric::{round_decimal_down, round_decimal_up, shortest_decimal};

/// Significant digits of a value for people; JSON and `--verbose` have all.
const DIGITS: usize = 6;

/// What a computation came to.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Ending<'a> {
    /// `true`, `false` or `undecided`; empty where a value was asked for.
    pub(super) verdict: &'a str,
    /// Bounds on the value; none for formulas, which have no value.
    pub(super) bounds: Option<[f64; 2]>,
    /// What the value is compared with, such as `>=0.9`.
    pub(super) threshold: Option<&'a str>,
    /// Where.
    pub(super) place: &'a str,
    /// How the computation ended, if not as it should.
    pub(super) status: Option<&'a str>,
}

impl Ending<'_> {
    /// The line, with the end of it.
    pub(super) fn line(&self) -> String {
        let verdict = if self.verdict.is_empty() { String::new() } else { format!("{}   ", self.verdict) };
        let value = self.bounds.map_or(String::new(), |bounds| value(bounds) + " ");
        let threshold = self.threshold.map_or(String::new(), |threshold| format!("against {threshold} "));
        let status = self.status.map_or(String::new(), |status| format!("   {status}"));
        format!("  {verdict}{value}{threshold}{}{status}\n", self.place)
    }
}

/// `value 1` or `value in […]`, rounded outwards.
pub(super) fn value([lower, upper]: [f64; 2]) -> String {
    if lower == upper && lower.is_infinite() {
        return "value infinite".to_owned();
    }
    let text = |bound: f64, round: fn(f64, usize) -> f64| match bound.is_finite() {
        true => shortest_decimal(round(bound, DIGITS)),
        false => bound.to_string(),
    };
    let (from, to) = (text(lower, round_decimal_down), text(upper, round_decimal_up));
    if from == to { format!("value {from}") } else { format!("value in [{from}, {to}]") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_rounded_outwards() {
        for (bounds, text) in [
            ([0.993345588909336, 0.993345588909367], "value in [0.993345, 0.993346]"),
            ([1.0, 1.0], "value 1"),
            ([0.0, 0.0], "value 0"),
            ([0.0, f64::INFINITY], "value in [0, inf]"),
            ([f64::INFINITY; 2], "value infinite"),
            ([1.23456789e-9, 1.5e-9], "value in [1.23456e-9, 1.5e-9]"),
        ] {
            assert_eq!(value(bounds), text);
        }
    }

    #[test]
    fn what_is_missing_leaves_no_gap() {
        let all = Ending {
            verdict: "false",
            bounds: Some([0.25, 0.5]),
            threshold: Some(">=0.9"),
            place: "at the initial state",
            status: Some("time limit, 5 steps"),
        };
        let text =
            "  false   value in [0.25, 0.5] against >=0.9 at the initial state   time limit, 5 steps\n";
        assert_eq!(all.line(), text);
        let formula = Ending { verdict: "true", place: "at 2 initial states", ..Ending::default() };
        assert_eq!(formula.line(), "  true   at 2 initial states\n");
    }
}
