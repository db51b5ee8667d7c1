//! What a writer of certificates needs to know exactly.

use super::values::ExactValues;
use crate::model::{ExactRow, Row};

/// By position: whether some distribution that attains `max_p p·V` gives the successor positive probability.
///
/// Decided exactly. `None` if the row admits no distribution.
pub(crate) fn maximal_support(row: Row<'_>, values: &ExactValues<'_>) -> Option<Vec<bool>> {
    Some(ExactRow::new(row)?.maximal_support(row.successors, values))
}
