//! What is kept of a model for the sake of one property.

use crate::limits::LimitArguments;
use crate::results::PropertyResult;
use crate::{Bars, CliError};
use dynabs::run::PruningReport;
use imdp::model::IntervalMdp;
use imdp::property::Property;
use imdp::solver::Pruned;
use std::time::Instant;

/// Without a bound on the steps, how close the bounds must be before it is decided what matters.
const PRUNING_EPSILON: f64 = 1e-9;

/// Replaces a model by what an optimal policy for a property needs of it.
pub(crate) fn pruned(
    model: &mut IntervalMdp,
    property: &Property,
    bars: &Bars,
) -> Result<(PropertyResult, PruningReport), CliError> {
    let start = Instant::now();
    let limits = LimitArguments::of_epsilon(PRUNING_EPSILON);
    let pruned = limits.with_options(bars, |options| Pruned::new(model, property, options));
    let pruned = pruned.map_err(|error| CliError::Failure(format!("--prune: {property}: {error}")))?;
    let result = PropertyResult::new(property, &pruned.after, &pruned.model, start.elapsed());
    let report = PruningReport::new(property, model.size(), &pruned);
    *model = pruned.model;
    Ok((result, report))
}
