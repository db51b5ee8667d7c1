//! A hint for who gives the matrices of a differential equation where those of one step are expected.

use super::Document;
use crate::system::eigenvalues;
use serde_json::Value;
use std::fmt;

/// Larger matrices are not looked at.
const MOST_STATES: usize = 64;
/// What rounding may add to an eigenvalue of 0.
const ROUNDING: f64 = 1e-9;

/// Matrices of one step that look like those of a differential equation.
#[derive(Clone, Debug, PartialEq)]
pub struct LooksContinuous {
    eigenvalues: Vec<(f64, f64)>,
}

impl Document {
    /// Whether `/dynamics/A`, without a `sample_time`, looks like the matrix of `dx/dt = A x + B u`.
    ///
    /// The matrix of a step `e^{AT}` has no eigenvalue with a negative real part, unless the step is long. So it does if all real
    /// parts are negative or 0, or if one is below −1, which would be a step that oscillates and grows.
    pub fn looks_continuous(&self) -> Option<LooksContinuous> {
        let dynamics = self.value.pointer("/dynamics")?;
        let matrix = dynamics.get("A").filter(|_| dynamics.get("sample_time").is_none())?;
        let rows: Vec<Vec<f64>> = matrix.as_array()?.iter().map(row).collect::<Option<_>>()?;
        let n = rows.len();
        let is_something = rows.iter().flatten().any(|&x| x != 0.0);
        if n > MOST_STATES || rows.iter().any(|row| row.len() != n) || !is_something {
            return None;
        }
        let eigenvalues = eigenvalues(&rows)?;
        let decays = eigenvalues.iter().all(|&(re, _)| re <= ROUNDING);
        let flips = eigenvalues.iter().any(|&(re, _)| re < -1.0 - ROUNDING);
        (decays || flips).then_some(LooksContinuous { eigenvalues })
    }
}

fn row(row: &Value) -> Option<Vec<f64>> {
    row.as_array()?.iter().map(Value::as_f64).collect()
}

impl fmt::Display for LooksContinuous {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shown: Vec<String> = (self.eigenvalues.iter().take(4))
            .map(|&(re, im)| if im == 0.0 { format!("{re:.3}") } else { format!("{re:.3}{im:+.3}i") })
            .collect();
        let more = if self.eigenvalues.len() > shown.len() { ", …" } else { "" };
        write!(
            f,
            "/dynamics/A is taken as discrete-time, x⁺ = A x + B u, but its eigenvalues ({}{more}) look like those of dx/dt = A x \
             + B u; for that, give \"sample_time\" beside it, or the matrices of one step",
            shown.join(", ")
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;
    use std::path::Path;

    #[test]
    fn rates_of_change_are_noticed() {
        let found = |dynamics: Value| {
            let text = json!({ "dynamics": dynamics }).to_string();
            Document::parse(Path::new("m.json"), &text).unwrap().looks_continuous()
        };
        for a in [
            json!([[0, 1], [0, 0]]),
            json!([[-0.5]]),
            json!([[0, 1], [-2, -3]]),
            json!([[0, 1], [-4, 0]]),
            // A pendulum on its head.
            json!([[0, 1], [9.81, 0]]),
        ] {
            let hint = found(json!({ "A": a })).unwrap_or_else(|| panic!("{a}")).to_string();
            assert!(hint.contains("discrete-time") && hint.contains("sample_time"), "{hint}");
            assert_eq!(found(json!({ "A": a, "sample_time": 0.1 })), None);
        }
        for a in [
            json!([[1, 1], [0, 1]]),
            json!([[0.9, 0.1], [-0.1, 0.9]]),
            json!([[0.5, 0], [0, -0.5]]),
            json!([[0, 0], [0, 0]]),
            json!([[1, 2]]),
            json!([["x"]]),
            json!([[1e308, 1e308], [1e308, 1e308]]),
            json!([]),
        ] {
            assert_eq!(found(json!({ "A": a })), None, "{a}");
        }
    }
}
