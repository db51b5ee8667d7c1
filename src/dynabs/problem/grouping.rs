//! How many steps should become one, if that is not said: what each number of steps could do, in doubles.

use super::{Actions, TargetId, TargetPoints};
use crate::geometry::Polytope;
use crate::partition::{CellId, CellKind, CellLabels, Grid};
use crate::system::{GroupingTrial, LinearSystem, rough_right_inverse};
use imdp::numeric::to_f64;
use nalgebra::{DMatrix, DVector};

/// No more steps than this are grouped without being asked for.
const MOST_STEPS: usize = 64;
/// If the states of a cell take more of an input than this share of its range, little is left to move the cell with.
const ROOMY: f64 = 0.5;
/// So many targets are tried, spread evenly over those in the goal.
const GOAL_TARGETS: usize = 64;
/// So many targets are all tried; of more, those in the easiest direction.
const FEW_TARGETS: u32 = 10_000;
/// In more dimensions the cells around one are too many to try.
const MOST_NEIGHBOURED: usize = 6;

/// What the search is about.
pub(super) struct Setting<'a> {
    /// The system of one step.
    pub(super) system: &'a LinearSystem,
    /// The inputs of one step.
    pub(super) input: &'a Polytope,
    pub(super) grid: &'a Grid,
    pub(super) actions: &'a Actions,
    pub(super) labels: &'a CellLabels,
    pub(super) start: Option<CellId>,
}

impl Setting<'_> {
    /// What each number of steps from `fewest` on could do, until one works with room to move or `most` is reached; the
    /// fewest need no more than to work.
    pub(super) fn trials(&self, fewest: usize, most: usize) -> Vec<GroupingTrial> {
        let mut trials = Vec::new();
        for steps in fewest..=most.min(MOST_STEPS).max(fewest) {
            let Some(trial) = self.trial(steps) else { break };
            let enough = trial.works() && (steps == fewest || trial.share <= ROOMY);
            trials.push(trial);
            if enough {
                break;
            }
        }
        trials
    }

    /// The number of steps to take of these: the fewest if they work, or else the first that works with room to move, or
    /// else the first that works, or else the fewest.
    pub(super) fn chosen(trials: &[GroupingTrial]) -> Option<usize> {
        let fewest = trials.first()?;
        let roomy = trials.iter().find(|trial| trial.works() && trial.share <= ROOMY);
        let working = || trials.iter().find(|trial| trial.works());
        let chosen = if fewest.works() { Some(fewest) } else { roomy.or_else(working) };
        Some(chosen.unwrap_or(fewest).steps)
    }

    fn trial(&self, steps: usize) -> Option<GroupingTrial> {
        let law = RoughLaw::new(self, steps)?;
        let p = self.system.input_dimension();
        let (input, share) = (0..law.shares.len())
            .map(|i| (i % p, law.shares[i]))
            .max_by(|(_, one), (_, other)| one.total_cmp(other))?;
        let Actions::Targets(points) = self.actions;
        let targets = Points::new(points, self.grid);
        let fits = share <= 1.0;
        let leaves_start = self.start.map(|cell| {
            let x = center(self.grid, cell);
            fits && targets
                .near(&law.end(&x))
                .into_iter()
                .any(|target| law.steers(&x, &targets.point(target)))
        });
        let has_goal = self.labels.count(CellKind::Goal) > 0;
        let meets_goal = has_goal.then(|| fits && self.meets_goal(&law, &targets));
        Some(GroupingTrial { steps, input, share, leaves_start, meets_goal })
    }

    fn meets_goal(&self, law: &RoughLaw, targets: &Points<'_>) -> bool {
        let in_goal: Vec<TargetId> = (0..targets.len())
            .map(TargetId)
            .filter(|&target| {
                targets.cell(target).is_some_and(|cell| self.labels.kind(cell) == CellKind::Goal)
            })
            .collect();
        let stride = in_goal.len().div_ceil(GOAL_TARGETS).max(1);
        in_goal.iter().step_by(stride).any(|&target| {
            let point = targets.point(target);
            let start = law.easiest_start(&point);
            around(self.grid, &start).into_iter().any(|cell| {
                self.labels.kind(cell) == CellKind::Ordinary && law.steers(&center(self.grid, cell), &point)
            })
        })
    }
}

/// The law that steers to targets in some number of steps, in doubles and without care for rounding.
struct RoughLaw {
    target: DMatrix<f64>,
    state: DMatrix<f64>,
    constant: DVector<f64>,
    /// `Âx + q̂ + B̂ū` for the middle `ū` of all inputs: the map, and what is added.
    free: (DMatrix<f64>, DVector<f64>),
    /// `G`, `g` of the inputs of all steps, the latter less what the states of a cell may add.
    normals: DMatrix<f64>,
    offsets: DVector<f64>,
    /// The middle of the range of every input.
    middle: DVector<f64>,
    /// Per input, the share of its range that the states of one cell take.
    shares: Vec<f64>,
}

impl RoughLaw {
    fn new(setting: &Setting<'_>, steps: usize) -> Option<Self> {
        let (a, b, q) =
            (setting.system.a().to_f64(), setting.system.b().to_f64(), setting.system.q().to_f64());
        let (n, p) = b.shape();
        let (mut power, mut drift) = (DMatrix::identity(n, n), DVector::zeros(n));
        let mut grouped = DMatrix::zeros(n, p * steps);
        for step in (0..steps).rev() {
            grouped.view_mut((0, step * p), (n, p)).copy_from(&(&power * &b));
            drift += &power * q.column(0);
            power = &power * &a;
        }
        let bounds = setting.input.bounding_box()?;
        let over_steps = |value: &dyn Fn(f64, f64) -> f64| {
            DVector::from_fn(p * steps, |i, _| value(to_f64(&bounds[i % p].0), to_f64(&bounds[i % p].1)))
        };
        let half = over_steps(&|lower, upper| (upper - lower) / 2.0);
        let middle = over_steps(&|lower, upper| (upper + lower) / 2.0);
        let cell: Vec<f64> = setting.grid.widths().iter().map(|width| width / 2.0).collect();
        let target = rough_right_inverse(&grouped, half.as_slice())?;
        let state = -&target * &power;
        drift += &grouped * &middle;
        let constant = &middle - &target * &drift;
        let taken = |row: &[f64]| row.iter().zip(&cell).map(|(gain, half)| gain.abs() * half).sum::<f64>();
        let row_of = |matrix: &DMatrix<f64>, i: usize| matrix.row(i).iter().copied().collect::<Vec<f64>>();
        // An input that is fixed is not used by the law either.
        let share = |i| if half[i] > 0.0 { taken(&row_of(&state, i)) / half[i] } else { 0.0 };
        let shares = (0..p * steps).map(share).collect();
        let inputs = setting.input.power(steps);
        let normals = inputs.normals().to_f64();
        let of_state = &normals * &state;
        let offsets = DVector::from_fn(normals.nrows(), |i, _| {
            to_f64(&inputs.offsets()[i]) - taken(&row_of(&of_state, i))
        });
        Some(Self { target, state, constant, free: (power, drift), normals, offsets, middle, shares })
    }

    /// Whether all states of the cell with center `x` can be steered to `target`.
    fn steers(&self, x: &DVector<f64>, target: &DVector<f64>) -> bool {
        let input = &self.target * target + &self.state * x + &self.constant;
        (&self.normals * input).iter().zip(self.offsets.iter()).all(|(value, offset)| value <= offset)
    }

    /// Where `x` ends with inputs in the middle of their ranges.
    fn end(&self, x: &DVector<f64>) -> DVector<f64> {
        &self.free.0 * x + &self.free.1
    }

    /// Where steering to `target` takes inputs nearest to the middle of their ranges.
    fn easiest_start(&self, target: &DVector<f64>) -> DVector<f64> {
        let wanted = &self.middle - &self.constant - &self.target * target;
        self.state.clone().svd(true, true).solve(&wanted, 1e-12).unwrap_or_else(|_| target.clone())
    }
}

/// The points that are steered to.
struct Points<'a> {
    points: &'a TargetPoints,
    grid: &'a Grid,
}

impl<'a> Points<'a> {
    fn new(points: &'a TargetPoints, grid: &'a Grid) -> Self {
        Self { points, grid }
    }

    fn len(&self) -> u32 {
        match self.points {
            TargetPoints::Centers => self.grid.num_cells(),
            TargetPoints::Grid(grid) => grid.num_cells(),
            TargetPoints::List(points) => points.len() as u32,
        }
    }

    fn point(&self, target: TargetId) -> DVector<f64> {
        match self.points {
            TargetPoints::Centers => center(self.grid, CellId(target.0)),
            TargetPoints::Grid(grid) => center(grid, CellId(target.0)),
            TargetPoints::List(points) => DVector::from_iterator(
                points[target.index()].len(),
                points[target.index()].iter().map(to_f64),
            ),
        }
    }

    /// All targets if they are few, else those nearest to `x`.
    fn near(&self, x: &DVector<f64>) -> Vec<TargetId> {
        let nearest = |grid: &Grid| around(grid, x).into_iter().map(|cell| TargetId(cell.0)).collect();
        match self.points {
            TargetPoints::Centers if self.len() > FEW_TARGETS => nearest(self.grid),
            TargetPoints::Grid(grid) if self.len() > FEW_TARGETS => nearest(grid),
            _ => (0..self.len()).map(TargetId).collect(),
        }
    }

    /// The cell that a target is in.
    fn cell(&self, target: TargetId) -> Option<CellId> {
        match self.points {
            TargetPoints::Centers => Some(CellId(target.0)),
            TargetPoints::Grid(grid) => {
                let centers = grid.axes().iter().zip(grid.coordinates(CellId(target.0)));
                self.grid.locate(&centers.map(|(axis, i)| axis.center(i)).collect::<Vec<_>>())
            }
            TargetPoints::List(points) => self.grid.locate(&points[target.index()]),
        }
    }
}

fn center(grid: &Grid, cell: CellId) -> DVector<f64> {
    let centers = grid.axes().iter().zip(grid.coordinates(cell)).map(|(axis, i)| to_f64(&axis.center(i)));
    DVector::from_iterator(grid.dimension(), centers)
}

/// The cell nearest to `x` and those around it.
fn around(grid: &Grid, x: &DVector<f64>) -> Vec<CellId> {
    let axes = grid.axes();
    let nearest = axes.iter().zip(x.iter()).map(|(axis, &x)| {
        let position = (x - to_f64(axis.lower())) / to_f64(axis.width());
        (position.max(0.0) as u32).min(axis.cells() - 1)
    });
    let mut found = vec![vec![]];
    for (axis, middle) in axes.iter().zip(nearest) {
        let reach = u32::from(axes.len() <= MOST_NEIGHBOURED);
        let side = middle.saturating_sub(reach)..=(middle + reach).min(axis.cells() - 1);
        let longer = |known: &Vec<u32>| {
            let known = known.clone();
            side.clone().map(move |i| known.iter().copied().chain([i]).collect::<Vec<u32>>())
        };
        found = found.iter().flat_map(longer).collect();
    }
    found.iter().map(|coordinates| grid.cell(coordinates)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trials(shares: &[f64]) -> Vec<GroupingTrial> {
        let trial = |(i, &share): (usize, &f64)| GroupingTrial {
            steps: i + 2,
            input: 0,
            share,
            leaves_start: None,
            meets_goal: Some(share <= 1.0),
        };
        shares.iter().enumerate().map(trial).collect()
    }

    #[test]
    fn no_more_steps_are_grouped_than_help() {
        let chosen = |shares: &[f64]| Setting::chosen(&trials(shares));
        assert_eq!(chosen(&[0.9]), Some(2));
        assert_eq!(chosen(&[3.0, 0.9, 0.4]), Some(4));
        // Nothing has room: the first that works at all, not the last.
        assert_eq!(chosen(&[3.0, 0.9, 0.8, 0.7]), Some(3));
        assert_eq!(chosen(&[3.0, 2.0]), Some(2));
        assert_eq!(chosen(&[]), None);
    }
}
