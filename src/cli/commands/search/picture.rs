//! The trade-off as a picture.

use super::table::Found;
use dynabs::report::{TradeOff, TradeOffPoint};

/// Bounds against costs.
pub(super) fn picture(found: &Found<'_>) -> String {
    let chosen = found.choice.map(|choice| choice.place);
    let points = found.candidates.iter().enumerate().filter_map(|(place, candidate)| {
        let bound = candidate.bound()?;
        Some(TradeOffPoint {
            name: candidate.job.name(),
            cost: bound.cost as f64,
            bound: bound.lower,
            is_chosen: chosen == Some(place),
        })
    });
    let cost = found.cost.words(found.takes_inputs()).to_owned();
    TradeOff { title: found.name.clone(), cost, wanted: found.wanted, points: points.collect() }.svg()
}
