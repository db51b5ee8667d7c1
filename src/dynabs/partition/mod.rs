//! Rectangular partitions with exact faces, and the regions that label their cells.
//!
//! Cells and regions are half-open boxes `[lower, upper)`: every state belongs to exactly one cell, and
//! whether a cell lies in a region or meets it needs no assumption on the noise having a density.

mod grid;
mod labels;
mod lookup;
mod region;

pub use grid::{CellId, Grid, GridAxis, GridError};
pub use labels::{CellKind, CellLabels};
pub use lookup::{CellLookup, RegionLookup};
pub use region::{NearMiss, Region, first_overlap, near_misses};
