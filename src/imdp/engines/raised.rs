//! Models that engines accept: without lower bounds of 0.

use crate::formats::prism::RAISED_LOWER_BOUND;
use crate::model::{End, ImdpError, IntervalMdp, Rows};

/// The model with every lower bound of 0 raised to [`RAISED_LOWER_BOUND`], as `model.tra` has it; `None` if there
/// are no such bounds.
///
/// # Errors
/// Those of [`IntervalMdp::new`]; none, if `model` is an interval MDP.
pub fn raised(model: &IntervalMdp) -> Result<Option<IntervalMdp>, ImdpError> {
    if !model.rows().any(|row| row.lower.contains(&0.0)) {
        return Ok(None);
    }
    let mut rows = Rows::with_capacity(model.rows().len(), model.rows().num_entries());
    model.rows().for_each(|_, row| {
        for (i, &successor) in row.successors.iter().enumerate() {
            let (lower, upper) = (row.lower[i], row.upper[i]);
            let tiny = 0.0 < upper && upper < RAISED_LOWER_BOUND;
            let raised = if tiny { upper } else { RAISED_LOWER_BOUND };
            let lower = if lower == 0.0 { raised } else { lower };
            rows.push_entry(successor, lower, upper.max(lower));
            for end in [End::Lower, End::Upper] {
                row.exact_bound(end, i).into_iter().for_each(|exact| rows.set_exact(end, exact.clone()));
            }
        }
        rows.finish_row();
    });
    model.with_rows(rows).map(Some)
}
