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
//! A lower bound of `P(η ∈ C)` itself would not do: all of that mass could be noise that meets an obstacle on its way.
//!
//! Moving mass to `failed` can only lower the probability of a formula that is false from `failed` on, so
//! robust lower bounds of such formulas (`Pmaxmin`, `Pminmin`) carry over to the system; dually, upper
//! bounds with maximising nature of `F "failed"`. Nothing else is claimed. Samples whose cell is not certain
//! in floating point count for the upper bounds of every cell they may be in, for the lower bounds of none.

mod bounds;
mod ground;
mod levels;
mod prepared;
mod roomy;

use super::AbstractionError;
use super::action_counts::{ActionCounts, TargetPlacements, for_each_cell, is_inside};
use super::cell_box::CellBox;
use super::cell_counts::RegionCounts;
use super::enabling::Enabling;
use super::footprint::need_of_rows;
use super::outcomes::{Outcome, Outcomes};
use super::rooms::Rooms;
use super::states::{FAILED, REACHED, StateSpace};
use super::targets::Targets;
use super::windows::WINDOWS;
use crate::guarantee::SampleEvidence;
use crate::problem::Problem;
use bounds::{BoundTable, DIGITS, Interval};
use ground::{Ground, cell_events, intervals};
use imdp::model::Rows;
use imdp::numeric::{round_decimal_down, round_decimal_up};
use imdp::progress::Progress;
use imdp::solver::worst_expectations;
use levels::{EventLevels, LowerBounds};
pub(super) use levels::{offset_weight, total_offset_weight};
pub(super) use prepared::Prepared;
use rayon::prelude::*;
use roomy::RoomBounds;

/// The rows of all actions, with any of their windows.
pub(super) struct PacRows<'a> {
    problem: &'a Problem,
    targets: &'a Targets,
    states: &'a StateSpace,
    outcomes: &'a Outcomes,
    landings: ActionCounts<'a>,
    /// Per action.
    regions: Vec<RegionCounts>,
    /// By squared distance from the target.
    cells: BoundTable<u64>,
    /// The intervals of the shared landing's table.
    shared: Option<Vec<Interval>>,
    /// By distance from the goal.
    goal: BoundTable<u32>,
    lost: BoundTable<()>,
    /// By number.
    in_rooms: Vec<RoomBounds>,
    rooms: &'a Rooms,
    prepared: Prepared,
}

impl<'a> PacRows<'a> {
    /// Counts.
    pub(super) fn new(
        problem: &'a Problem,
        prepared: Prepared,
        enabling: &'a Enabling,
        placements: TargetPlacements<'a>,
        states: &'a StateSpace,
        outcomes: &'a Outcomes,
    ) -> Result<Self, AbstractionError> {
        let (grid, samples) = (problem.grid(), &problem.noise().samples);
        let Enabling { targets, rooms, .. } = enabling;
        let levels = &prepared.levels;
        let inside_only = levels.lower_bounds() == LowerBounds::InsideWindows;
        let landings = ActionCounts::in_windows(samples, placements, prepared.windows.clone(), inside_only);
        need_of_rows(problem, landings.most_entries(targets, grid)).check()?;

        let counts = |origin: &mut Vec<i32>, target| {
            let (landing, _) = landings.of(targets, target, grid, origin);
            landing.region_counts(origin, grid, outcomes)
        };
        let regions: Vec<RegionCounts> = (0..targets.num_originals())
            .into_par_iter()
            .map_init(|| vec![0; grid.dimension()], counts)
            .collect();
        let size = prepared.sample_size(samples.len() as u64);
        let cell_events = cell_events(&landings, targets, problem);
        let cells = BoundTable::new(cell_events, &size, |square| levels.cell(square));
        let goal_events = regions.iter().map(|r| r.goal).zip(prepared.goal_distances.iter().copied());
        let goal = BoundTable::new(goal_events, &size, |distance| levels.goal(distance));
        let lost_events = regions.iter().map(|r| (r.lost, ()));
        // Only the upper bound is claimed and paid for: at level 0 the lower one is 0.
        let of_lost = EventLevels { lower: [0.0; WINDOWS], upper: levels.lost };
        let lost = BoundTable::new(lost_events, &size, |()| of_lost);
        let shared = landings.shared().map(|landing| intervals(landing, &vec![0; grid.dimension()], &cells));
        let between = &problem.noise().between;
        let in_room = |&room| {
            RoomBounds::new(room, &prepared, &landings, between, shared.as_deref().unwrap_or_default())
        };
        let in_rooms = rooms.distinct.par_iter().filter_map(in_room).collect();
        Ok(Self {
            in_rooms,
            rooms,
            problem,
            targets,
            states,
            outcomes,
            landings,
            regions,
            cells,
            shared,
            goal,
            lost,
            prepared,
        })
    }

    /// One row per target, each with the window with which the least mass may fail.
    pub(super) fn rows(&self, progress: &dyn Progress) -> Rows {
        self.collect("rows", progress, |target, rows| {
            let ground = Ground::new(self, target);
            let failed: Vec<f64> =
                (0..self.prepared.unseen.len()).map(|w| self.failed(&ground, target, w)).collect();
            let best = (1..failed.len()).fold(0, |best, w| if failed[w] < failed[best] { w } else { best });
            self.push_row(&ground, target, best, rows);
        })
    }

    /// One row per target, each with the window with which the worst expectation of `values` is largest.
    ///
    /// A window with less mass outside may list more cells, each of which may get some mass: which of the two
    /// costs more depends on what these cells are worth. Whatever is chosen, the bounds hold.
    pub(super) fn better_rows(&self, values: &[f64], progress: &dyn Progress) -> Rows {
        self.collect("choice of windows", progress, |target, rows| {
            let ground = Ground::new(self, target);
            let mut candidates = Rows::new();
            (0..self.prepared.unseen.len()).for_each(|w| self.push_row(&ground, target, w, &mut candidates));
            let worth = worst_expectations(&candidates, values);
            let best = (1..worth.len()).fold(0, |best, w| if worth[w] > worth[best] { w } else { best });
            self.push_row(&ground, target, best, rows);
        })
    }

    /// What the rows rest on.
    pub(super) fn evidence(&self) -> SampleEvidence {
        let prepared = &self.prepared;
        SampleEvidence {
            number: self.problem.noise().samples.len() as u64,
            beta: prepared.beta,
            sweep: prepared.sweep,
            budget: prepared.budget.allocations().to_vec(),
            unseen_mass: prepared.unseen.first().copied().unwrap_or(1.0),
            components: None,
        }
    }

    fn collect(
        &self,
        phase: &'static str,
        progress: &dyn Progress,
        push: impl Fn(usize, &mut Rows) + Sync,
    ) -> Rows {
        progress.start(phase, self.targets.len() as u64);
        let rows = super::row_tasks::build_rows(self.targets.len(), progress, push);
        progress.finish();
        rows
    }

    /// The bounds of the room that an action needs, if it needs one.
    fn room(&self, target: usize) -> Option<&RoomBounds> {
        let copy = target.checked_sub(self.targets.num_originals())?;
        self.in_rooms.get(self.rooms.of_copy[copy])
    }

    /// How much may fail if the row is made with a window.
    fn failed(&self, ground: &Ground<'_>, target: usize, window: usize) -> f64 {
        let unseen = self.prepared.unseen[window];
        let most = if self.is_clean(&ground.windows[window], &ground.origin) {
            unseen
        } else {
            let original = self.targets.original(target);
            (unseen + self.lost.get(self.regions[original].lost, ()).upper).next_up()
        };
        let most = self.room(target).map_or(most, |room| (most + room.leaving).next_up());
        round_decimal_up(most, DIGITS).min(1.0)
    }

    fn push_row(&self, ground: &Ground<'_>, target: usize, window: usize, rows: &mut Rows) {
        let grid = self.problem.grid();
        let Ground { landing, windows, origin, intervals } = ground;
        let (table, cells) = (landing.table(), &windows[window]);
        let (mut meets_goal, mut goal_lower) = (false, 0.0);
        for_each_cell(table, cells, origin, grid, |cell, i| {
            if self.outcomes.of(cell) == Outcome::Reached {
                meets_goal = true;
                goal_lower = f64::next_down(goal_lower + intervals[i].lower[window]).max(0.0);
            }
        });
        rows.push_entry(FAILED, 0.0, self.failed(ground, target, window));
        if meets_goal {
            let original = self.targets.original(target);
            let event = self.goal.get(self.regions[original].goal, self.prepared.goal_distances[original]);
            let of_cells = round_decimal_down(goal_lower, DIGITS);
            // The goal's own event is about noise with or without room.
            let lower = if original == target { event.lower[window].max(of_cells) } else { of_cells };
            rows.push_entry(REACHED, lower, event.upper);
        }
        for_each_cell(table, cells, origin, grid, |cell, i| {
            if self.outcomes.of(cell) == Outcome::Open {
                rows.push_entry(self.states.of_cell(cell), intervals[i].lower[window], intervals[i].upper);
            }
        });
        rows.finish_row();
    }

    /// Whether nothing in the window at `origin` is lost.
    fn is_clean(&self, window: &CellBox, origin: &[i32]) -> bool {
        let grid = self.problem.grid();
        let mut clean = is_inside(window, origin, grid);
        if clean {
            for_each_cell(window, window, origin, grid, |cell, _| {
                clean &= self.outcomes.of(cell) != Outcome::Lost;
            });
        }
        clean
    }
}
