//! Value iteration over all cells and memories, rounded to one side.

use super::images::Images;
use super::side::{Lower, Side, Upper};
use super::step::{Best, Landing};
use crate::task::{Aim, CellTask, Memory, Standing};
use imdp::model::StateId;
use imdp::solver::{Control, NO_CHOICE, Policy, SolverOptions, Status, ValueBounds};
use rayon::prelude::*;

/// A task on the lattice.
#[derive(Clone, Copy, Debug)]
pub struct Question<'a> {
    /// Where noise takes what lands.
    pub landing: &'a Landing,
    /// Where inputs take the open cells.
    pub images: &'a Images,
    /// The cells in which something can be done, ascending; what is open in another cell has failed.
    pub open: &'a [u32],
    /// What is wanted.
    pub task: &'a CellTask,
    /// Within how many steps, or at any time.
    pub steps: Option<u64>,
}

/// Bounds on the value of every cell, and the policy that guarantees the lower ones.
#[derive(Clone, Debug)]
pub struct LandingSolution {
    /// The bounds at the start, by cell.
    pub values: ValueBounds,
    /// The bounds with a memory, by `memory · cells + cell`; 0 where nothing is open.
    pub with_memory: ValueBounds,
    /// The inputs, by `memory · cells + cell`.
    pub policy: Policy,
    /// The lower bounds at the start with 0, 1, … steps left, if [`SolverOptions::history`] has room for all.
    pub history: Vec<Vec<f64>>,
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
        // From below, then from above.
        let mut control = Control::of(options, self.steps.map(|steps| steps.saturating_mul(2)));
        let pairs = self.pairs();
        let mut history = vec![];
        let (lower, policy, stopped) = self.lower_bounds(&pairs, &mut control, &mut history);
        let iterations = control.iterations;
        let (upper, stopped_above) = match stopped {
            None => self.upper_bounds(&pairs, &mut control, iterations),
            Some(_) => (self.most(&pairs), None),
        };
        let values = ValueBounds {
            lower: self.arrivals::<Lower>(None, &lower),
            upper: self.arrivals::<Upper>(None, &upper),
        };
        let status = match (stopped.or(stopped_above), self.steps) {
            (Some(reason), _) => reason,
            (None, Some(_)) => Status::HorizonReached,
            (None, None) if values.gap() <= options.epsilon => Status::Converged,
            (None, None) => Status::PrecisionLimit,
        };
        LandingSolution {
            values,
            with_memory: ValueBounds { lower, upper },
            policy,
            history,
            status,
            iterations,
        }
    }

    /// By memory, the cells in which something can be done with it, ascending.
    pub(super) fn pairs(&self) -> Vec<Vec<u32>> {
        let with = |memory: Memory| {
            self.open
                .iter()
                .copied()
                .filter(|&cell| self.task.open(cell as usize).contains(&memory))
                .collect()
        };
        (0..self.task.memories()).map(with).collect()
    }

    /// What it is worth to arrive in each cell, with a memory before or at the start, for values by memory and cell.
    pub(super) fn arrivals<S: Side>(&self, before: Option<Memory>, values: &[f64]) -> Vec<f64> {
        let cells = self.task.num_cells();
        let worth = |cell: usize, standing: &Standing| match standing {
            Standing::Failed => 0.0,
            Standing::Reached => 1.0,
            Standing::Open(memory) => values[*memory as usize * cells + cell],
        };
        let arrival = |cell: usize| {
            let all = self.task.standings(before, cell).iter().map(|standing| worth(cell, standing));
            all.reduce(S::of).unwrap_or(0.0)
        };
        (0..cells).into_par_iter().with_min_len(1 << 12).map(arrival).collect()
    }

    /// The lower bounds on arrival in each cell with a memory before, with all steps left.
    pub fn lower_on_arrival(&self, before: Memory, solution: &LandingSolution) -> Vec<f64> {
        self.arrivals::<Lower>(Some(before), &solution.with_memory.lower)
    }

    /// One step with every memory.
    pub(super) fn step<S: Side>(&self, landing: &Landing, values: &[f64]) -> Vec<Best> {
        let best = |memory| landing.best::<S>(self.images, &self.arrivals::<S>(Some(memory), values));
        (0..self.task.memories()).map(best).collect()
    }

    /// The values before any step: those of memories with which the task may end.
    fn start(&self, pairs: &[Vec<u32>]) -> Vec<f64> {
        self.filled(pairs, |memory| self.task.accepts(memory))
    }

    /// The largest values there can be.
    fn most(&self, pairs: &[Vec<u32>]) -> Vec<f64> {
        self.filled(pairs, |_| true)
    }

    fn filled(&self, pairs: &[Vec<u32>], is_one: impl Fn(Memory) -> bool) -> Vec<f64> {
        let cells = self.task.num_cells();
        let mut values = vec![0.0; pairs.len() * cells];
        for (memory, open) in pairs.iter().enumerate().filter(|(memory, _)| is_one(*memory as Memory)) {
            open.iter().for_each(|&cell| values[memory * cells + cell as usize] = 1.0);
        }
        values
    }

    /// Lower bounds and the policy that guarantees them.
    ///
    /// To stay for ever under the worst noise is to be where one can for certain, or to come there.
    fn lower_bounds(
        &self,
        pairs: &[Vec<u32>],
        control: &mut Control<'_>,
        history: &mut Vec<Vec<f64>>,
    ) -> (Vec<f64>, Policy, Option<Status>) {
        let keeps = self.steps.is_some_and(|steps| steps <= control.options().history as u64);
        let cells = self.task.num_cells();
        let mut policy = Choices::new(pairs.len() * cells, self.steps);
        let (aim, is_bounded) = (self.task.aim(), self.steps.is_some());
        let mut values = match aim == Aim::Stay && !is_bounded {
            true => self.invariant(pairs, |pair, input| policy.note(pair, 1, input)),
            false => self.start(pairs),
        };
        let certain: Vec<bool> = values.iter().map(|&v| v == 1.0).collect();
        // Values of reaching grow from step to step, others are only known after the last.
        let renews = aim != Aim::Reach && is_bounded;
        while self.steps.is_none_or(|steps| control.iterations < steps) {
            if let Some(reason) = control.stop() {
                let values = if renews { vec![0.0; values.len()] } else { values };
                return (values, policy.finish(), Some(reason));
            }
            if keeps {
                history.push(self.arrivals::<Lower>(None, &values));
            }
            let left = control.iterations + 1;
            let mut change = 0.0f64;
            for ((memory, best), open) in
                self.step::<Lower>(self.landing, &values).iter().enumerate().zip(pairs)
            {
                for &cell in open {
                    let pair = memory * cells + cell as usize;
                    if certain[pair] && !renews {
                        continue;
                    }
                    let (old, new) = (values[pair], best.values[cell as usize]);
                    if renews || new > old {
                        policy.note(pair as u32, left, best.inputs[cell as usize]);
                        values[pair] = new;
                        change = change.max((new - old).abs());
                    }
                }
            }
            control.done(change);
            if !renews && change <= self.standstill(control) {
                break;
            }
        }
        if keeps {
            // What does not change any more is the same with all steps that are left.
            let last = self.arrivals::<Lower>(None, &values);
            let steps = self.steps.unwrap_or(0) as usize + 1;
            history.resize(steps, last);
        }
        (values, policy.finish(), None)
    }

    /// Upper bounds; without a bound on the steps, those after `iterations` steps from above.
    fn upper_bounds(
        &self,
        pairs: &[Vec<u32>],
        control: &mut Control<'_>,
        iterations: u64,
    ) -> (Vec<f64>, Option<Status>) {
        let cells = self.task.num_cells();
        let (aim, is_bounded) = (self.task.aim(), self.steps.is_some());
        let shrinks = !is_bounded || aim == Aim::Stay;
        let mut values = if shrinks { self.most(pairs) } else { self.start(pairs) };
        for _ in 0..self.steps.unwrap_or(iterations) {
            if let Some(reason) = control.stop() {
                return (if shrinks { values } else { self.most(pairs) }, Some(reason));
            }
            let mut change = 0.0f64;
            for ((memory, best), open) in
                self.step::<Upper>(self.landing, &values).iter().enumerate().zip(pairs)
            {
                for &cell in open {
                    let (old, new) =
                        (&mut values[memory * cells + cell as usize], best.values[cell as usize]);
                    // Exact values move one way only: anything else is rounding.
                    let new = match (shrinks, aim) {
                        (true, _) => new.min(*old),
                        (false, Aim::End) => new,
                        (false, _) => new.max(*old),
                    };
                    change = change.max((new - *old).abs());
                    *old = new;
                }
            }
            control.done(change);
            if change == 0.0 || !is_bounded && change <= self.standstill(control) {
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
