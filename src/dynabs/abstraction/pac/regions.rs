//! How many samples land in the regions of the task.

use super::super::action_counts::ActionCounts;
use super::super::cell_counts::RegionCounts;
use super::super::stencil::{Ground, Hits};
use super::super::targets::Targets;
use super::ends::{EndCells, MemoryGrounds};
use crate::problem::{Problem, TargetId};
use rayon::prelude::*;

/// How many samples land in the regions of the task, per way of ending and action.
pub(super) fn regions(
    landings: &ActionCounts<'_>,
    targets: &Targets,
    problem: &Problem,
    grounds: &MemoryGrounds,
) -> Vec<RegionCounts> {
    let grid = problem.grid();
    let shared = landings.shared().zip(landings.shared_windows().first());
    let shared = shared.map(|(landing, window)| (Hits::new(landing, grounds.any()), window));
    let of_way = |(ground, ends): (&Ground, &EndCells)| -> Vec<RegionCounts> {
        let counts = |origin: &mut Vec<i32>, place| {
            let target = TargetId::from_index(place);
            ground.origin(target, origin);
            match &shared {
                Some((_, window))
                    if ground.contains(window, origin)
                        && [&ends.lost, &ends.goal].iter().all(|cells| cells.of(window, origin) == 0) =>
                {
                    RegionCounts::default()
                }
                Some((hits, _)) => hits.in_regions(ground, origin),
                None => {
                    let (landing, _) = landings.of(targets, target, grid, &mut vec![0; grid.dimension()]);
                    Hits::new(&landing, ground).in_regions(ground, origin)
                }
            }
        };
        (0..targets.num_originals()).into_par_iter().map_init(Vec::new, counts).collect()
    };
    grounds.ways().flat_map(of_way).collect()
}
