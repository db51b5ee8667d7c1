//! Costs as rewards of the model that files have.
//!
//! Every cost becomes two structures: its *greatest* value over the cell and the feedback, under its own name, and its *least*,
//! called `NAME_least`. A controller that chooses inputs by cells and the past costs at most what the choices of the policy cost
//! with the first, whatever nature does; and no such controller costs less than the best policy with the second, nature
//! helping: by induction over the steps, as for probabilities.
//!
//! Noise that is not listed, and what is said to leave, has failed in the model although runs may go on. From there on a step
//! costs as much as one does at most, or nothing. A run that has reached its goal costs nothing any more.

use super::InputAbstraction;
use super::export::InputModel;
use crate::landing::{FAILED, LOST};
use crate::partition::CellId;
use crate::problem::{Cost, InputProblem};
use crate::system::Interval;
use crate::task::Aim;
use imdp::model::{ActionNames, RewardError, RewardStructure, StateId, require_memory};

/// Why a model has no costs.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CostError {
    /// A cost is not bounded.
    #[error(
        "/costs/{name}/step: found no bound in cell {cell} with input {input}; expected a cost that is finite all over every \
         cell\n  Bound it, as in clip(…, 0, 100), or move the partition away from where it is undefined."
    )]
    Unbounded {
        /// The cost.
        name: String,
        /// The cell.
        cell: u32,
        /// The number of the input.
        input: u32,
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
    /// They do not fit into memory.
    #[error(transparent)]
    Memory(#[from] imdp::model::MemoryError),
    /// They are not rewards of the model: a mistake in this program.
    #[error(transparent)]
    Reward(#[from] RewardError),
}

impl InputAbstraction {
    /// The model with the costs of the problem, and what is asked about them: the least expected cost, an upper and a lower
    /// bound on it each.
    ///
    /// # Errors
    /// [`CostError`] names the cost and what is wrong with it.
    pub fn with_costs(&self, problem: &InputProblem, model: InputModel) -> Result<InputModel, CostError> {
        if problem.costs().is_empty() {
            return Ok(model);
        }
        let mut questions = vec![];
        for cost in problem.costs() {
            questions.extend(self.questions(cost, model.micro_steps)?);
        }
        let choices = model.model.size().choices;
        require_memory("the costs", 16 * choices * problem.costs().len() as u64)?;
        let mut structures = vec![];
        for cost in problem.costs() {
            structures.extend(priced(problem, cost, &model)?);
        }
        let costs = questions;
        Ok(InputModel { model: model.model.with_rewards(structures)?, costs, ..model })
    }

    /// The upper and the lower bound on the least expected cost, in PRISM's syntax.
    fn questions(&self, cost: &Cost, micro_steps: u64) -> Result<[String; 2], CostError> {
        let name = cost.name();
        let steps = self.steps.map(|steps| steps.saturating_mul(micro_steps));
        let path = match (cost.discount(), steps) {
            (Some(_), _) if micro_steps > 1 => {
                return Err(CostError::MicroSteps { name: name.to_owned(), micro_steps });
            }
            (Some(discount), Some(steps)) => format!("C<={steps}, discount={discount}"),
            (Some(discount), None) => format!("C, discount={discount}"),
            (None, Some(steps)) => format!("C<={steps}"),
            (None, None) if self.task.aim() == Aim::Reach => "F \"reached\"".to_owned(),
            (None, None) => return Err(CostError::Endless { name: name.to_owned() }),
        };
        Ok([
            format!("\"{name}\": R{{\"{name}\"}}minmax=? [ {path} ]"),
            format!("\"{name}_least\": R{{\"{name}_least\"}}minmin=? [ {path} ]"),
        ])
    }
}

/// The greatest and the least cost of every choice.
fn priced(
    problem: &InputProblem,
    cost: &Cost,
    exported: &InputModel,
) -> Result<[RewardStructure; 2], CostError> {
    let InputModel { model, acting, micro_steps, .. } = exported;
    let grid = problem.grid();
    let enclosing = Interval::enclosing;
    let sides: Vec<Vec<Interval>> = grid
        .axes()
        .iter()
        .map(|axis| (0..axis.cells()).map(|i| enclosing(&axis.face(i), &axis.face(i + 1))).collect())
        .collect();
    let margins = problem.feedback().margins();
    let around = |input: &Vec<_>| -> Vec<Interval> {
        input.iter().zip(margins).map(|(u, margin)| enclosing(&(u - margin), &(u + margin))).collect()
    };
    let inputs: Vec<Vec<Interval>> = problem.inputs().iter().map(around).collect();
    let ActionNames::OfChoice { ids, .. } = model.actions() else { return Ok(unpriced(cost)) };
    let (mut greatest, mut least) = (vec![0.0; ids.len()], vec![0.0; ids.len()]);
    let first_choices = model.choices().first_choices();
    let (mut scratch, mut largest) = (vec![], 0.0f64);
    for &(state, cell) in acting {
        let first = first_choices[state.index()] as usize;
        let mut variables: Vec<Interval> = sides
            .iter()
            .enumerate()
            .map(|(j, side)| side[grid.coordinate(CellId(cell), j) as usize])
            .collect();
        for choice in first..first + model.choices().num_choices_of(state) {
            let Some(input) = inputs.get(ids[choice] as usize) else { continue };
            variables.truncate(sides.len());
            variables.extend(input);
            let (low, high) = cost.range(&variables, &mut scratch);
            if !high.is_finite() {
                let (name, input) = (cost.name().to_owned(), ids[choice]);
                return Err(CostError::Unbounded { name, cell, input });
            }
            // Doubles are read as decimals, which may lie on either side of them.
            (least[choice], greatest[choice]) =
                (low.next_down().max(0.0), if high > 0.0 { high.next_up() } else { 0.0 });
            largest = largest.max(greatest[choice]);
        }
    }
    let outside = cost.outside().map_or(largest, |outside| outside.next_up().max(largest));
    let mut states = vec![0.0; model.num_states()];
    for failed in [FAILED, LOST].map(StateId::index) {
        states[failed] = (outside / *micro_steps as f64).next_up();
    }
    let [mut dear, mut cheap] = unpriced(cost);
    (dear.states, dear.choices, cheap.choices) = (states, greatest, least);
    Ok([dear, cheap])
}

fn unpriced(cost: &Cost) -> [RewardStructure; 2] {
    [RewardStructure::new(cost.name()), RewardStructure::new(format!("{}_least", cost.name()))]
}
