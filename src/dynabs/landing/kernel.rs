//! The two inner loops: everything else is bookkeeping.

/// Consecutive rows and their weights.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Run {
    /// The first row.
    pub(super) first: usize,
    /// The weights of it and those that follow.
    pub(super) masses: Vec<f64>,
}

impl Run {
    /// Joins rows in ascending order into runs.
    pub(super) fn join(rows: impl IntoIterator<Item = (usize, f64)>) -> Vec<Self> {
        let mut runs: Vec<Self> = Vec::new();
        for (row, mass) in rows {
            match runs.last_mut() {
                Some(run) if run.first + run.masses.len() == row => run.masses.push(mass),
                _ => runs.push(Self { first: row, masses: vec![mass] }),
            }
        }
        runs
    }

    /// `out += Σ mass · row` over the columns from `start`, for rows of `inner` numbers.
    pub(super) fn add_to(&self, out: &mut [f64], from: &[f64], inner: usize, start: usize) {
        if inner == 1 {
            out[0] += dot(&self.masses, &from[self.first..self.first + self.masses.len()]);
            return;
        }
        let width = out.len();
        let row = |k: usize| {
            let begin = (self.first + k) * inner + start;
            &from[begin..begin + width]
        };
        let (fours, rest) = self.masses.as_chunks::<4>();
        for (k, masses) in fours.iter().enumerate() {
            add_four(out, masses, [row(4 * k), row(4 * k + 1), row(4 * k + 2), row(4 * k + 3)]);
        }
        for (k, mass) in rest.iter().enumerate() {
            out.iter_mut().zip(row(4 * fours.len() + k)).for_each(|(out, value)| *out += mass * value);
        }
    }
}

/// Four rows at once: the sums are loaded and stored a quarter as often.
fn add_four(out: &mut [f64], m: &[f64; 4], [a, b, c, d]: [&[f64]; 4]) {
    let rows = a.iter().zip(b).zip(c.iter().zip(d));
    for (out, ((a, b), (c, d))) in out.iter_mut().zip(rows) {
        *out += (m[0] * a + m[1] * b) + (m[2] * c + m[3] * d);
    }
}

/// `Σ a_k b_k` in eight sums side by side, always in the same order.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<8>(), b.as_chunks::<8>());
    let mut lanes = [0.0; 8];
    for (a, b) in a.iter().zip(b) {
        for lane in 0..8 {
            lanes[lane] += a[lane] * b[lane];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    lanes.iter().sum::<f64>() + rest
}
