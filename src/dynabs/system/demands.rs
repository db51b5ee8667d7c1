//! What a law is made for.

/// What a law is made for: the half widths of cells, and states at which to stay, with their weights.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Demands {
    /// Half the width of a cell, per dimension.
    pub cell: Vec<f64>,
    /// States, and how much it matters that they can be kept.
    pub holds: Vec<(Vec<f64>, f64)>,
}
