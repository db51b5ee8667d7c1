//! Costs as rewards of the model that files have.
//!
//! A choice costs at most (at least) what its greatest (least) value over the cell and the feedback is. Noise that is not listed has
//! failed.

use super::super::costs::{CostError, Priced, questions, unpriced};
use super::InputAbstraction;
use super::export::InputModel;
use crate::landing::{FAILED, LOST};
use crate::partition::CellId;
use crate::problem::{Cost, InputProblem};
use crate::system::Interval;
use imdp::model::{ActionNames, RewardStructure, require_memory};

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
        let mut asked = vec![];
        for cost in problem.costs() {
            if cost.discount().is_some() && model.micro_steps > 1 {
                let (name, micro_steps) = (cost.name().to_owned(), model.micro_steps);
                return Err(CostError::MicroSteps { name, micro_steps });
            }
            let steps = self.steps.map(|steps| steps.saturating_mul(model.micro_steps));
            asked.extend(questions(cost, self.task.aim(), steps)?);
        }
        let choices = model.model.size().choices;
        require_memory("the costs", 16 * choices * problem.costs().len() as u64)?;
        let mut structures = vec![];
        for cost in problem.costs() {
            structures.extend(priced(problem, cost, &model)?);
        }
        Ok(InputModel { model: model.model.with_rewards(structures)?, costs: asked, ..model })
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
    let mut costs = Priced::nothing(ids.len());
    let first_choices = model.choices().first_choices();
    let mut scratch = vec![];
    for &(state, cell) in acting {
        let first = first_choices[state.index()] as usize;
        let mut variables: Vec<Interval> = sides
            .iter()
            .enumerate()
            .map(|(j, side)| side[grid.coordinate(CellId(cell), j) as usize])
            .collect();
        let own = ids.iter().enumerate().skip(first).take(model.choices().num_choices_of(state));
        for (choice, &id) in own {
            let Some(input) = inputs.get(id as usize) else { continue };
            variables.truncate(sides.len());
            variables.extend(input);
            let range = cost.range(&variables, &mut scratch);
            costs.set(choice, range).ok_or_else(|| {
                let (name, action) = (cost.name().to_owned(), format!("input {id}"));
                CostError::Unbounded { name, cell, action }
            })?;
        }
    }
    let failed = [FAILED, LOST].into_iter();
    Ok(costs
        .structures(cost, model.num_states(), failed, |outside| (outside / *micro_steps as f64).next_up()))
}
