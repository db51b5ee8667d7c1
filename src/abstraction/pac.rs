//! Interval rows whose claims hold together with probability at least `1 − β`.
//!
//! **Claim.** Let `η` have any distribution and let the `N` samples be independent of each other and of the
//! noise at run time, all with that distribution. With probability at least `1 − β` over the samples, every
//! row of the model contains the distribution of the cell of `d_a + η` *after moving to `failed` the mass
//! of every cell that the row does not list*.
//!
//! **Proof.** Four families of events are fixed by the grid, the targets and the labels alone, before any
//! sample is looked at; [`ConfidenceBudget`] sees that their levels sum to at most `β`:
//! - *cells*: for every offset `o` that occurs between a target and a cell, `P(η moves by o)` lies between its
//!   two one-sided Clopper–Pearson bounds. By translation this covers every (action, cell) pair.
//! - *goal*: for every action, `P(d_a + η ∈ goal cells)` lies between its two bounds.
//! - *outside*: for every action, `P(d_a + η` in an unsafe cell or outside the partition`)` is at most its
//!   upper bound.
//! - *unseen*: `P(η ∉ W) ≤ ε` for the bounding box `W` of the samples ([`unseen_mass`]).
//!
//! By the union bound all of them hold together with probability at least `1 − β`. Take a row. A listed
//! ordinary cell's probability lies in its interval (*cells*). If `W` meets goal cells, `reached` gets all
//! goal cells: *goal* bounds it from both sides, and the sum of the lower bounds of its cells from below.
//! What is left, `failed`, is mass in unsafe cells or outside plus mass in unlisted cells. The latter lies
//! outside `d_a + W`, so it is at most `ε`, and the former at most its upper bound; if `d_a + W` meets
//! neither unsafe cells nor the outside, both together lie outside `d_a + W` and `ε` alone is enough. ∎
//!
//! Floating point: the input steers to `d_a + e` with an error `e`, bounded but different for every state, and
//! samples are rounded numbers. Put for each set `C` above `C⁻ = {y : y + e ∈ C for all such e}` and
//! `C⁺ = {y : y + e ∈ C for some e}`. Samples that count for certain are in `C⁻ − d_a`, all samples in
//! `C⁺ − d_a` possibly count, and both sets are fixed beforehand. So the lower bound is one for
//! `P(d_a + η ∈ C⁻)`, the upper one for `P(d_a + η ∈ C⁺)`: they enclose `P(d_a + e + η ∈ C)` for every `e` at once,
//! and the number of events stays the same. Likewise the listed cells contain `d_a + e + W` for every `e`.
//!
//! Moving mass to `failed` can only lower the probability of a formula that is false from `failed` on, so
//! robust lower bounds of such formulas (`Pmaxmin`, `Pminmin`) carry over to the system; dually, upper
//! bounds with maximising nature of `F "failed"`. Nothing else is claimed. Samples whose cell is not certain
//! in floating point count for the upper bounds of every cell they may be in, for the lower bounds of none.

use super::AbstractionError;
use super::count_table::CountTable;
use super::landing::{Count, RegionCounts};
use super::landings::{Landings, for_each_cell, is_inside};
use super::states::{FAILED, REACHED, StateSpace};
use super::targets::Targets;
use crate::imdp::Rows;
use crate::numeric::{Rational, round_decimal_down, round_decimal_up};
use crate::partition::{CellKind, Grid};
use crate::progress::Progress;
use crate::spec::Problem;
use crate::statistics::{ConfidenceBudget, lower_bound, unseen_mass, upper_bound};
use num_bigint::BigInt;
use rayon::prelude::*;

/// Written bounds have this many significant digits, rounded outwards: files stay short, and the loss is
/// far below what the statistics leave open.
const DIGITS: usize = 10;

/// How the budget is split, in hundredths: chosen once, never by looking at samples.
const SHARES: [(&str, i64); 4] = [("cells", 45), ("goal", 20), ("outside", 10), ("unseen mass", 25)];

/// The most that may be unseen: beyond it no policy could be shown to succeed more often than not.
const MAX_UNSEEN: f64 = 0.5;

/// Rows and what they are based on.
pub(super) struct PacRows {
    pub(super) rows: Rows,
    pub(super) budget: ConfidenceBudget,
    pub(super) unseen_mass: f64,
}

/// The levels of the four families of events.
struct Levels {
    cell: f64,
    goal: f64,
    outside: f64,
    unseen: f64,
}

impl Levels {
    fn spend(
        budget: &mut ConfidenceBudget,
        cells: &BigInt,
        actions: usize,
    ) -> Result<Self, AbstractionError> {
        let actions = BigInt::from(actions);
        let events = [cells, &actions, &actions, &BigInt::from(1)];
        let tails = [2, 2, 1, 1];
        let mut levels = [0.0; 4];
        for (i, (family, share)) in SHARES.into_iter().enumerate() {
            let share = Rational::new(share.into(), 100.into());
            levels[i] = budget.spend(family, &share, events[i], tails[i])?;
        }
        let [cell, goal, outside, unseen] = levels;
        Ok(Self { cell, goal, outside, unseen })
    }
}

/// Both bounds for every count that occurs, each rounded outwards to a short decimal.
struct BoundTable {
    lower: CountTable<f64>,
    upper: CountTable<f64>,
}

impl BoundTable {
    /// Bounds at one-sided `level` for the certain and the possible counts.
    fn new(counts: impl Iterator<Item = Count> + Clone, samples: u64, level: f64) -> Self {
        let lower = |k| round_decimal_down(lower_bound(k, samples, level), DIGITS);
        let upper = |k| round_decimal_up(upper_bound(k, samples, level), DIGITS).min(1.0);
        Self {
            lower: CountTable::new(counts.clone().map(|count| count.certain), lower),
            upper: CountTable::new(counts.map(|count| count.possible), upper),
        }
    }

    fn lower(&self, count: Count) -> f64 {
        self.lower.get(count.certain)
    }

    fn upper(&self, count: Count) -> f64 {
        self.upper.get(count.possible)
    }
}

/// What all rows have in common.
struct Context<'a> {
    problem: &'a Problem,
    targets: &'a Targets,
    landings: &'a Landings<'a>,
    states: &'a StateSpace,
    cells: BoundTable,
    goal: BoundTable,
    lost: BoundTable,
    unseen: f64,
}

/// One row per target.
pub(super) fn build(
    problem: &Problem,
    beta: &Rational,
    targets: &Targets,
    landings: &Landings<'_>,
    states: &StateSpace,
    progress: &dyn Progress,
) -> Result<PacRows, AbstractionError> {
    let (grid, samples) = (&problem.grid, problem.noise.samples.len() as u64);
    let mut budget = ConfidenceBudget::new(beta.clone());
    let levels = Levels::spend(&mut budget, &landings.cell_events(grid, targets), targets.len())?;
    let unseen = round_decimal_up(unseen_mass(grid.dimension(), samples, levels.unseen), DIGITS).min(1.0);
    if unseen > MAX_UNSEEN {
        let needed = enough_samples(grid.dimension(), levels.unseen);
        return Err(AbstractionError::TooFewSamples { samples, needed, unseen });
    }
    let regions: Vec<RegionCounts> = (0..targets.len())
        .into_par_iter()
        .map_init(
            || vec![0; grid.dimension()],
            |origin, target| {
                let landing = landings.of(targets, target, grid, origin);
                landing.region_counts(origin, grid, &problem.labels)
            },
        )
        .collect();
    let of_cells = landings.distinct_counts(targets, grid);
    let context = Context {
        problem,
        targets,
        landings,
        states,
        cells: BoundTable::new(of_cells.iter().copied(), samples, levels.cell),
        goal: BoundTable::new(regions.iter().map(|r| r.goal), samples, levels.goal),
        lost: BoundTable::new(regions.iter().map(|r| r.lost), samples, levels.outside),
        unseen,
    };
    let rows = super::row_tasks::build_rows(targets.len(), progress, |target, rows| {
        context.push_row(target, regions[target], rows);
    });
    Ok(PacRows { rows, budget, unseen_mass: unseen })
}

impl Context<'_> {
    fn push_row(&self, target: usize, regions: RegionCounts, rows: &mut Rows) {
        let grid: &Grid = &self.problem.grid;
        let mut origin = vec![0; grid.dimension()];
        let landing = self.landings.of(self.targets, target, grid, &mut origin);
        let mut clean = is_inside(landing.window(), &origin, grid);
        let (mut meets_goal, mut goal_lower) = (false, 0.0);
        for_each_cell(&landing, &origin, grid, |cell, count| match self.problem.labels.kind(cell) {
            CellKind::Ordinary => {}
            CellKind::Unsafe => clean = false,
            CellKind::Goal => {
                meets_goal = true;
                goal_lower = f64::next_down(goal_lower + self.cells.lower(count)).max(0.0);
            }
        });
        let lost = if clean { 0.0 } else { self.lost.upper(regions.lost) };
        let failed = (self.unseen + lost).next_up();
        rows.push_entry(FAILED, 0.0, round_decimal_up(failed, DIGITS).min(1.0));
        if meets_goal {
            let lower = self.goal.lower(regions.goal).max(round_decimal_down(goal_lower, DIGITS));
            rows.push_entry(REACHED, lower, self.goal.upper(regions.goal));
        }
        for_each_cell(&landing, &origin, grid, |cell, count| {
            if self.problem.labels.kind(cell) == CellKind::Ordinary {
                rows.push_entry(self.states.of_cell(cell), self.cells.lower(count), self.cells.upper(count));
            }
        });
        rows.finish_row();
    }
}

/// The smallest number of samples with which less than half of the mass may be unseen.
fn enough_samples(dimension: usize, level: f64) -> u64 {
    let enough = |samples: u64| unseen_mass(dimension, samples, level) <= MAX_UNSEEN;
    let mut high = 2 * dimension as u64;
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
