//! Why the bounds of a problem whose actions are inputs are what they are.

use super::losses::{simulate, spread_of};
use super::trials::{trials, without_noise};
use super::{Explanation, MOST_STEPS, Reason};
use crate::abstraction::inputs::InputAbstraction;
use crate::controller::{Controller, Noise, ParameterChoice, Simulation};
use crate::landing::LandingSolution;
use crate::model_file::Document;
use crate::partition::CellKind;
use crate::problem::InputProblem;
use imdp::progress::Progress;

/// How often the noise is drawn to see how far it reaches.
const DRAWS: usize = 2000;

/// Why the bounds on a solved problem are what they are; `document` is the model file that states it, for what changes of it would bring.
pub fn explain_inputs(
    document: &Document,
    problem: &InputProblem,
    abstraction: &InputAbstraction,
    solution: &LandingSolution,
    controller: &Controller,
    progress: &dyn Progress,
) -> Explanation {
    let mut reasons = Vec::new();
    let task = problem.cell_task();
    let ordinary =
        (0..problem.grid().num_cells()).filter(|&cell| !task.open(cell as usize).is_empty()).count();
    let idle = abstraction.blocked;
    let initial = abstraction.initial(problem.initial_cell());
    let upper = initial.iter().map(|&cell| solution.values.upper[cell as usize]).fold(0.0, f64::max);
    let bound = controller.promised().bound;
    match problem.initial_cell() {
        None => {
            let all = abstraction.decided();
            let best = all.iter().map(|&cell| solution.values.lower[cell as usize]).fold(0.0, f64::max);
            reasons.push(Reason::NoStart { idle, ordinary, best });
        }
        Some(cell) if task.kind(cell) == CellKind::Unsafe => reasons.push(Reason::UnsafeStart),
        Some(cell) if abstraction.is_blocked(cell) => reasons.push(Reason::NoInputAtStart { idle, ordinary }),
        Some(_) => {}
    }
    let samples = problem.noise().samples().map(|samples| samples.noise.samples.len());
    reasons.push(Reason::Between { lower: bound, upper, samples });
    reasons.extend(without_noise(document, problem, progress));
    let trials = trials(document, problem, abstraction, progress);
    if !trials.is_empty() {
        reasons.push(Reason::Trials { trials });
    }
    let names: Vec<String> = problem.mode().states().iter().map(|state| state.name.clone()).collect();
    if let Some(start) = problem.initial_state() {
        let simulation = Simulation::of_inputs(problem, controller, ParameterChoice::Random, MOST_STEPS);
        reasons.push(simulate(&simulation, problem.grid(), &names, start, progress));
    }
    let deviations = deviations(&Noise::of_inputs(problem.noise()));
    reasons.push(Reason::Noise { spreads: spread_of(&deviations, problem.grid()) });
    Explanation { bound, reasons }
}

/// About the standard deviation of every coordinate.
fn deviations(noise: &Noise) -> Vec<f64> {
    let draws = noise.sample(DRAWS, 0);
    let deviation = |j: usize| {
        let mean = draws.iter().map(|draw| draw[j]).sum::<f64>() / DRAWS as f64;
        (draws.iter().map(|draw| (draw[j] - mean).powi(2)).sum::<f64>() / DRAWS as f64).sqrt()
    };
    (0..noise.dimension()).map(deviation).collect()
}
