//! Why a bound is low, and what to change: the reasons in the order in which they should be looked at.
//!
//! None of this is proven, and none of it needs to be: it compares the bound with what the abstraction would be
//! worth with other steps, other samples, another border.

mod evidence;
mod losses;
mod reach;
mod reason;

pub use reason::{Explanation, GroupingTable, Loss, Reason, Spread};

use crate::abstraction::Abstraction;
use crate::controller::Controller;
use crate::partition::CellKind;
use crate::problem::Problem;
use crate::task::Aim;
use imdp::progress::Progress;
use imdp::solver::Answer;

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
            reasons.extend(losses::simulate(problem, controller, progress));
        }
        Some(_) => {}
    }
    reasons.push(Reason::Noise { spreads: losses::spreads(problem) });
    Explanation { bound: controller.promised().bound, reasons }
}
