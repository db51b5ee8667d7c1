//! How tasks end: in which cells they are done or lost on arrival, with each memory.
//!
//! Memories that end alike share their events: what is asked of an action is whether noise takes it to goal cells, or to lost
//! ones, and these are the same sets. All of it is known from the task and the geometry alone.

use super::super::enabling::Enabling;
use super::super::grounds::grounds;
use super::super::states::{FAILED, StateSpace};
use super::super::stencil::{BoxCount, Ground};
use super::super::targets::Targets;
use super::levels::distances_in_cells;
use crate::partition::{CellId, Grid, Region};
use crate::problem::{Objective, Problem};
use crate::task::Standing;
use imdp::model::StateId;
use std::collections::HashMap;
use std::sync::Arc;

/// The ways of ending that memories have.
pub(in super::super) struct TaskEnds {
    /// By number of the memory among those that states have.
    way_of: Vec<usize>,
    /// By way: the number of the first memory that has it, and whether it has goal cells.
    ways: Vec<(usize, bool)>,
    /// By way, then by action, in cells.
    pub(super) goal_distances: Vec<u32>,
    actions: usize,
}

/// The cells in which a task ends.
pub(super) struct EndCells {
    pub(super) lost: BoxCount,
    pub(super) goal: BoxCount,
}

/// What cells are to rows, by the memory before.
pub(super) struct MemoryGrounds {
    grounds: Arc<[Ground]>,
    way_of: Vec<usize>,
    /// By way.
    ends: Vec<EndCells>,
    first: Vec<usize>,
}

impl TaskEnds {
    /// Those of a problem with these states, for actions that steer to these targets.
    pub(in super::super) fn new(problem: &Problem, states: &StateSpace, targets: &Targets) -> Self {
        let (grid, task) = (problem.grid(), problem.worst_task());
        let (mut known, mut way_of, mut ways) = (HashMap::new(), vec![], vec![]);
        let mut goal_distances = vec![];
        for (number, &memory) in states.memories().iter().enumerate() {
            let end = |cell: u32| match task.standings(Some(memory), cell as usize) {
                [Standing::Reached] => 2u8,
                [Standing::Open(_)] => 1,
                _ => 0,
            };
            let kinds: Vec<u8> = (0..grid.num_cells()).map(end).collect();
            let hull = hull(grid, &kinds);
            let fresh = ways.len();
            let way = *known.entry(kinds).or_insert(fresh);
            way_of.push(way);
            if way == fresh {
                ways.push((number, hull.is_some()));
                goal_distances.extend(match problem.objective() {
                    Objective::Automaton(_) => distances_in_cells(targets, hull.as_slice(), grid),
                    Objective::Reach { .. } | Objective::Stay { .. } => {
                        distances_in_cells(targets, problem.goal(), grid)
                    }
                });
            }
        }
        Self { way_of, ways, goal_distances, actions: targets.len() }
    }

    /// How far actions are from the goal, one number for each event about it: nothing is asked where there is none, unless there
    /// is none at all.
    pub(super) fn goal_events(&self) -> Vec<u32> {
        let is_any = self.ways.iter().any(|(_, has_goal)| *has_goal);
        let asked =
            self.ways.iter().enumerate().filter(|(way, (_, has_goal))| *has_goal || !is_any && *way == 0);
        let of_way = |(way, _)| &self.goal_distances[way * self.actions..(way + 1) * self.actions];
        asked.flat_map(of_way).copied().collect()
    }

    /// How many events there are about what is lost.
    pub(super) fn lost_events(&self) -> usize {
        self.ways.len() * self.actions
    }
}

/// A box around the goal cells.
fn hull(grid: &Grid, kinds: &[u8]) -> Option<Region> {
    let goal: Vec<CellId> =
        (0..).map(CellId).zip(kinds).filter(|(_, kind)| **kind == 2).map(|(cell, _)| cell).collect();
    if goal.is_empty() {
        return None;
    }
    let sides = grid.axes().iter().enumerate().map(|(j, axis)| {
        let along = || goal.iter().map(|&cell| grid.coordinate(cell, j));
        let (first, last) = (along().min().unwrap_or(0), along().max().unwrap_or(0));
        (Some(axis.face(first)), Some(axis.face(last + 1)))
    });
    let (lower, upper) = sides.unzip();
    Some(Region { lower, upper })
}

impl MemoryGrounds {
    pub(super) fn new(
        problem: &Problem,
        ends: &TaskEnds,
        enabling: &Enabling,
        states: &StateSpace,
        shared: Option<&Targets>,
    ) -> Self {
        let grounds = grounds(problem, enabling, states, shared);
        let first: Vec<usize> = ends.ways.iter().map(|&(first, _)| first).collect();
        let is_goal = |ground: &Ground, state: StateId| state != FAILED && !ground.lists(state);
        let cells = |&first: &usize| {
            let ground = &grounds[first];
            EndCells {
                lost: BoxCount::new(ground, |state| state == FAILED),
                goal: BoxCount::new(ground, |state| is_goal(ground, state)),
            }
        };
        let ends_of_ways = first.iter().map(cells).collect();
        Self { way_of: ends.way_of.clone(), ends: ends_of_ways, first, grounds }
    }

    /// The number of memories.
    pub(super) fn memories(&self) -> usize {
        self.grounds.len()
    }

    /// What cells are after the memory with a number, its way of ending, and where that is.
    pub(super) fn of(&self, memory: usize) -> (&Ground, usize, &EndCells) {
        let way = self.way_of[memory];
        (&self.grounds[memory], way, &self.ends[way])
    }

    /// What cells are with some memory of every way of ending, and where that is.
    pub(super) fn ways(&self) -> impl Iterator<Item = (&Ground, &EndCells)> {
        self.first.iter().map(|&first| &self.grounds[first]).zip(&self.ends)
    }

    /// What cells are to rows with all memories, apart from states.
    pub(super) fn all(&self) -> Arc<[Ground]> {
        self.grounds.clone()
    }

    /// What cells are with some memory, for whom only the grid matters.
    pub(super) fn any(&self) -> &Ground {
        &self.grounds[0]
    }
}
