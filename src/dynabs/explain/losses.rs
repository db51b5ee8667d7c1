//! Where runs end that do not succeed, and how far noise reaches.

use super::{Loss, Reason, Spread};
use crate::controller::{End, Simulation};
use crate::partition::{Grid, GridAxis};
use imdp::numeric::to_f64;
use imdp::progress::Progress;
use std::collections::BTreeMap;

/// So many runs show what happens in one of a hundred.
const RUNS: u64 = 2000;
/// Less than this is not worth a line.
const RARE: f64 = 0.002;

/// Where the runs of a closed loop end that begin in `start`, with noise drawn from what is known of it.
pub(super) fn simulate(
    simulation: &Simulation<'_>,
    grid: &Grid,
    names: &[String],
    start: &[f64],
    progress: &dyn Progress,
) -> Reason {
    progress.start("runs to explain", RUNS);
    let mut ends: BTreeMap<String, u64> = BTreeMap::new();
    let mut good = 0;
    for run in 0..RUNS {
        let trajectory = simulation.trajectory(start, 0, run);
        let outcome = &trajectory.outcome;
        let last = trajectory.steps.last().map(|step| step.state.as_slice()).unwrap_or_default();
        let end = match outcome.end {
            _ if outcome.satisfied => None,
            End::Outside => Some(face(grid, names, last)),
            End::Unsafe => Some("meet an unsafe region".to_owned()),
            End::NoAction => Some("come to a cell in which nothing is enabled".to_owned()),
            End::Over | End::Unfinished => Some("run out of time".to_owned()),
            End::Reached if outcome.unsafe_between => {
                Some("meet something unsafe between grouped steps".to_owned())
            }
            End::Reached => None,
        };
        match end {
            None => good += 1,
            Some(end) => *ends.entry(end).or_default() += 1,
        }
        progress.advance(1);
    }
    progress.finish();
    let share = |count: u64| count as f64 / RUNS as f64;
    let mut losses: Vec<Loss> =
        ends.into_iter().map(|(end, count)| Loss { end, share: share(count) }).collect();
    losses.retain(|loss| loss.share >= RARE);
    losses.sort_by(|one, other| other.share.total_cmp(&one.share));
    Reason::Losses { simulated: share(good), losses }
}

/// The face of the partition that a state outside is farthest beyond, in cells.
fn face(grid: &Grid, names: &[String], x: &[f64]) -> String {
    let beyond = grid.axes().iter().zip(names).zip(x).flat_map(|((axis, name), &x)| {
        let (lower, upper, width) = (to_f64(axis.lower()), to_f64(axis.upper()), to_f64(axis.width()));
        [
            ((lower - x) / width, format!("{name} < {lower}")),
            ((x - upper) / width, format!("{name} ≥ {upper}")),
        ]
    });
    let farthest = beyond.max_by(|(one, _), (other, _)| one.total_cmp(other));
    farthest.map_or_else(
        || "leave the partition".to_owned(),
        |(_, face)| format!("leave the partition at {face}"),
    )
}

/// Standard deviations of the noise of one step of the model, in cells.
pub(super) fn spread_of(deviations: &[f64], grid: &Grid) -> Vec<Spread> {
    let axes = grid.axes().iter().zip(grid.widths());
    let spread = |(deviation, (axis, width)): (&f64, (&GridAxis, f64))| Spread {
        deviation: deviation / width,
        cells: axis.cells(),
    };
    deviations.iter().zip(axes).map(spread).collect()
}
