//! Interval rows whose claims hold together with probability at least `1 − β`.
//!
//! **Claim.** Let `η` have any distribution and let the `N` samples be independent of each other and of the
//! noise at run time, all with that distribution. With probability at least `1 − β` over the samples, every
//! row of the model contains the distribution of the cell of `d_a + η` *after moving to `failed`* the mass of
//! unsafe cells, of cells in which nothing is enabled, of what is outside the partition, and of every cell that
//! the row does not list.
//!
//! **Proof.** *Lost* are unsafe cells, ordinary ones with no enabled action, and what is outside: known from the
//! geometry alone. Four families of events are fixed by the grid, the targets and the lost cells, before any
//! sample is looked at; [`ConfidenceBudget`] sees that their levels sum to at most `β`:
//! - *cells*: for every offset `o` that occurs between a target and a cell, `P(η moves by o)` lies between its
//!   two one-sided Clopper–Pearson bounds. By translation this covers every (action, cell) pair.
//! - *goal*: for every action, `P(d_a + η ∈ goal cells)` lies between its two bounds.
//! - *lost*: for every action, `P(d_a + η` is lost`)` is at most its upper bound.
//! - *windows*: for each of a few nested windows `W_0 ⊇ W_1 ⊇ …`, `P(η ∉ W_j) ≤ ε_j` ([`super::windows`]).
//!
//! By the union bound all of them hold together with probability at least `1 − β`. Take a row, made with
//! `W_j`: it lists the cells that are met by `d_a + W_j` and not lost. A listed ordinary cell's probability lies
//! in its interval (*cells*). If goal cells are met, `reached` gets all goal cells: *goal* bounds it from both
//! sides, and the sum of the lower bounds of its cells from below. What is left, `failed`, is lost, at most
//! the bound of *lost*, or in unlisted cells. The latter are outside `d_a + W_j`, which has at most `ε_j`; if
//! `d_a + W_j` meets nothing lost, both together are outside it and `ε_j` alone is enough. Any `j` may be taken,
//! and chosen after looking at everything, since all bounds hold at once. ∎
//!
//! Floating point: the input steers to `d_a + e` with an error `e`, bounded but different for every state, and
//! samples are rounded numbers. Put for each set `C` above `C⁻ = {y : y + e ∈ C for all such e}` and
//! `C⁺ = {y : y + e ∈ C for some e}`. Samples that count for certain are in `C⁻ − d_a`, all samples in
//! `C⁺ − d_a` possibly count, and both sets are fixed beforehand. So the lower bound is one for
//! `P(d_a + η ∈ C⁻)`, the upper one for `P(d_a + η ∈ C⁺)`: they enclose `P(d_a + e + η ∈ C)` for every `e` at once,
//! and the number of events stays the same. Windows likewise: a sample is as far as the farthest cell that it may
//! lie in, so with `C` the cells of a window all but `j` samples are in `C⁻ − d_a` for certain.
//!
//! # Every step of a group
//!
//! Where `d > 1` steps are one and something unsafe is to be avoided at each of them, more is claimed. Let `ξ_i` be the noise
//! so far after step `i`, `ξ_d = η`, and `ξ = (ξ_1 … ξ_d)`; samples are of `ξ`.
//!
//! **Claim.** With probability at least `1 − β` every row, in every cell in which its action is enabled, contains the
//! distribution of the cell of `d_a + η` after moving to `failed`, beyond the above, the mass of all `ξ` with which some state
//! of the cell meets something unsafe at a step before the last.
//!
//! **Proof.** From a state `x` of the cell the state after step `i < d` is `m_i + ξ_i`, with `m_i` in a box that is known
//! ([`PartialImage`](crate::system::PartialImage)). Windows are for `ξ`, and the action is enabled only if these boxes, widened
//! by the largest window, keep clear of everything unsafe: so they do with every smaller one. Take a window, `W`, made from
//! the samples, and let `inside` mean a noise that is nearer than its edge, the `(j+1)`-th farthest of `m` samples; equal
//! distances are ordered by independent uniform numbers, which the noise at run time gets as well. Then
//! - nothing unsafe is met between the steps if the noise is inside;
//! - `P(outside) ≤ ε` by the family *windows*, as above;
//! - given the edge, the `m − j − 1` samples that are nearer are independent, and their law is that of the noise conditioned on
//!   being inside (of independent numbers, those below an order statistic are independent given it, with the law cut off
//!   there). So, whatever the edge is, each Clopper–Pearson bound with their number holds for the conditional probability except
//!   with probability its level, and hence also without the condition: `P(η ∈ C | inside) ≥ l`, one event per window.
//!
//! Let `p` be what remains of a listed set `C` after moving: `P(η ∈ C, nothing unsafe in between)`. It is at least
//! `P(inside) P(η ∈ C | inside) ≥ (1 − ε) l`, and at most `P(η ∈ C) ≤ u`, the bound from above, of all samples. What is
//! moved to `failed` beyond what is lost at the end is outside of `W`, so `ε`, or `ε` and the bound of *lost*, covers it as
//! above. *Lost* are the cells in which the law has no action at all: those where windows leave none are known only from
//! the samples, and are listed like any other. ∎
//!
//! **Room.** Where the boxes widened by the window do not keep clear, they may if the noise so far stays within limits on some
//! sides ([`Room`](super::room::Room)): a box of few possible ones, fixed by the samples that decide about proportions. Such a
//! cell has a row of its own for the target. Two more families are about the other samples, fixed given the first ones:
//! - *cells with room*: `P(η ∈ C, ξ in the room) ≥ l` for every cell `C` and room, by Clopper–Pearson;
//! - *room*: `P(ξ leaves the room) ≤ κ` for every room.
//!
//! With `p` as above, `l ≤ P(η ∈ C, ξ in the room) ≤ p ≤ u`, for goal cells together the sum of the `l`. To what is moved to
//! `failed`, at most `ε` or `ε` and the bound of *lost*, comes what meets something in between, which leaves the room: `κ`. ∎
//!
//! **A plan.** Where a plan is followed, an action is enabled in a cell only if it is near the plan. *Lost* are still the cells in
//! which the law has no action at all, before any plan, so events are the same with every plan and every `U′`, and rows are those of
//! targets, which all hold together: leaving actions out is a choice of policy, which may depend on samples. ∎
//!
//! A lower bound of `P(η ∈ C)` itself would not do: all of that mass could be noise that meets an obstacle on its way.
//!
//! Moving mass to `failed` can only lower the probability of a formula that is false from `failed` on, so
//! robust lower bounds of such formulas (`Pmaxmin`, `Pminmin`) carry over to the system; dually, upper
//! bounds with maximising nature of `F "failed"`. Nothing else is claimed. Samples whose cell is not certain
//! in floating point count for the upper bounds of every cell they may be in, for the lower bounds of none.

mod bounds;
mod ends;
mod events;
mod levels;
mod preference;
mod prepared;
mod regions;
mod roomy;

use super::AbstractionError;
use super::action_counts::{ActionCounts, TargetPlacements};
use super::cell_box::CellBox;
use super::cell_counts::{CellCounts, RegionCounts};
use super::enabling::Enabling;
use super::footprint::need_of_rows;
use super::rooms::Rooms;
use super::states::{REACHED, StateSpace};
use super::stencil::{Ground, Special, Stencil, StencilRows};
use super::targets::Targets;
use super::windows::WINDOWS;
use crate::guarantee::SampleEvidence;
use crate::problem::{Problem, SampledNoise, Stabilizer, TargetId};
pub(super) use bounds::DIGITS;
use bounds::{BoundTable, Interval};
pub(super) use ends::TaskEnds;
use ends::{EndCells, MemoryGrounds};
use events::{cell_events, intervals};
use imdp::model::{RowId, RowSet};
use imdp::numeric::{round_decimal_down, round_decimal_up};
use imdp::progress::Progress;
use levels::{EventLevels, LowerBounds};
pub(super) use levels::{offset_weight, total_offset_weight};
use preference::Chooser;
pub(super) use preference::{Preference, Worth};
pub(super) use prepared::Prepared;
use rayon::prelude::*;
use regions::regions;
use roomy::RoomBounds;
use std::sync::Arc;

/// The rows of all actions, with any of their windows, with every memory of the task.
pub(super) struct PacRows<'a> {
    problem: &'a Problem,
    /// The number of samples.
    number: u64,
    targets: &'a Targets,
    landings: ActionCounts<'a>,
    grounds: MemoryGrounds,
    /// Per way of ending and action; nothing is counted where no window meets anything but open cells.
    regions: Vec<RegionCounts>,
    /// By squared distance from the target.
    cells: BoundTable<u64>,
    /// By distance from the goal.
    goal: BoundTable<u32>,
    lost: BoundTable<()>,
    /// Those of all actions, where coordinates count from the target: one per window, the largest first, for noise with no
    /// room to stay in and then for each room.
    stencils: Option<Arc<[Stencil]>>,
    /// By number.
    in_rooms: Vec<RoomBounds>,
    rooms: &'a Rooms,
    prepared: Prepared,
}

/// An action with a memory of the task before it.
#[derive(Clone, Copy)]
struct Action<'p> {
    ground: &'p Ground,
    ends: &'p EndCells,
    /// The number of the way of ending.
    way: usize,
    target: TargetId,
    row: RowId,
}

impl<'a> PacRows<'a> {
    /// Counts.
    pub(super) fn new(
        (problem, noise): (&'a Problem, &'a SampledNoise),
        prepared: Prepared,
        enabling: &'a Enabling,
        placements: TargetPlacements<'a>,
        states: &StateSpace,
    ) -> Result<Self, AbstractionError> {
        let (grid, samples) = (problem.grid(), &noise.samples);
        let Enabling { targets, rooms, .. } = enabling;
        let levels = &prepared.levels;
        let inside_only = levels.lower_bounds() == LowerBounds::InsideWindows;
        let landings = ActionCounts::in_windows(samples, placements, prepared.windows.clone(), inside_only);
        if landings.shared().is_none() {
            let rows = states.memories().len() as u64 * targets.len() as u64;
            need_of_rows(problem, rows * u64::from(grid.num_cells())).check()?;
        }
        let shared_targets = landings.shared().map(|_| targets);
        let grounds = MemoryGrounds::new(problem, &prepared.ends, enabling, states, shared_targets);
        let regions = regions(&landings, targets, problem, &grounds);
        let size = prepared.sample_size(samples.len() as u64);
        let cell_events = cell_events(&landings, targets, problem);
        let cells = BoundTable::new(cell_events, &size, |square| levels.cell(square));
        let goal_events = regions.iter().map(|r| r.goal).zip(prepared.ends.goal_distances.iter().copied());
        let goal = BoundTable::new(goal_events, &size, |distance| levels.goal(distance));
        let lost_events = regions.iter().map(|r| (r.lost, ()));
        // Only the upper bound is claimed and paid for: at level 0 the lower one is 0.
        let of_lost = EventLevels { lower: [0.0; WINDOWS], upper: levels.lost };
        let lost = BoundTable::new(lost_events, &size, |()| of_lost);
        let shared = landings.shared().map(|landing| intervals(landing, &vec![0; grid.dimension()], &cells));
        let between = &noise.between;
        let in_room = |&room| RoomBounds::new(room, &prepared, &landings, between);
        let in_rooms: Vec<RoomBounds> = rooms.distinct.par_iter().filter_map(in_room).collect();
        let ground = grounds.any();
        let windows = landings.shared_windows();
        let stencils = landings.shared().zip(shared).map(|(landing, shared)| {
            let places = places(landing, windows);
            let mut all = stencils(windows, &places, ground, &shared, &prepared.unseen);
            for room in &in_rooms {
                for (window, places) in places.iter().enumerate() {
                    let usual = usual_failed((prepared.unseen[window] + room.leaving).next_up());
                    all.push(all[window].with_lower(usual, room.lower.clone(), places.clone()));
                }
            }
            all.into()
        });
        Ok(Self {
            in_rooms,
            rooms,
            problem,
            number: samples.len() as u64,
            targets,
            landings,
            grounds,
            regions,
            cells,
            goal,
            lost,
            stencils,
            prepared,
        })
    }

    /// One row per memory and target, each with the window that is preferred.
    ///
    /// Whatever is chosen, the bounds hold.
    pub(super) fn rows(
        &self,
        preference: Preference<'_>,
        phase: &'static str,
        progress: &dyn Progress,
    ) -> RowSet {
        let count = self.grounds.memories() * self.targets.len();
        progress.start(phase, count as u64);
        let rows = match &self.stencils {
            None => super::row_tasks::build_rows(count, progress, |row, rows| {
                let action = self.action(RowId::from_index(row));
                let stencils = self.stencils_of(action.target);
                let rivals = self.rivals(&stencils);
                let mut chooser = Chooser::new(self, preference, &rivals);
                let chosen = chooser.choose(&stencils, action);
                rows.push_row(chooser.row(&stencils, &chosen, action));
            })
            .into(),
            Some(stencils) => {
                let rivals = self.rivals(stencils);
                let start = || Chooser::new(self, preference, &rivals);
                let choose = |chooser: &mut Chooser<'_>, row| {
                    progress.advance(1);
                    chooser.choose(stencils, self.action(row))
                };
                let (grounds, stencils) = (self.grounds.all(), stencils.clone());
                StencilRows::new(grounds, stencils, self.targets.len(), start, choose).into()
            }
        };
        progress.finish();
        rows
    }

    /// What the rows rest on.
    pub(super) fn evidence(&self) -> SampleEvidence {
        let prepared = &self.prepared;
        SampleEvidence {
            number: self.number,
            beta: prepared.beta,
            sweep: prepared.sweep,
            budget: prepared.budget.allocations().to_vec(),
            unseen_mass: prepared.unseen.first().copied().unwrap_or(1.0),
            components: None,
            follows_plan: self.problem.stabilizer().and_then(Stabilizer::tracking).is_some(),
        }
    }

    /// The action of a row.
    fn action(&self, row: RowId) -> Action<'_> {
        let (memory, target) = self.targets.of_row(row);
        let (ground, way, ends) = self.grounds.of(memory);
        Action { ground, ends, way, target, row }
    }

    /// Where what is known of an action and its way of ending is.
    fn place(&self, action: Action<'_>) -> usize {
        action.way * self.targets.num_originals() + self.targets.original(action.target).index()
    }

    /// The bounds of the room that an action needs, if it needs one.
    fn room(&self, target: TargetId) -> Option<&RoomBounds> {
        self.in_rooms.get(self.number_of_room(target)?)
    }

    fn number_of_room(&self, target: TargetId) -> Option<usize> {
        Some(self.rooms.of_copy[self.targets.copy(target)?])
    }

    /// The number of windows.
    fn windows(&self) -> usize {
        self.prepared.unseen.len()
    }

    /// Of the windows with these stencils, those that may be better than the ones before: not those that list the same cells with
    /// lower bounds nowhere above, for more noise is outside. With a room nothing else differs from window to window.
    fn rivals(&self, stencils: &[Stencil]) -> Vec<usize> {
        let is_beaten = |window: usize, before: usize| {
            let mut of_goal = self.goal.intervals();
            stencils[window].is_within(&stencils[before])
                && of_goal.all(|goal| goal.lower[window] <= goal.lower[before])
        };
        let is_rival = |&window: &usize| !(0..window).any(|before| is_beaten(window, before));
        (0..self.windows()).filter(is_rival).collect()
    }

    /// Where the stencils of an action are among those of all.
    fn first_stencil(&self, target: TargetId) -> usize {
        let room = self.number_of_room(target).filter(|&room| room < self.in_rooms.len());
        room.map_or(0, |room| (1 + room) * self.windows())
    }

    /// The stencils of an action whose coordinates are those of the grid.
    fn stencils_of(&self, target: TargetId) -> Vec<Stencil> {
        let grid = self.problem.grid();
        let (landing, windows) = self.landings.of(self.targets, target, grid, &mut vec![0; grid.dimension()]);
        let from = self.landings.target_cell(self.targets, target);
        let intervals = intervals(&landing, &from, &self.cells);
        stencils(&windows, &places(&landing, &windows), self.grounds.any(), &intervals, &self.prepared.unseen)
    }

    /// How much may fail if the row at `origin` is made with a window.
    fn failed(&self, stencil: &Stencil, action: Action<'_>, origin: &[i32], window: usize) -> f64 {
        let hull = stencil.runs().hull();
        if action.ground.contains(hull, origin) && action.ends.lost.of(hull, origin) == 0 {
            return stencil.usual().1;
        }
        let lost = self.regions[self.place(action)].lost;
        let most = (self.prepared.unseen[window] + self.lost.get(lost, ()).upper).next_up();
        let most = self.room(action.target).map_or(most, |room| (most + room.leaving).next_up());
        round_decimal_up(most, DIGITS).min(1.0)
    }

    /// The intervals of the special states of the row at `origin`.
    fn special(&self, stencil: &Stencil, action: Action<'_>, origin: &[i32], window: usize) -> Special {
        let Action { ground, ends, target, .. } = action;
        let meets_goal = ends.goal.of(stencil.runs().hull(), origin) > 0;
        let reached = meets_goal.then(|| {
            let mut of_cells = 0.0;
            stencil.runs().for_each(ground, origin, |first, position, length| {
                for (i, &state) in ground.states[first..first + length].iter().enumerate() {
                    if state == REACHED {
                        of_cells = f64::next_down(of_cells + stencil.lower(position + i)).max(0.0);
                    }
                }
            });
            let place = self.place(action);
            let event = self.goal.get(self.regions[place].goal, self.prepared.ends.goal_distances[place]);
            let of_cells = round_decimal_down(of_cells, DIGITS);
            // The goal's own event is about noise with or without room.
            let is_original = self.targets.original(target) == target;
            let lower = if is_original { event.lower[window].max(of_cells) } else { of_cells };
            (lower, event.upper)
        });
        Special { first: (0.0, self.failed(stencil, action, origin, window)), reached }
    }

    /// How many entries the row at `origin` has.
    fn length(&self, stencil: &Stencil, action: Action<'_>, origin: &[i32], special: Special) -> u32 {
        let hull = stencil.runs().hull();
        let merged = action.ends.lost.of(hull, origin) + action.ends.goal.of(hull, origin);
        1 + u32::from(special.reached.is_some()) + action.ground.volume(hull, origin) - merged
    }
}

/// Per window, the places of its cells in the landing's table.
fn places(landing: &CellCounts, windows: &[CellBox]) -> Vec<Arc<[u32]>> {
    let of_window = |hull: &CellBox| {
        let mut places = Vec::with_capacity(hull.volume());
        hull.for_each(|cell| places.push(landing.table().position(cell) as u32));
        places.into()
    };
    windows.iter().map(of_window).collect()
}

/// One stencil per window, in coordinates of the landing, with the intervals of cells at these places.
fn stencils(
    windows: &[CellBox],
    places: &[Arc<[u32]>],
    ground: &Ground,
    intervals: &[Interval],
    unseen: &[f64],
) -> Vec<Stencil> {
    let stencil = |((window, hull), places): ((usize, &CellBox), &Arc<[u32]>)| {
        Stencil::new(hull, ground, usual_failed(unseen[window]), |position| {
            let interval = &intervals[places[position] as usize];
            Some((interval.lower[window], interval.upper))
        })
    };
    windows.iter().enumerate().zip(places).map(stencil).collect()
}

/// What may fail where nothing lost is met.
fn usual_failed(most: f64) -> (f64, f64) {
    (0.0, round_decimal_up(most, DIGITS).min(1.0))
}
