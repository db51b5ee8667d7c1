//! The fields of a task and of the regions that it speaks of.

use super::integer_or::IntegerOr;
use crate::problem::Horizon;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;

/// A task: what a run is to do, as seen at every step; with grouped steps, at the end of every group.
#[derive(Clone, Debug, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct TaskSpec {
    /// "reach" (the default), "stay", "reach_at", "sequence", "formula" or "automaton".
    #[serde(rename = "type", default)]
    pub(super) kind: TaskKind,
    /// reach, reach_at (the last step): the goal, a union of boxes or names of regions; a cell counts if the union contains
    /// it.
    #[serde(default)]
    pub(super) goal: Option<Vec<PlaceSpec>>,
    /// stay: where to be at every step, a union of boxes or names of regions; a cell counts if the union contains it. The
    /// whole partition if absent.
    #[serde(default)]
    pub(super) safe: Option<Vec<PlaceSpec>>,
    /// sequence: the regions to come to, in this order, each with those to avoid on the way to it.
    #[serde(default)]
    pub(super) sequence: Option<Vec<LegSpec>>,
    /// formula: what the run must satisfy, such as "F (a & (!b U c))", with ! & | -> <-> X F G U W R and parentheses over
    /// names of regions. Safe or co-safe, unless `logic` is "ltlf".
    #[serde(default)]
    pub(super) formula: Option<String>,
    /// formula: "ltl" (the default), or "ltlf" for finite words: the whole run up to the horizon, or up to some time of the
    /// controller's choice if there is none.
    #[serde(default)]
    pub(super) logic: Option<LogicSpec>,
    /// automaton: a deterministic automaton in the HOA format whose propositions are names of regions.
    #[serde(default)]
    pub(super) automaton: Option<AutomatonSpec>,
    /// What must be avoided: a union of boxes or names of regions; a cell counts if it meets one. Boxes are half-open,
    /// [lower, upper), like cells. The entry "outside" stands for everything outside the partition: with grouped steps
    /// it is then avoided between them too.
    #[serde(rename = "unsafe", default)]
    pub(super) unsafe_: Vec<UnsafeSpec>,
    /// The number of original steps that the task is about, or "infinite".
    pub(super) horizon: Horizon,
    /// The probability that is wanted, if any.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub(super) threshold: Option<f64>,
    /// With grouped steps, when the unsafe region must be avoided: at "every_step" (the default, unless the samples are
    /// of "grouped" steps), or only at the "grouped" instants, which promises nothing for the steps in between.
    #[serde(default)]
    pub(super) check: Option<SafetyCheck>,
}

/// Something unsafe.
#[derive(Clone, Debug)]
pub(super) enum UnsafeSpec {
    /// Everything outside the partition.
    Outside,
    /// A box or the name of a region.
    Region(PlaceSpec),
}

/// When the unsafe region must be avoided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum SafetyCheck {
    /// At every original step.
    EveryStep,
    /// Whenever a group of steps ends.
    Grouped,
}

/// What is wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum TaskKind {
    /// To reach a goal.
    #[default]
    Reach,
    /// To stay in a region.
    Stay,
    /// To be in the goal at the horizon.
    ReachAt,
    /// To come to one region after the other.
    Sequence,
    /// To satisfy a formula.
    Formula,
    /// To be accepted by an automaton.
    Automaton,
}

/// What the words of a formula are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum LogicSpec {
    /// Infinite words.
    Ltl,
    /// Finite words.
    Ltlf,
}

/// A region to come to.
#[derive(Clone, Debug, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct LegSpec {
    /// The name of the region.
    pub(super) reach: String,
    /// The names of regions not to meet before.
    #[serde(default)]
    pub(super) avoid: Vec<String>,
}

/// An automaton: exactly one of `file` and `hoa`.
#[derive(Clone, Debug, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct AutomatonSpec {
    /// A file, relative to the model file.
    #[serde(default)]
    pub(super) file: Option<String>,
    /// The text itself.
    #[serde(default)]
    pub(super) hoa: Option<String>,
}

/// A box, or the name of a region.
#[derive(Clone, Debug)]
pub(super) enum PlaceSpec {
    /// A region.
    Name(String),
    /// A box.
    Region(RegionSpec),
}

/// A union of shapes.
#[derive(Clone, Debug)]
pub(super) struct ShapesSpec(pub(super) Vec<ShapeSpec>);

/// A box (`lower`, `upper`, half-open, null for an unbounded side) or a polytope `{x : G x ≤ g}`.
#[derive(Clone, Debug, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ShapeSpec {
    /// The lower corner of a box.
    #[serde(default)]
    pub(super) lower: Option<Vec<Option<f64>>>,
    /// The upper corner of a box.
    #[serde(default)]
    pub(super) upper: Option<Vec<Option<f64>>>,
    /// The normals of a polytope, one row per half-space.
    #[serde(rename = "G", default)]
    pub(super) normals: Option<Vec<Vec<f64>>>,
    /// The offsets of a polytope, one per half-space.
    #[serde(rename = "g", default)]
    pub(super) offsets: Option<Vec<f64>>,
}

/// A box with possibly unbounded sides.
#[derive(Clone, Debug, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RegionSpec {
    /// The lower corner, n numbers; null is unbounded.
    pub(super) lower: Vec<Option<f64>>,
    /// The upper corner, n numbers; null is unbounded.
    pub(super) upper: Vec<Option<f64>>,
}

impl<'de> Deserialize<'de> for Horizon {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let steps = deserializer.deserialize_any(IntegerOr { keyword: "infinite" })?;
        Ok(steps.map_or(Self::Infinite, Self::Steps))
    }
}

impl<'de> Deserialize<'de> for UnsafeSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(UnsafeVisitor)
    }
}

struct UnsafeVisitor;

impl<'de> Visitor<'de> for UnsafeVisitor {
    type Value = UnsafeSpec;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a box {\"lower\", \"upper\"}, the name of a region, or \"outside\"")
    }

    fn visit_str<E>(self, value: &str) -> Result<UnsafeSpec, E> {
        match value {
            "outside" => Ok(UnsafeSpec::Outside),
            name => Ok(UnsafeSpec::Region(PlaceSpec::Name(name.to_owned()))),
        }
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<UnsafeSpec, A::Error> {
        let region = RegionSpec::deserialize(MapAccessDeserializer::new(map))?;
        Ok(UnsafeSpec::Region(PlaceSpec::Region(region)))
    }
}

impl JsonSchema for UnsafeSpec {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Unsafe".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let region = generator.subschema_for::<RegionSpec>();
        json_schema!({"anyOf": [region, {"const": "outside"}, {"type": "string"}]})
    }
}

impl JsonSchema for Horizon {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Horizon".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({"anyOf": [{"type": "integer", "minimum": 1}, {"const": "infinite"}]})
    }
}

impl<'de> Deserialize<'de> for PlaceSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(PlaceVisitor)
    }
}

struct PlaceVisitor;

impl<'de> Visitor<'de> for PlaceVisitor {
    type Value = PlaceSpec;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a box {\"lower\", \"upper\"} or the name of a region")
    }

    fn visit_str<E>(self, value: &str) -> Result<PlaceSpec, E> {
        Ok(PlaceSpec::Name(value.to_owned()))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<PlaceSpec, A::Error> {
        RegionSpec::deserialize(MapAccessDeserializer::new(map)).map(PlaceSpec::Region)
    }
}

impl<'de> Deserialize<'de> for ShapesSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ShapesVisitor)
    }
}

struct ShapesVisitor;

impl<'de> Visitor<'de> for ShapesVisitor {
    type Value = ShapesSpec;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a box {\"lower\", \"upper\"}, a polytope {\"G\", \"g\"}, or a list of these")
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<ShapesSpec, A::Error> {
        ShapeSpec::deserialize(MapAccessDeserializer::new(map)).map(|shape| ShapesSpec(vec![shape]))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, items: A) -> Result<ShapesSpec, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(items)).map(ShapesSpec)
    }
}

impl JsonSchema for PlaceSpec {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Place".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let region = generator.subschema_for::<RegionSpec>();
        json_schema!({"anyOf": [region, {"type": "string"}]})
    }
}

impl JsonSchema for ShapesSpec {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Shapes".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let shape = generator.subschema_for::<ShapeSpec>();
        let shapes = generator.subschema_for::<Vec<ShapeSpec>>();
        json_schema!({"anyOf": [shape, shapes]})
    }
}
