//! The fields of lower layers.

use super::set_fields::SetSpec;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::SeqAccessDeserializer;
use serde::de::{self, Deserialize, Deserializer, SeqAccess, Visitor};
use std::fmt;

/// A lower layer on the grouped system (d·p inputs), with exactly one of `lqr`, `gain` and `track`: `u = −K (x − x̄) + u′`,
/// or `u = u_plan(x) + u′`, which steers where a plan says and as far off as `U′` allows.
#[derive(Clone, Debug, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct StabilizerSpec {
    /// Weights from which the gain is computed.
    #[serde(default)]
    pub(super) lqr: Option<LqrSpec>,
    /// The gain `K` itself, (d·p)×n.
    #[serde(default)]
    pub(super) gain: Option<Vec<Vec<f64>>>,
    /// `x̄`, the state to stabilise about; 0 if absent.
    #[serde(default)]
    pub(super) about: Option<Vec<f64>>,
    /// The plan: "auto", or where to steer to from the cells of some states while the others follow the automatic plan.
    #[serde(default)]
    pub(super) track: Option<TrackSpec>,
    /// `U′`, what is left to the abstraction: a box or polytope of d·p inputs that contains 0. To track it can be absent:
    /// three tenths of the width of `U`, about 0.
    #[serde(default)]
    pub(super) abstract_input: Option<SetSpec>,
}

/// The weights of a linear-quadratic regulator for the grouped system.
#[derive(Clone, Debug, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct LqrSpec {
    /// `Q`, n×n, symmetric positive definite.
    #[serde(rename = "Q")]
    pub(super) q: Vec<Vec<f64>>,
    /// `R`, (d·p)×(d·p), symmetric positive definite.
    #[serde(rename = "R")]
    pub(super) r: Vec<Vec<f64>>,
    /// Rounds the gain to this many decimals; not at all if absent.
    #[serde(default)]
    #[schemars(range(max = 300))]
    pub(super) decimals: Option<u32>,
}

/// A plan.
#[derive(Clone, Debug)]
pub(super) enum TrackSpec {
    /// Made by the abstraction.
    Auto,
    /// The same, but from some cells.
    From(Vec<HeadingSpec>),
}

/// Where to steer to from a cell.
#[derive(Clone, Debug, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Heading")]
pub(super) struct HeadingSpec {
    /// A state in the cell.
    pub(super) from: Vec<f64>,
    /// A point in the partition: the target nearest to it (in widths of cells) is meant.
    pub(super) to: Vec<f64>,
}

impl<'de> Deserialize<'de> for TrackSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(TrackVisitor)
    }
}

struct TrackVisitor;

impl<'de> Visitor<'de> for TrackVisitor {
    type Value = TrackSpec;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("\"auto\" or a list of {\"from\", \"to\"}")
    }

    fn visit_str<E: de::Error>(self, value: &str) -> Result<TrackSpec, E> {
        match value {
            "auto" => Ok(TrackSpec::Auto),
            other => Err(E::invalid_value(de::Unexpected::Str(other), &self)),
        }
    }

    fn visit_seq<A: SeqAccess<'de>>(self, items: A) -> Result<TrackSpec, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(items)).map(TrackSpec::From)
    }
}

impl JsonSchema for TrackSpec {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Track".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let headings = generator.subschema_for::<Vec<HeadingSpec>>();
        json_schema!({"anyOf": [{"const": "auto"}, headings]})
    }
}
