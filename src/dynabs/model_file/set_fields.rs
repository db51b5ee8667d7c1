//! The fields of sets: of inputs, and of cells.

use schemars::JsonSchema;

/// A set of inputs: a box (`lower`, `upper`) or a polytope `{u : G u ≤ g}`.
#[derive(Clone, Debug, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SetSpec {
    /// The lower corner of a box.
    #[serde(default)]
    pub(super) lower: Option<Vec<f64>>,
    /// The upper corner of a box.
    #[serde(default)]
    pub(super) upper: Option<Vec<f64>>,
    /// The normals of a polytope, one row per half-space.
    #[serde(rename = "G", default)]
    pub(super) normals: Option<Vec<Vec<f64>>>,
    /// The offsets of a polytope, one per half-space.
    #[serde(rename = "g", default)]
    pub(super) offsets: Option<Vec<f64>>,
    /// For actions "inputs": how many values of each input of a box there are to choose from, evenly spaced with both
    /// ends; 5 of a single input and 3 of each of several if absent.
    #[serde(default)]
    pub(super) points: Option<Vec<u32>>,
    /// For actions "inputs": the inputs to choose from.
    #[serde(default)]
    pub(super) list: Option<Vec<Vec<f64>>>,
}

/// A grid: the box from `lower` to `upper`, cut into equal cells.
#[derive(Clone, Debug, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct GridSpec {
    /// The lower corner, n numbers.
    pub(super) lower: Vec<f64>,
    /// The upper corner, n numbers.
    pub(super) upper: Vec<f64>,
    /// The number of cells in each dimension.
    pub(super) cells: Vec<u32>,
    /// For actions "inputs": in which dimensions the upper face is the lower one again, as with angles.
    #[serde(default)]
    pub(super) periodic: Option<Vec<bool>>,
    /// For actions "inputs": how many sub-cells a cell has in each dimension for images to land on; chosen if absent.
    #[serde(default)]
    pub(super) resolution: Option<Vec<u32>>,
}
