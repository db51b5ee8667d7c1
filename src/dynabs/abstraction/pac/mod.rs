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
//! Moving mass to `failed` can only lower the probability of a formula that is false from `failed` on, so
//! robust lower bounds of such formulas (`Pmaxmin`, `Pminmin`) carry over to the system; dually, upper
//! bounds with maximising nature of `F "failed"`. Nothing else is claimed. Samples whose cell is not certain
//! in floating point count for the upper bounds of every cell they may be in, for the lower bounds of none.

mod bounds;
mod ground;
mod levels;

use super::AbstractionError;
use super::footprint::need_of_rows;
use super::landing::{RegionCounts, Spread};
use super::landings::{Landings, Placements, for_each_cell, is_inside};
use super::outcomes::{Outcome, Outcomes};
use super::states::{FAILED, REACHED, StateSpace};
use super::targets::Targets;
use super::windows::{Shape, Windows, shape_samples};
use crate::guarantee::SampleEvidence;
use crate::problem::Problem;
use crate::statistics::{ConfidenceBudget, upper_bound};
use bounds::{BoundTable, DIGITS, Interval};
use ground::{Ground, cell_events, intervals};
use imdp::model::Rows;
use imdp::numeric::{Rational, round_decimal_down, round_decimal_up, to_f64};
use imdp::progress::Progress;
use imdp::solver::worst_expectations;
use levels::{Levels, distances_in_cells};
use rayon::prelude::*;

/// The most that may be unseen: beyond it no policy could be shown to succeed more often than not.
const MAX_UNSEEN: f64 = 0.5;

/// The rows of all actions, with any of their windows.
pub(super) struct PacRows<'a> {
    problem: &'a Problem,
    targets: &'a Targets,
    states: &'a StateSpace,
    outcomes: &'a Outcomes,
    landings: Landings<'a>,
    /// Per action.
    regions: Vec<RegionCounts>,
    /// Per action, in cells.
    goal_distances: Vec<u32>,
    /// By squared distance from the target.
    cells: BoundTable<u64>,
    /// The intervals of the shared landing's table.
    shared: Option<Vec<Interval>>,
    /// By distance from the goal.
    goal: BoundTable<u32>,
    lost: BoundTable<()>,
    /// Per window.
    unseen: Vec<f64>,
    budget: ConfidenceBudget,
}

impl<'a> PacRows<'a> {
    /// Spends `beta` and counts; the `discard` farthest samples are left out of all windows.
    pub(super) fn new(
        problem: &'a Problem,
        (beta, discard): (Rational, usize),
        targets: &'a Targets,
        placements: Placements<'a>,
        states: &'a StateSpace,
        outcomes: &'a Outcomes,
    ) -> Result<Self, AbstractionError> {
        let (grid, samples) = (problem.grid(), &problem.noise().samples);
        let number = samples.len() as u64;
        let goal_distances = distances_in_cells(targets, problem.goal(), grid);
        let origins = if placements.shared().is_some() { 1 } else { targets.len() };
        let mut budget = ConfidenceBudget::new(beta);
        let levels = Levels::new(&mut budget, &placements.offset_ranges(grid), origins, &goal_distances)?;

        let shape = Shape::learn(samples, grid);
        let windows = Windows::new(samples, shape, placements.shared(), discard, &levels.windows);
        let unseen = |&unseen: &f64| round_decimal_up(unseen, DIGITS).min(1.0);
        let unseen: Vec<f64> = windows.unseen().iter().map(unseen).collect();
        let of_largest = unseen.first().copied().unwrap_or(1.0);
        if of_largest > MAX_UNSEEN {
            let needed = enough_samples(discard, levels.windows[0]);
            return Err(AbstractionError::TooFewSamples { samples: number, needed, unseen: of_largest });
        }
        let landings = Landings::new(samples, placements, Some(windows));
        let entries = targets.len() as u64 * landings.row_length(grid) as u64;
        need_of_rows(problem, entries).check()?;

        let counts = |origin: &mut Vec<i32>, target| {
            let (landing, _) = landings.of(targets, target, grid, origin);
            landing.region_counts(origin, grid, outcomes)
        };
        let regions: Vec<RegionCounts> =
            (0..targets.len()).into_par_iter().map_init(|| vec![0; grid.dimension()], counts).collect();
        let of_cell = |square| (levels.cell(square), levels.cell(square));
        let cells = BoundTable::new(cell_events(&landings, targets, problem), number, of_cell);
        let goal_events = regions.iter().map(|r| r.goal).zip(goal_distances.iter().copied());
        let goal = BoundTable::new(goal_events, number, |distance| levels.goal(distance));
        let lost_events = regions.iter().map(|r| (r.lost, ()));
        // Only the upper bound is claimed and paid for: at level 0 the lower one is 0.
        let lost = BoundTable::new(lost_events, number, |()| (0.0, levels.lost));
        let shared = landings.shared().map(|landing| intervals(landing, &vec![0; grid.dimension()], &cells));
        Ok(Self {
            problem,
            targets,
            states,
            outcomes,
            landings,
            regions,
            goal_distances,
            cells,
            shared,
            goal,
            lost,
            unseen,
            budget,
        })
    }

    /// One row per target, each with the window with which the least mass may fail.
    pub(super) fn rows(&self, progress: &dyn Progress) -> Rows {
        self.collect("rows", progress, |target, rows| {
            let ground = Ground::new(self, target);
            let failed: Vec<f64> = (0..self.unseen.len()).map(|w| self.failed(&ground, target, w)).collect();
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
            (0..self.unseen.len()).for_each(|w| self.push_row(&ground, target, w, &mut candidates));
            let worth = worst_expectations(&candidates, values);
            let best = (1..worth.len()).fold(0, |best, w| if worth[w] > worth[best] { w } else { best });
            self.push_row(&ground, target, best, rows);
        })
    }

    /// What the rows rest on, as one of `sweep` settings that `β` is shared by.
    pub(super) fn evidence(&self, beta: &Rational, sweep: u64) -> SampleEvidence {
        SampleEvidence {
            number: self.problem.noise().samples.len() as u64,
            beta: to_f64(beta),
            sweep,
            budget: self.budget.allocations().to_vec(),
            unseen_mass: self.unseen.first().copied().unwrap_or(1.0),
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

    /// How much may fail if the row is made with a window.
    fn failed(&self, ground: &Ground<'_>, target: usize, window: usize) -> f64 {
        let unseen = self.unseen[window];
        let most = if self.is_clean(&ground.windows[window], &ground.origin) {
            unseen
        } else {
            (unseen + self.lost.get(self.regions[target].lost, ()).upper).next_up()
        };
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
                goal_lower = f64::next_down(goal_lower + intervals[i].lower).max(0.0);
            }
        });
        rows.push_entry(FAILED, 0.0, self.failed(ground, target, window));
        if meets_goal {
            let event = self.goal.get(self.regions[target].goal, self.goal_distances[target]);
            rows.push_entry(REACHED, event.lower.max(round_decimal_down(goal_lower, DIGITS)), event.upper);
        }
        for_each_cell(table, cells, origin, grid, |cell, i| {
            if self.outcomes.of(cell) == Outcome::Open {
                rows.push_entry(self.states.of_cell(cell), intervals[i].lower, intervals[i].upper);
            }
        });
        rows.finish_row();
    }

    /// Whether nothing in the window at `origin` is lost.
    fn is_clean(&self, window: &Spread, origin: &[i32]) -> bool {
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

/// The smallest number of samples with which less than half of the mass may be unseen.
fn enough_samples(discard: usize, level: f64) -> u64 {
    let enough = |samples: u64| {
        let left = samples.saturating_sub(shape_samples(samples as usize) as u64);
        left > discard as u64 && upper_bound(discard as u64, left, level) <= MAX_UNSEEN
    };
    let mut high = discard as u64 + 2;
    // At a level of 0, which doubles make of the tiniest budgets, no number is enough.
    while !enough(high) {
        if high > u64::from(u32::MAX) {
            return u64::MAX;
        }
        high *= 2;
    }
    let mut low = high / 2;
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if enough(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}
