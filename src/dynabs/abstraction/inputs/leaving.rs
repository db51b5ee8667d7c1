//! Whether everything leads out of the partition: a mistake rather than a value of 0.

use crate::landing::{Images, Landing, Lower};
use crate::problem::InputProblem;
use imdp::numeric::to_f64;

/// Where images lie, if all of them lie outside the partition and no noise leads back; `extent` has the first and the last
/// sub-cell of all images, by coordinate.
pub(super) fn all_leave(
    problem: &InputProblem,
    landing: &Landing,
    images: &Images,
    (extent, resolution): (&[(i64, i64)], &[u32]),
) -> Option<String> {
    if images.is_empty() || images.some_meet_cells(landing.axes()) {
        return None;
    }
    let inside = vec![1.0; landing.num_cells()];
    if landing.best::<Lower>(images, &inside).values.iter().any(|&stays| stays > 0.0) {
        return None;
    }
    let describe = |(j, &(first, last)): (usize, &(i64, i64))| {
        let axis = &problem.grid().axes()[j];
        let (lower, upper) = (to_f64(axis.lower()), to_f64(axis.upper()));
        let pitch = to_f64(axis.width()) / f64::from(resolution[j]);
        let name = &problem.mode().states()[j].name;
        let from = if first == i64::MIN { f64::NEG_INFINITY } else { lower + first as f64 * pitch };
        let to = if last == i64::MAX { f64::INFINITY } else { lower + (last as f64 + 1.0) * pitch };
        format!("{name} from {from:.6} to {to:.6} (partition: {lower} to {upper})")
    };
    Some(extent.iter().enumerate().map(describe).collect::<Vec<_>>().join(", "))
}
