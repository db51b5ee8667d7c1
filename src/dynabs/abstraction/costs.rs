//! Costs as rewards of a model, and what is asked about them: the same for all kinds of actions.
//!
//! Every cost becomes two structures: its *greatest* value over what a choice may meet, under its own name, and its *least*,
//! called `NAME_least`. A controller that chooses by cells and the past costs at most what the choices of the policy cost
//! with the first, whatever nature does; and no such controller costs less than the best policy with the second, nature
//! helping: by induction over the steps, as for probabilities.
//!
//! What is not listed, or is said to leave, has failed in the model although runs may go on. From there on a step
//! costs as much as one does at most, or nothing. A run that has reached its goal costs nothing any more.

use crate::problem::Cost;
use crate::task::Aim;
use imdp::model::{RewardError, RewardStructure, StateId};

/// Why a model has no costs.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CostError {
    /// A cost is not bounded.
    #[error(
        "/costs/{name}/step: found no bound in cell {cell} with {action}; expected a cost that is finite all over every \
         cell\n  Bound it, as in clip(…, 0, 100), or move the partition away from where it is undefined."
    )]
    Unbounded {
        /// The cost.
        name: String,
        /// The cell.
        cell: u32,
        /// The action: `input 3`.
        action: String,
    },
    /// Where the state is within a group of steps is not known.
    #[error(
        "/costs/{name}/step: found a cost of the state at each of the {steps} steps that are grouped into one; expected one of \
         the input alone, for where the state is in between has no bound\n  Bound it, as in clip(…, 0, 100), or use \
         \"actions\": \"inputs\", which look at every step."
    )]
    InBetween {
        /// The cost.
        name: String,
        /// How many steps.
        steps: u64,
    },
    /// Costs of a task without an end have no sum.
    #[error(
        "/costs/{name}: found a task that never ends and no discount; expected a horizon, a task that reaches something, or a \
         discount below 1"
    )]
    Endless {
        /// The cost.
        name: String,
    },
    /// A step of the system is several of the model.
    #[error(
        "/costs/{name}/discount: found a model with {micro_steps} steps for each of the system; expected one, to discount by"
    )]
    MicroSteps {
        /// The cost.
        name: String,
        /// How many steps.
        micro_steps: u64,
    },
    /// A step of the model is several of the system.
    #[error(
        "/costs/{name}/discount: found {steps} steps of the system in each of the model; expected one, to discount by\n  Use \
         \"actions\": \"inputs\", which look at every step."
    )]
    GroupedSteps {
        /// The cost.
        name: String,
        /// How many steps.
        steps: u64,
    },
    /// Nothing is known of costs.
    #[error(
        "/costs: found mode \"reference\"; expected \"pac\", for the published tool's numbers bound no cost"
    )]
    Reference,
    /// They do not fit into memory.
    #[error(transparent)]
    Memory(#[from] imdp::model::MemoryError),
    /// They are not rewards of the model: a mistake in this program.
    #[error(transparent)]
    Reward(#[from] RewardError),
}

/// The upper and the lower bound on the least expected cost, in PRISM's syntax, for a task with so many steps of the model.
pub(super) fn questions(cost: &Cost, aim: Aim, steps: Option<u64>) -> Result<[String; 2], CostError> {
    let name = cost.name();
    let path = match (cost.discount(), steps) {
        (Some(discount), Some(steps)) => format!("C<={steps}, discount={discount}"),
        (Some(discount), None) => format!("C, discount={discount}"),
        (None, Some(steps)) => format!("C<={steps}"),
        (None, None) if aim == Aim::Reach => "F \"reached\"".to_owned(),
        (None, None) => return Err(CostError::Endless { name: name.to_owned() }),
    };
    Ok([
        format!("\"{name}\": R{{\"{name}\"}}minmax=? [ {path} ]"),
        format!("\"{name}_least\": R{{\"{name}_least\"}}minmin=? [ {path} ]"),
    ])
}

/// What choices cost at most and at least, by number of the choice.
pub(super) struct Priced {
    greatest: Vec<f64>,
    least: Vec<f64>,
    largest: f64,
}

impl Priced {
    /// Choices that cost nothing.
    pub(super) fn nothing(choices: usize) -> Self {
        Self { greatest: vec![0.0; choices], least: vec![0.0; choices], largest: 0.0 }
    }

    /// Says what a choice costs; none if that is not finite.
    pub(super) fn set(&mut self, choice: usize, (low, high): (f64, f64)) -> Option<()> {
        // Doubles are read as decimals, which may lie on either side of them.
        let greatest = if high > 0.0 { high.next_up() } else { 0.0 };
        if !greatest.is_finite() {
            return None;
        }
        (self.least[choice], self.greatest[choice]) = (low.next_down().max(0.0), greatest);
        self.largest = self.largest.max(greatest);
        Some(())
    }

    /// The structures for a model with so many states, `failed` among them: a visit there costs `part` of a step.
    pub(super) fn structures(
        self,
        cost: &Cost,
        states: usize,
        failed: impl Iterator<Item = StateId>,
        part: impl Fn(f64) -> f64,
    ) -> [RewardStructure; 2] {
        let outside = cost.outside().map_or(self.largest, |outside| outside.next_up().max(self.largest));
        let mut of_states = vec![0.0; states];
        failed.for_each(|state| of_states[state.index()] = part(outside));
        let [mut dear, mut cheap] = unpriced(cost);
        (dear.states, dear.choices, cheap.choices) = (of_states, self.greatest, self.least);
        [dear, cheap]
    }
}

/// Structures of costs that nothing has.
pub(super) fn unpriced(cost: &Cost) -> [RewardStructure; 2] {
    [RewardStructure::new(cost.name()), RewardStructure::new(format!("{}_least", cost.name()))]
}
