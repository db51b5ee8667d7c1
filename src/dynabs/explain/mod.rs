//! Why a bound is low, and what to change: the reasons in the order in which they should be looked at.
//!
//! None of this is proven, and none of it needs to be: it compares the bound with what the abstraction would be
//! worth with other steps, other samples, another border.

mod evidence;
mod inputs;
mod losses;
mod reach;
mod reason;
mod trials;

pub use inputs::explain_inputs;
pub use reason::{Explanation, GroupingTable, Loss, Reason, Spread, Trial};

use crate::abstraction::Abstraction;
use crate::controller::{Controller, Noise, Simulation};
use crate::partition::CellKind;
use crate::problem::Problem;
use crate::task::Aim;
use imdp::progress::Progress;
use imdp::solver::Answer;

/// Runs of unbounded tasks are given up after this many steps.
const MOST_STEPS: u64 = 10_000;

/// Why the bound on a compiled and solved problem is what it is.
pub fn explain(
    problem: &Problem,
    abstraction: &Abstraction,
    answer: &Answer,
    controller: &Controller,
    progress: &dyn Progress,
) -> Explanation {
    let mut reasons = Vec::new();
    let labels = problem.labels();
    let (ordinary, kind) = (labels.count(CellKind::Ordinary), |cell| labels.kind(cell));
    let blocked = |cell: crate::partition::CellId| {
        kind(cell) == CellKind::Ordinary
            && abstraction.model.choices().is_absorbing(abstraction.state_of_cell[cell.index()])
    };
    let idle = labels.iter().filter(|&(cell, _)| blocked(cell)).count();
    match problem.initial_cell() {
        None => {
            let best = labels
                .iter()
                .filter(|(_, kind)| *kind == CellKind::Ordinary)
                .map(|(cell, _)| controller.bound(cell))
                .fold(0.0, f64::max);
            reasons.push(Reason::NoStart { idle, ordinary, best });
        }
        Some(cell) if kind(cell) == CellKind::Unsafe => reasons.push(Reason::UnsafeStart),
        Some(cell) if blocked(cell) => {
            reasons.push(Reason::NothingAtStart { idle, ordinary, grouping: problem.grouping().to_vec() });
        }
        Some(cell) if kind(cell) == CellKind::Ordinary => {
            let reach = reach::Reach::new(problem, abstraction, cell);
            let too_far = reach.to_goal.is_none_or(|steps| problem.horizon().is_some_and(|k| steps > k));
            if problem.objective().aim() == Aim::Reach && too_far {
                reasons.push(Reason::TooFar {
                    steps: reach.to_goal,
                    horizon: problem.horizon(),
                    visited: reach.visited,
                    ordinary,
                });
            }
            reasons.extend(evidence::weigh(problem, abstraction, answer));
            if let Some(start) = problem.initial_state() {
                let noise = Noise::of_plant(problem.noise());
                let simulation = Simulation::new(problem, controller, noise, MOST_STEPS);
                let names: Vec<String> = (1..=start.len()).map(|j| format!("x{j}")).collect();
                reasons.push(losses::simulate(&simulation, problem.grid(), &names, start, progress));
            }
        }
        Some(_) => {}
    }
    reasons.push(Reason::Noise { spreads: losses::spread_of(&problem.noise().spread(), problem.grid()) });
    Explanation { bound: controller.promised().bound, reasons }
}
