//! The fields of a model file.

use super::dynamics::DynamicsSpec;
use super::named::Named;
use super::set_fields::{GridSpec, SetSpec};
use super::stabilizer_fields::{LqrSpec, StabilizerSpec};
use super::task_fields::{ShapesSpec, TaskSpec};
use crate::problem::DistributionParts;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{self, Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;

/// A control problem: linear dynamics, noise, input limits, a partition and a reach-avoid task.
///
/// `x⁺ = A x + B u + q + η` with `n` states and `p` inputs. Numbers mean the decimals as written.
#[derive(Clone, Debug, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ModelFile {
    /// Where the JSON Schema of this file is; ignored.
    #[serde(rename = "$schema", default)]
    #[expect(dead_code, reason = "for editors")]
    pub(super) schema: Option<String>,
    /// A short name.
    pub(super) name: String,
    /// What the model is about, where its numbers come from.
    #[serde(default)]
    #[expect(dead_code, reason = "for readers")]
    pub(super) description: Option<String>,
    /// The dynamics of one step.
    pub(super) dynamics: DynamicsSpec,
    /// Samples of the noise, or a distribution to draw them from.
    pub(super) noise: NoiseSpec,
    /// What the controller chooses from in every cell: "targets" to steer to (the default for matrices and sampled
    /// noise), or "inputs" (the default for everything else).
    #[serde(default)]
    pub(super) actions: Option<ActionsSpec>,
    /// The inputs allowed in one step: a box or a polytope; for actions "inputs" also which of them to choose from.
    #[serde(default)]
    pub(super) input: Option<SetSpec>,
    /// A lower layer: linear feedback that stabilises the system, or a plan to follow.
    #[serde(default)]
    pub(super) stabilizer: Option<StabilizerSpec>,
    /// For actions "inputs": in the cell with center c the input is u = ū − K (x − c).
    #[serde(default)]
    pub(super) feedback: Option<FeedbackSpec>,
    /// The grid of cells; everything outside counts as failed.
    pub(super) partition: GridSpec,
    /// The points that actions steer to: "centers" (of all cells, the default), a grid whose cell centers
    /// are the targets, or a list of points.
    #[serde(default)]
    pub(super) targets: TargetsSpec,
    /// Regions with names, for tasks to speak of: each a box, a polytope, or a list of those for their union.
    #[serde(default)]
    pub(super) regions: Named<ShapesSpec>,
    /// What the controller is to achieve.
    pub(super) task: TaskSpec,
    /// The state from which the guarantee is wanted; without it every ordinary cell is initial.
    #[serde(default)]
    pub(super) initial_state: Option<Vec<f64>>,
    /// How probability intervals are computed from the samples.
    #[serde(default)]
    pub(super) probabilities: ProbabilitiesSpec,
    /// What steps cost, by name; the model in files has them as rewards.
    #[serde(default)]
    pub(super) costs: Named<CostSpec>,
}

/// What a step costs.
#[derive(Clone, Debug, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Cost")]
pub(super) struct CostSpec {
    /// The cost of a step, an expression in states and inputs, such as "u1^2 + 0.1*abs(x1)"; 0 where it is negative.
    pub(super) step: String,
    /// What a step costs at most once the task has failed; as much as any other step if absent.
    #[serde(default)]
    pub(super) outside: Option<f64>,
    /// What the next step's cost is worth today; 1 if absent.
    #[serde(default)]
    pub(super) discount: Option<f64>,
}

/// What the controller chooses from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum ActionsSpec {
    /// Points to steer to.
    Targets,
    /// Inputs.
    Inputs,
}

/// The noise: `samples`, or `gaussian` with `count` and `seed` for samples that are drawn, or known: `gaussian` alone or
/// `components`.
#[derive(Clone, Debug, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct NoiseSpec {
    /// Samples, in a file or here.
    #[serde(default)]
    pub(super) samples: Option<SamplesSpec>,
    /// A normal distribution of the noise of one step; known, or drawn from if there is a count.
    #[serde(default)]
    pub(super) gaussian: Option<GaussianSpec>,
    /// Known distributions of the components of the noise of one step, which are independent; null for none.
    #[serde(default)]
    pub(super) components: Option<Vec<Option<DistributionParts>>>,
    /// How many samples of the grouped noise to draw (each from d draws of one step).
    #[serde(default)]
    pub(super) count: Option<u64>,
    /// The seed of the draws; 0 if absent.
    #[serde(default)]
    pub(super) seed: Option<u64>,
    /// For actions "inputs" and samples: their components are assumed to be independent of each other, and samples bound
    /// the probabilities of "intervals" or, by "bands", their distribution functions. Absent, nothing is assumed.
    #[serde(default)]
    pub(super) independent: Option<IndependentSpec>,
}

/// What samples bound of components that are independent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "Independent")]
pub(super) enum IndependentSpec {
    /// The probability of every interval of the lattice.
    Intervals,
    /// The distribution function, everywhere at once.
    Bands,
}

/// Noise samples: a file, or values.
#[derive(Clone, Debug, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SamplesSpec {
    /// A CSV file, one sample of n numbers per line, separated by commas or semicolons; the first line may have names instead.
    /// Relative to the model file.
    #[serde(default)]
    pub(super) file: Option<String>,
    /// The samples themselves, n numbers each.
    #[serde(default)]
    pub(super) values: Option<Vec<Vec<f64>>>,
    /// "grouped" if a sample is the noise of d steps together, "step" if it is that of one step.
    pub(super) of: SampleKindSpec,
    /// What separates whole numbers from decimals: "." (the default) or ",", with semicolons between numbers.
    #[serde(default)]
    pub(super) decimal: DecimalSpec,
}

/// What separates whole numbers from decimals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize, JsonSchema)]
#[schemars(rename = "DecimalMark")]
pub(super) enum DecimalSpec {
    /// A point.
    #[default]
    #[serde(rename = ".")]
    Point,
    /// A comma.
    #[serde(rename = ",")]
    Comma,
}

/// What a sample is the noise of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "SampleKind")]
pub(super) enum SampleKindSpec {
    /// Of d steps together.
    Grouped,
    /// Of one step; d samples are combined into one.
    Step,
}

/// A normal distribution.
#[derive(Clone, Debug, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct GaussianSpec {
    /// The mean, n numbers; 0 if absent.
    #[serde(default)]
    pub(super) mean: Option<Vec<f64>>,
    /// The covariance, n×n, symmetric and positive semidefinite.
    pub(super) covariance: Vec<Vec<f64>>,
}

/// Local feedback: exactly one of `gain`, `lqr` and `narrow`.
#[derive(Clone, Debug, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct FeedbackSpec {
    /// The gain `K` itself, p×n.
    #[serde(default)]
    pub(super) gain: Option<Vec<Vec<f64>>>,
    /// Weights from which the gain is computed, for the dynamics linearised at the center of the partition.
    #[serde(default)]
    pub(super) lqr: Option<LqrSpec>,
    /// A gain is chosen that makes images small and uses at most this share of the width of `U`.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub(super) narrow: Option<f64>,
}

/// The points that actions steer to.
#[derive(Clone, Debug, Default)]
pub(super) enum TargetsSpec {
    /// The centers of all cells.
    #[default]
    Centers,
    /// The centers of the cells of this grid.
    Grid(GridSpec),
    /// These points.
    Points(Vec<Vec<f64>>),
}

/// How probability intervals are computed: `{"mode": "pac", "confidence": 0.99}` (or `"beta"`), or
/// `{"mode": "reference", "beta_per_interval": 0.01}`.
#[derive(Clone, Debug, Default, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ProbabilitiesSpec {
    /// "pac" (the default) is a guarantee; "reference" repeats the published tool's numbers.
    #[serde(default)]
    pub(super) mode: Mode,
    /// pac: the probability with which all intervals hold together; 0.99 if neither this nor beta is given.
    #[serde(default)]
    pub(super) confidence: Option<f64>,
    /// pac: 1 − confidence, where that is easier to write.
    #[serde(default)]
    pub(super) beta: Option<f64>,
    /// pac: how many settings are compiled with these samples, 1 if not given. Whoever compiles several and then takes the one
    /// with the best result writes their number into all of them: each gets this part of beta.
    #[serde(default)]
    #[schemars(range(min = 1))]
    pub(super) sweep: Option<u64>,
    /// pac: rows do not list the cells of this many farthest samples, 0 if not given: with heavy-tailed noise
    /// they stay short. Choose it before looking at the samples.
    #[serde(default)]
    pub(super) discard: Option<u64>,
    /// reference: the failure probability of one interval.
    #[serde(default)]
    pub(super) beta_per_interval: Option<f64>,
}

/// Which kind of probability intervals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum Mode {
    /// Every claim holds, jointly, with the stated confidence.
    #[default]
    Pac,
    /// The published tool's numbers; not a guarantee.
    Reference,
}

impl<'de> Deserialize<'de> for TargetsSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(TargetsVisitor)
    }
}

struct TargetsVisitor;

impl<'de> Visitor<'de> for TargetsVisitor {
    type Value = TargetsSpec;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("\"centers\", a grid {\"lower\", \"upper\", \"cells\"}, or a list of points")
    }

    fn visit_str<E: de::Error>(self, value: &str) -> Result<TargetsSpec, E> {
        match value {
            "centers" => Ok(TargetsSpec::Centers),
            other => Err(E::invalid_value(de::Unexpected::Str(other), &self)),
        }
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<TargetsSpec, A::Error> {
        GridSpec::deserialize(MapAccessDeserializer::new(map)).map(TargetsSpec::Grid)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, items: A) -> Result<TargetsSpec, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(items)).map(TargetsSpec::Points)
    }
}

impl JsonSchema for TargetsSpec {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Targets".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let grid = generator.subschema_for::<GridSpec>();
        let points = generator.subschema_for::<Vec<Vec<f64>>>();
        json_schema!({"anyOf": [{"const": "centers"}, grid, points]})
    }
}
