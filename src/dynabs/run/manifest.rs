//! What a run was, in one JSON file: the same for the same input.

use super::pruning::PruningReport;
use super::row_states::RowStatesReport;
use crate::Warning;
use crate::abstraction::{Abstraction, Plan};
use crate::guarantee::Guarantee;
use crate::model_file::Document;
use crate::problem::{Problem, SampledNoise, Stabilizer, TargetId};
use crate::system::Variable;
use imdp::formats::prism::RAISED_LOWER_BOUND;
use imdp::formats::sha256_hex;
use imdp::model::StateId;

use imdp::property::Probability;
use serde::{Deserialize, Serialize};

/// The format of the manifest itself.
const FORMAT: &str = "dynabs run";
/// Its version.
const FORMAT_VERSION: u32 = 2;

/// What went into a run and what came out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// `dynabs run`.
    pub format: String,
    /// The version of this format.
    pub format_version: u32,
    /// The version of the tool.
    pub version: String,
    /// The name of the model.
    pub name: String,
    /// The number of states.
    pub states: u64,
    /// The number of choices.
    pub choices: u64,
    /// The number of transitions when every choice is written out.
    pub transitions: u64,
    /// The number of distinct rows that these transitions come from.
    pub rows: u64,
    /// The number of entries of these rows.
    pub row_entries: u64,
    /// `pac`, `known` or `reference`.
    pub mode: String,
    /// What the intervals promise, and what that rests on.
    pub guarantee: Guarantee,
    /// The task's horizon.
    pub horizon: Option<GroupedHorizon>,
    /// The number of original steps that one model step stands for.
    pub group_steps: u64,
    /// How many steps of the model are one step of the system, where actions are inputs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub micro_steps: Option<u64>,
    /// The coordinates of state and input with their units, where actions are inputs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coordinates: Option<Coordinates>,
    /// How a differential equation became one step, if one did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub discretisation: Option<String>,
    /// How choices lead to cells in the model's files, where actions are inputs and it is not by the states of the lattice.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub encoding: Option<String>,
    /// The task as a property.
    pub property: String,
    /// What is asked about costs, in PRISM's syntax.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub costs: Vec<String>,
    /// The threshold asked for.
    pub threshold: Option<f64>,
    /// The initial state asked for.
    pub initial_state: Option<Vec<f64>>,
    /// Its state in the model.
    pub initial_model_state: Option<StateId>,
    /// The lower layer, if it is linear feedback.
    pub stabilizer: Option<LayerReport>,
    /// The plan that is followed, if there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plan: Option<PlanReport>,
    /// The model of the files `rows.*`, if they are written.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub row_states: Option<RowStatesReport>,
    /// What pruning left of the model; all sizes above are those of what is left.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pruning: Option<PruningReport>,
    /// What a lower bound of 0 is written as in `model.tra`.
    pub prism_lower_bound: f64,
    /// What that can change.
    pub prism_lower_bound_note: String,
    /// The number of noise samples of the grouped system.
    pub samples: u64,
    /// The seed they were drawn with, if they were drawn.
    pub seed: Option<u64>,
    /// What the user should know.
    pub warnings: Vec<String>,
    /// What `--set` changed.
    pub set: Vec<String>,
    /// The files read.
    pub inputs: Vec<InputFile>,
    /// The files written, but for this one.
    pub outputs: Vec<OutputFile>,
}

/// What numbers of state and input are about.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Coordinates {
    /// The coordinates of the state.
    pub states: Vec<Variable>,
    /// The coordinates of the input.
    pub inputs: Vec<Variable>,
}

/// A horizon in original and in model steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct GroupedHorizon {
    /// In steps of the model: groups.
    pub model_steps: u64,
    /// In steps of the original system.
    pub original_steps: u64,
}

/// A lower layer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LayerReport {
    /// `K`, row by row.
    pub gain: Vec<Vec<f64>>,
    /// The eigenvalues of `A − BK` as `[re, im]`.
    pub closed_loop_eigenvalues: Vec<[f64; 2]>,
    /// The relative residual of the Riccati equation, for LQR gains.
    pub riccati_residual: Option<f64>,
}

/// A plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PlanReport {
    /// From how many cells it says where to go.
    pub cells: u64,
    /// How many different targets it has.
    pub targets: u64,
}

/// A file that was read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct InputFile {
    /// Its name, without the directory it was in.
    pub name: String,
    /// Its SHA-256.
    pub sha256: String,
}

/// A file that was written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OutputFile {
    /// Its name in the directory.
    pub name: String,
    /// Its size.
    pub bytes: u64,
    /// Its SHA-256.
    pub sha256: String,
}

impl Manifest {
    /// Describes the compilation of `problem`; files are added by whoever writes them.
    pub fn new(document: &Document, source: &str, problem: &Problem, abstraction: &Abstraction) -> Self {
        let size = abstraction.model.size();
        let d = problem.group_steps() as u64;
        Self {
            format: FORMAT.into(),
            format_version: FORMAT_VERSION,
            version: env!("CARGO_PKG_VERSION").into(),
            name: problem.name().to_owned(),
            states: size.states,
            choices: size.choices,
            transitions: size.transitions,
            rows: size.rows,
            row_entries: size.entries,
            mode: abstraction.guarantee.mode().into(),
            guarantee: abstraction.guarantee.clone(),
            horizon: problem
                .horizon()
                .map(|steps| GroupedHorizon { model_steps: steps, original_steps: steps * d }),
            group_steps: d,
            micro_steps: None,
            coordinates: None,
            discretisation: None,
            encoding: None,
            property: abstraction.property.to_string(),
            costs: abstraction.costs.clone(),
            threshold: problem.threshold().map(Probability::to_f64),
            initial_state: problem.initial_state().map(<[f64]>::to_vec),
            initial_model_state: problem.initial_cell().map(|cell| abstraction.state_of_cell[cell.index()]),
            stabilizer: LayerReport::new(problem),
            plan: abstraction.plan.as_ref().map(PlanReport::new),
            row_states: None,
            pruning: None,
            prism_lower_bound: RAISED_LOWER_BOUND,
            prism_lower_bound_note: lower_bound_note(problem),
            samples: problem.noise().samples().map_or(0, |noise| noise.samples.len() as u64),
            seed: problem.noise().samples().and_then(SampledNoise::seed),
            warnings: problem
                .warnings()
                .iter()
                .chain(&abstraction.warnings)
                .map(Warning::to_string)
                .collect(),
            set: vec![],
            inputs: inputs(document, source, problem),
            outputs: vec![],
        }
    }

    /// A manifest that says nothing yet.
    pub(super) fn empty() -> Self {
        Self {
            format: FORMAT.into(),
            format_version: FORMAT_VERSION,
            version: env!("CARGO_PKG_VERSION").into(),
            name: String::new(),
            states: 0,
            choices: 0,
            transitions: 0,
            rows: 0,
            row_entries: 0,
            mode: String::new(),
            guarantee: Guarantee::none(),
            horizon: None,
            group_steps: 1,
            micro_steps: None,
            coordinates: None,
            discretisation: None,
            encoding: None,
            property: String::new(),
            costs: vec![],
            threshold: None,
            initial_state: None,
            initial_model_state: None,
            stabilizer: None,
            plan: None,
            row_states: None,
            pruning: None,
            prism_lower_bound: RAISED_LOWER_BOUND,
            prism_lower_bound_note:
                "model.tra raises lower bounds of 0 to this; the native value is that of the bounds of 0"
                    .into(),
            samples: 0,
            seed: None,
            warnings: vec![],
            set: vec![],
            inputs: vec![],
            outputs: vec![],
        }
    }

    /// Whether a manifest with this `format` is one of ours.
    pub(super) fn is_format(format: &str) -> bool {
        format == FORMAT
    }
}

impl LayerReport {
    fn new(problem: &Problem) -> Option<Self> {
        let stabilizer = problem.stabilizer().and_then(Stabilizer::feedback)?;
        let gain = stabilizer.layers.gain().to_f64();
        Some(Self {
            gain: gain.row_iter().map(|row| row.iter().copied().collect()).collect(),
            closed_loop_eigenvalues: stabilizer
                .layers
                .eigenvalues()
                .iter()
                .map(|&(re, im)| [re, im])
                .collect(),
            riccati_residual: stabilizer.riccati_residual,
        })
    }
}

impl PlanReport {
    fn new(plan: &Plan) -> Self {
        let mut targets: Vec<TargetId> = plan.headings().flatten().collect();
        let cells = targets.len() as u64;
        targets.sort_unstable();
        targets.dedup();
        Self { cells, targets: targets.len() as u64 }
    }
}

fn lower_bound_note(problem: &Problem) -> String {
    if problem.horizon().is_some() {
        "model.tra raises lower bounds of 0 to this: the value moves by at most horizon × row length × this"
            .into()
    } else {
        "model.tra raises lower bounds of 0 to this: for an unbounded horizon that can change the exact value of \
         what model.tra says altogether; the native value is that of the bounds of 0"
            .into()
    }
}

fn inputs(document: &Document, source: &str, problem: &Problem) -> Vec<InputFile> {
    let base = |name: &str| name.rsplit(['/', '\\']).next().unwrap_or(name).to_owned();
    let file = |name: &str, text: &str| InputFile { name: base(name), sha256: sha256_hex(text.as_bytes()) };
    let model = file(&document.name, source);
    let noise = problem.noise().samples().and_then(SampledNoise::file).map(|(name, text)| file(name, text));
    std::iter::once(model).chain(noise).collect()
}
