//! Costs of steering to targets.
//!
//! In a cell the law `u = c + M d + N x` gives inputs from a box, which interval arithmetic in the order of the law's own
//! operations encloses, with their roundings. Where steps are grouped, the state after the first of them lies anywhere: only
//! costs of the input are bounded there.
//!
//! Runs end in goal cells, and in cells in which nothing is enabled: what they cost is counted until then. Where the face of a
//! named region cuts a cell, the model takes the worse for true and a run may end earlier: there is no lower bound then.

use super::compile::Abstraction;
use super::costs::{CostError, Priced, questions};
use crate::partition::CellId;
use crate::problem::{Cost, Knowledge, Problem, TargetId};
use crate::system::{FeedbackLaw, Interval};
use imdp::model::{RewardStructure, StateId, require_memory};
use nalgebra::DMatrix;

impl Abstraction {
    /// The same with the costs of the problem as rewards of the model, and what is asked about them: the least expected cost, an
    /// upper and a lower bound on it each.
    ///
    /// # Errors
    /// [`CostError`] names the cost and what is wrong with it.
    pub fn with_costs(mut self, problem: &Problem) -> Result<Self, CostError> {
        if problem.costs().is_empty() {
            return Ok(self);
        }
        if matches!(problem.knowledge(), Knowledge::Published { .. }) {
            return Err(CostError::Reference);
        }
        let steps = problem.group_steps() as u64;
        let is_cut = problem.cell_task().letters().is_some() && problem.cell_task().is_ambiguous();
        let bounds = if is_cut { 1 } else { 2 };
        let mut asked = vec![];
        for cost in problem.costs() {
            if cost.discount().is_some() && steps > 1 {
                return Err(CostError::GroupedSteps { name: cost.name().to_owned(), steps });
            }
            let both = questions(cost, problem.worst_task().aim(), problem.horizon())?;
            asked.extend(both.into_iter().take(bounds));
        }
        let choices = self.model.size().choices;
        require_memory("the costs", 16 * choices * problem.costs().len() as u64)?;
        let inputs = InputBoxes::new(&self);
        let mut structures = vec![];
        for cost in problem.costs() {
            structures.extend(self.priced(problem, cost, &inputs)?.into_iter().take(bounds));
        }
        self.model = self.model.with_rewards(structures)?;
        self.costs = asked;
        Ok(self)
    }

    /// The greatest and the least cost of every choice.
    fn priced(
        &self,
        problem: &Problem,
        cost: &Cost,
        inputs: &InputBoxes,
    ) -> Result<[RewardStructure; 2], CostError> {
        let (grid, choices) = (problem.grid(), self.model.choices());
        let steps = problem.group_steps();
        let first_choices = choices.first_choices();
        let mut priced = Priced::nothing(self.model.size().choices as usize);
        let mut costs =
            StepCosts { cost, steps, dimension: grid.dimension(), variables: vec![], scratch: vec![] };
        let sides: Vec<Vec<Interval>> = (grid.axes().iter())
            .map(|axis| {
                (0..axis.cells()).map(|i| Interval::enclosing(&axis.face(i), &axis.face(i + 1))).collect()
            })
            .collect();
        for state in StateId::first(self.model.num_states()) {
            let Some((_, cell)) = self.pair(state).filter(|_| !choices.is_absorbing(state)) else { continue };
            let along = |(j, sides): (usize, &Vec<Interval>)| sides[grid.coordinate(cell, j) as usize];
            let x: Vec<Interval> = sides.iter().enumerate().map(along).collect();
            let by_state = inputs.by_state(&x);
            for (choice, row) in (first_choices[state.index()] as usize..).zip(choices.rows(state)) {
                let target = self.target(row);
                let range = costs.of_group(cell, target, &x, &inputs.of(target, &by_state))?;
                priced.set(choice, range).ok_or_else(|| costs.unbounded(cell, target))?;
            }
        }
        let failed = self.model.labels().get("failed").into_iter().flat_map(|failed| failed.ones());
        let failed = failed.map(StateId::from_index);
        Ok(priced
            .structures(cost, self.model.num_states(), failed, |outside| (outside * steps as f64).next_up()))
    }
}

/// The costs of a group of steps.
struct StepCosts<'a> {
    cost: &'a Cost,
    steps: usize,
    dimension: usize,
    variables: Vec<Interval>,
    scratch: Vec<Interval>,
}

impl StepCosts<'_> {
    /// Of all steps together, from states `x` with inputs `u`, those of the first step first.
    fn of_group(
        &mut self,
        cell: CellId,
        target: TargetId,
        x: &[Interval],
        u: &[Interval],
    ) -> Result<(f64, f64), CostError> {
        let (mut least, mut greatest) = (0.0f64, 0.0f64);
        for (step, u) in u.chunks_exact((u.len() / self.steps).max(1)).enumerate() {
            self.variables.clear();
            match step {
                0 => self.variables.extend(x),
                _ => self.variables.extend(std::iter::repeat_n(Interval::EVERYTHING, self.dimension)),
            }
            self.variables.extend(u);
            let (low, high) = self.cost.range(&self.variables, &mut self.scratch);
            if !high.is_finite() {
                return Err(match step {
                    0 => self.unbounded(cell, target),
                    _ => CostError::InBetween { name: self.cost.name().to_owned(), steps: self.steps as u64 },
                });
            }
            let add = |sum: f64, more: f64| if more == 0.0 { sum } else { sum + more };
            (least, greatest) = match step {
                0 => (low, high),
                _ => (add(least, low).next_down().max(0.0), add(greatest, high).next_up()),
            };
        }
        Ok((least, greatest))
    }

    fn unbounded(&self, cell: CellId, target: TargetId) -> CostError {
        let (name, action) = (self.cost.name().to_owned(), format!("target {}", target.0));
        CostError::Unbounded { name, cell: cell.0, action }
    }
}

/// The inputs that the law gives, in its order of operations.
struct InputBoxes {
    /// `N`.
    state_gain: DMatrix<f64>,
    /// `c + M d`, target after target.
    of_targets: Vec<Interval>,
}

impl InputBoxes {
    fn new(abstraction: &Abstraction) -> Self {
        let law: &FeedbackLaw = &abstraction.law;
        let (gain, constant) = (law.target_gain(), law.constant());
        let mut point = vec![0.0; abstraction.targets.dimension()];
        let mut of_targets = Vec::with_capacity(abstraction.targets.len() * gain.nrows());
        for target in abstraction.targets.ids() {
            abstraction.targets.point(target, &mut point);
            of_targets.extend((0..gain.nrows()).map(|i| {
                let terms = point
                    .iter()
                    .enumerate()
                    .map(|(j, &x)| Interval::point(gain[(i, j)]) * Interval::point(x));
                terms.fold(Interval::point(constant[i]), |sum, term| sum + term)
            }));
        }
        Self { state_gain: law.state_gain(), of_targets }
    }

    /// The terms of `N x`, row by row.
    fn by_state(&self, x: &[Interval]) -> Vec<Interval> {
        let rows = 0..self.state_gain.nrows();
        rows.flat_map(|i| {
            x.iter().enumerate().map(move |(j, &x)| Interval::point(self.state_gain[(i, j)]) * x)
        })
        .collect()
    }

    /// The box of inputs that steer to a target.
    fn of(&self, target: TargetId, by_state: &[Interval]) -> Vec<Interval> {
        let (rows, n) = self.state_gain.shape();
        let starts = &self.of_targets[target.index() * rows..][..rows];
        let sum =
            |(&start, terms): (&Interval, &[Interval])| terms.iter().fold(start, |sum, &term| sum + term);
        starts.iter().zip(by_state.chunks_exact(n)).map(sum).collect()
    }
}
