//! Rows in parallel, put together in order.

use imdp::model::Rows;
use imdp::progress::Progress;
use rayon::prelude::*;

/// Builds `count` rows in parallel and puts them together in order.
pub(super) fn build_rows(
    count: usize,
    progress: &dyn Progress,
    push_row: impl Fn(usize, &mut Rows) + Sync,
) -> Rows {
    const ROWS_PER_TASK: usize = 64;
    let starts: Vec<usize> = (0..count).step_by(ROWS_PER_TASK).collect();
    let parts: Vec<Rows> = starts
        .into_par_iter()
        .map(|start| {
            let end = (start + ROWS_PER_TASK).min(count);
            let mut rows = Rows::new();
            (start..end).for_each(|target| push_row(target, &mut rows));
            progress.advance((end - start) as u64);
            rows
        })
        .collect();
    let mut all = Rows::with_capacity(count, parts.iter().map(Rows::num_entries).sum());
    for part in parts {
        all.append(&part);
    }
    all
}
