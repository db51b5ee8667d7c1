//! A model with narrower intervals: what it would be if more were known.

use super::{ImdpError, IntervalMdp, Row, Rows};

impl IntervalMdp {
    /// The model with every interval narrowed to `factor` of its width, about the distribution that its lower bounds
    /// suggest.
    ///
    /// `m = min(u, c·l)` with the `c` that makes it sum to 1: for bounds that samples gave that is nearly their frequencies, and
    /// what never happened stays out of it. Where lower bounds say too little, `m` is as far between the bounds
    /// everywhere. `[l, u]` becomes `[m − f(m − l), m + f(u − m)]`. With `f = 0` nature has no choice. Nothing of this is a
    /// bound: the answer is to a question about samples.
    ///
    /// # Errors
    /// [`ImdpError`] if rounding spoils a row.
    pub fn narrowed(&self, factor: f64) -> Result<Self, ImdpError> {
        let mut rows = Rows::with_capacity(self.rows().len(), self.rows().num_entries());
        self.rows().for_each(|_, row| narrow(row, factor, &mut rows));
        self.with_rows(rows)
    }
}

/// Bisections of `c`: to the last bit of a double.
const BISECTIONS: usize = 100;

fn narrow(row: Row<'_>, factor: f64, rows: &mut Rows) {
    let middle = middle(row);
    for (k, &successor) in row.successors.iter().enumerate() {
        let (lower, upper, middle) = (row.lower[k], row.upper[k], middle[k]);
        let (low, high) = (middle - factor * (middle - lower), middle + factor * (upper - middle));
        if high > 0.0 {
            // Rounding must not leave a row without a distribution.
            rows.push_entry(successor, (low * (1.0 - 1e-12)).max(0.0), (high * (1.0 + 1e-12)).min(1.0));
        }
    }
    rows.finish_row();
}

fn middle(row: Row<'_>) -> Vec<f64> {
    let scaled = |c: f64| row.lower.iter().zip(row.upper).map(move |(lower, upper)| (c * lower).min(*upper));
    let least = row.lower.iter().sum::<f64>();
    // Beyond this every positive bound is at its upper one, or nearly.
    let (mut low, mut high) = (1.0, 1e9);
    if least > 0.0 && scaled(high).sum::<f64>() >= 1.0 {
        for _ in 0..BISECTIONS {
            let c = 0.5 * (low + high);
            if scaled(c).sum::<f64>() < 1.0 { low = c } else { high = c }
        }
        return scaled(high).collect();
    }
    let most = row.upper.iter().sum::<f64>();
    let place = if most > least { ((1.0 - least) / (most - least)).clamp(0.0, 1.0) } else { 0.0 };
    row.lower.iter().zip(row.upper).map(|(lower, upper)| lower + place * (upper - lower)).collect()
}

#[cfg(test)]
mod tests {
    use crate::formats::Format;
    use crate::model::{RowBuffer, RowId};

    #[test]
    fn intervals_shrink_to_a_distribution() {
        let scratch = tempfile::tempdir().unwrap();
        let path = scratch.path().join("m.tra");
        std::fs::write(&path, "2 2 3\n0 0 0 [0.2,0.6]\n0 0 1 [0.4,0.6]\n1 0 1 1\n").unwrap();
        std::fs::write(path.with_extension("lab"), "0=\"init\"\n0: 0\n").unwrap();
        let model = Format::Prism.import(&path, &()).unwrap().model;
        let bounds = |factor| {
            let narrowed = model.narrowed(factor).unwrap();
            let buffer = &mut RowBuffer::default();
            let row = narrowed.rows().row(RowId(0), buffer);
            [row.lower.to_vec(), row.upper.to_vec()].concat()
        };
        // The lower bounds are one to two, but the second cannot be more than 0.6.
        let middle = [0.4, 0.6];
        for (factor, expected) in
            [(1.0, [0.2, 0.4, 0.6, 0.6]), (0.0, [middle[0], middle[1], middle[0], middle[1]])]
        {
            for (value, expected) in bounds(factor).iter().zip(expected) {
                assert!((value - expected).abs() < 1e-10, "{value} {expected}");
            }
        }
    }
}
