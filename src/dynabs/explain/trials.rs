//! What changes of a model whose actions are inputs would bring, by trying them.

use super::{Reason, Trial};
use crate::abstraction::inputs::InputAbstraction;
use crate::model_file::{Document, StatedProblem};
use crate::problem::InputProblem;
use imdp::progress::Progress;
use imdp::solver::SolverOptions;
use serde_json::{Value, json};

/// What has more pairs of a cell and an input is not tried: that would take longer than the answer is worth.
const MOST_PAIRS: u64 = 1 << 18;

/// Nor does a trial take more steps.
const MOST_ITERATIONS: u64 = 2000;

/// Finer lattices are not tried.
const FINEST: u32 = 32;

/// By so much inputs are enlarged.
const WIDER: f64 = 1.5;

/// The bounds of the same system without any noise.
pub(super) fn without_noise(
    document: &Document,
    problem: &InputProblem,
    progress: &dyn Progress,
) -> Option<Reason> {
    let mut document = document.clone();
    let fields = document.value.as_object_mut()?;
    let components = vec![Value::Null; problem.grid().dimension()];
    fields.insert("noise".to_owned(), json!({"components": components}));
    fields.insert("actions".to_owned(), "inputs".into());
    fields.shift_remove("probabilities");
    let Solved { lower, upper, .. } = solve(&document, progress)?;
    Some(Reason::WithoutNoise { lower, upper })
}

/// Changes of one field each, and the bounds with them.
pub(super) fn trials(
    document: &Document,
    problem: &InputProblem,
    abstraction: &InputAbstraction,
    progress: &dyn Progress,
) -> Vec<Trial> {
    let finer: Vec<u32> = abstraction.resolution.iter().map(|r| (2 * r).min(FINEST)).collect();
    let cells: Vec<u64> = problem.grid().axes().iter().map(|axis| 2 * u64::from(axis.cells())).collect();
    let mut changes = vec![
        ("/partition/resolution", json!(finer), "a lattice twice as fine"),
        ("/partition/cells", json!(cells), "twice as many cells in every direction"),
    ];
    if document.value.pointer("/feedback").is_none_or(Value::is_null) {
        changes.push(("/feedback", json!({"narrow": 0.25}), "feedback that narrows images"));
    }
    let numbers = |pointer: &str| -> Option<Vec<f64>> {
        document.value.pointer(pointer)?.as_array()?.iter().map(Value::as_f64).collect()
    };
    if let Some(points) = numbers("/input/points") {
        // Those of before are among them.
        let more: Vec<u64> = points.iter().map(|points| (2.0 * points - 1.0).max(1.0) as u64).collect();
        changes.push(("/input/points", json!(more), "twice as many values of each input"));
    }
    if let (Some(lower), Some(upper), Some(input)) =
        (numbers("/input/lower"), numbers("/input/upper"), document.value.pointer("/input"))
    {
        let mut input = input.clone();
        let ends = lower.iter().zip(&upper).map(|(a, b)| ((a + b) / 2.0, WIDER * (b - a) / 2.0));
        input["lower"] = ends.clone().map(|(center, half)| center - half).collect();
        input["upper"] = ends.map(|(center, half)| center + half).collect();
        changes.push(("/input", input, "inputs half as wide again"));
    }
    let tried = changes.into_iter().filter_map(|(pointer, value, what)| {
        let mut changed = document.clone();
        changed.set(&format!("{pointer}={value}").parse().ok()?).ok()?;
        let Solved { lower, upper, pairs } = solve(&changed, progress)?;
        Some(Trial { what: what.to_owned(), change: format!("{pointer}={value}"), lower, upper, pairs })
    });
    tried.collect()
}

/// Bounds from the initial states, and the number of pairs of a cell and an input.
struct Solved {
    lower: f64,
    upper: f64,
    pairs: u64,
}

/// The bounds of a model, unless it is none or too large to be tried.
fn solve(document: &Document, progress: &dyn Progress) -> Option<Solved> {
    let Ok(StatedProblem::Inputs(problem)) = document.stated() else { return None };
    let most = u64::from(problem.grid().num_cells()).saturating_mul(problem.inputs().len() as u64);
    if most > MOST_PAIRS || progress.is_interrupted() {
        return None;
    }
    let abstraction = InputAbstraction::new(&problem).ok()?;
    let options = SolverOptions {
        epsilon: 1e-4,
        max_iterations: MOST_ITERATIONS,
        progress,
        ..SolverOptions::default()
    };
    let values = abstraction.question().solve(&options).values;
    progress.finish();
    let initial = abstraction.initial(problem.initial_cell());
    let at = |values: &[f64], cell: &u32| values[*cell as usize];
    Some(Solved {
        lower: initial.iter().map(|cell| at(&values.lower, cell)).fold(1.0, f64::min),
        upper: initial.iter().map(|cell| at(&values.upper, cell)).fold(0.0, f64::max),
        pairs: abstraction.num_choices() as u64,
    })
}
