//! Value iteration over all cells, rounded to one side.

use super::images::Images;
use super::side::{Lower, Upper};
use super::step::{Best, Landing};
use imdp::model::StateId;
use imdp::solver::{Control, NO_CHOICE, Policy, SolverOptions, Status, ValueBounds};
use serde::{Deserialize, Serialize};

/// What a run of the system is wanted to do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Aim {
    /// To come to a cell of the goal.
    #[default]
    Reach,
    /// To stay in the open cells.
    Stay,
}

/// A task on the lattice.
#[derive(Clone, Copy, Debug)]
pub struct Question<'a> {
    /// Where noise takes what lands.
    pub landing: &'a Landing,
    /// Where inputs take the open cells.
    pub images: &'a Images,
    /// The cells in which there is something to decide, ascending; to be in any other cell is to have won or lost.
    pub open: &'a [u32],
    /// By cell: whether it is in the goal.
    pub goal: &'a [bool],
    /// What is wanted.
    pub aim: Aim,
    /// Within how many steps, or at any time.
    pub steps: Option<u64>,
}

/// Bounds on the value of every cell, and the policy that guarantees the lower ones.
#[derive(Clone, Debug)]
pub struct LandingSolution {
    /// The bounds, by cell.
    pub values: ValueBounds,
    /// By cell: its inputs.
    pub policy: Policy,
    /// How the computation ended.
    pub status: Status,
    /// The number of steps taken from below.
    pub iterations: u64,
}

/// Without a bound on the steps, bounds that change by less than this part of `epsilon` no longer move.
const STANDSTILL: f64 = 1e-2;

impl Question<'_> {
    /// Bounds on the value from both sides.
    ///
    /// The lower one is the robust value of a policy with these inputs; no controller with these inputs is worth more
    /// than the upper one. Both hold however the computation ends.
    pub fn solve(&self, options: &SolverOptions<'_>) -> LandingSolution {
        let mut control = Control::new(options);
        let (lower, policy, stopped) = self.lower_bounds(&mut control);
        let iterations = control.iterations;
        let (upper, stopped_above) = match stopped {
            None => self.upper_bounds(&mut control, iterations),
            Some(_) => (self.most(), None),
        };
        let values = ValueBounds { lower, upper };
        let status = match (stopped.or(stopped_above), self.steps) {
            (Some(reason), _) => reason,
            (None, Some(_)) => Status::HorizonReached,
            (None, None) if values.gap() <= options.epsilon => Status::Converged,
            (None, None) => Status::PrecisionLimit,
        };
        LandingSolution { values, policy, status, iterations }
    }

    /// The values before any step: 1 in the goal, or in the cells to stay in.
    fn start(&self) -> Vec<f64> {
        match self.aim {
            Aim::Reach => self.goal.iter().map(|&goal| f64::from(u8::from(goal))).collect(),
            Aim::Stay => self.most(),
        }
    }

    /// The largest values there can be.
    fn most(&self) -> Vec<f64> {
        let mut values: Vec<_> = self.goal.iter().map(|&goal| f64::from(u8::from(goal))).collect();
        self.open.iter().for_each(|&cell| values[cell as usize] = 1.0);
        values
    }

    /// Lower bounds and the policy that guarantees them.
    ///
    /// To stay for ever under the worst noise is to be where one can for certain, or to come there.
    fn lower_bounds(&self, control: &mut Control<'_>) -> (Vec<f64>, Policy, Option<Status>) {
        let mut policy = Choices::new(self.goal.len(), self.steps);
        let mut values = self.start();
        if self.aim == Aim::Stay && self.steps.is_none() {
            values =
                self.landing.invariant(self.images, self.open, |cell, input| policy.note(cell, 1, input));
        }
        let certain: Vec<bool> = values.iter().map(|&v| v == 1.0).collect();
        let shrinks = self.aim == Aim::Stay && self.steps.is_some();
        while self.steps.is_none_or(|steps| control.iterations < steps) {
            if let Some(reason) = control.stop() {
                let values = if shrinks { vec![0.0; values.len()] } else { values };
                return (values, policy.finish(), Some(reason));
            }
            let best = self.landing.best::<Lower>(self.images, &values);
            let left = control.iterations + 1;
            let mut change = 0.0f64;
            for &cell in self.open {
                let at = cell as usize;
                if certain[at] && !shrinks {
                    continue;
                }
                let (old, new) = (values[at], best.values[at]);
                if shrinks || new > old {
                    policy.note(cell, left, best.inputs[at]);
                    values[at] = new;
                    change = change.max((new - old).abs());
                }
            }
            control.done(change);
            if !shrinks && change <= self.standstill(control) {
                break;
            }
        }
        (values, policy.finish(), None)
    }

    /// Upper bounds; without a bound on the steps, those after `iterations` steps from above.
    fn upper_bounds(&self, control: &mut Control<'_>, iterations: u64) -> (Vec<f64>, Option<Status>) {
        let shrinks = self.steps.is_none() || self.aim == Aim::Stay;
        let mut values = if shrinks { self.most() } else { self.start() };
        for _ in 0..self.steps.unwrap_or(iterations) {
            if let Some(reason) = control.stop() {
                return (if shrinks { values } else { self.most() }, Some(reason));
            }
            let Best { values: best, .. } = self.landing.best::<Upper>(self.images, &values);
            let mut change = 0.0f64;
            for &cell in self.open {
                let (old, new) = (&mut values[cell as usize], best[cell as usize]);
                // Exact values move one way only: anything else is rounding.
                let new = if shrinks { new.min(*old) } else { new.max(*old) };
                change = change.max((new - *old).abs());
                *old = new;
            }
            control.done(change);
            if change == 0.0 || self.steps.is_none() && change <= self.standstill(control) {
                break;
            }
        }
        (values, None)
    }

    fn standstill(&self, control: &Control<'_>) -> f64 {
        if self.steps.is_some() { 0.0 } else { STANDSTILL * control.options().epsilon }
    }
}

/// The inputs chosen so far.
struct Choices {
    steps: Option<u64>,
    now: Vec<u32>,
    changes: Vec<(StateId, u64, u32)>,
}

impl Choices {
    fn new(cells: usize, steps: Option<u64>) -> Self {
        Self { steps, now: vec![NO_CHOICE; cells], changes: vec![] }
    }

    fn note(&mut self, cell: u32, left: u64, input: u32) {
        let now = &mut self.now[cell as usize];
        if *now != input {
            *now = input;
            if self.steps.is_some() {
                self.changes.push((StateId(cell), left, input));
            }
        }
    }

    fn finish(self) -> Policy {
        match self.steps {
            Some(steps) => Policy::time_varying(steps, self.now.len(), &self.changes),
            None => Policy::stationary(&self.now),
        }
    }
}
