//! Where cells go, and why that may not be stored.

/// Where a cell goes under an input: a product of ranges of sub-cells, one for each coordinate.
pub trait ImageSource: Sync {
    /// The number of inputs.
    fn inputs(&self) -> usize;

    /// The ranges that occur in a coordinate, from their first to their last sub-cell, unwrapped.
    fn ranges(&self, coordinate: usize) -> &[(i64, i64)];

    /// Writes by coordinate which of its ranges has the image of a cell under an input; `false` if the input is not
    /// enabled there.
    fn image(&self, cell: u32, input: u32, out: &mut [u32]) -> bool;
}

/// Why images cannot be stored.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LandingError {
    /// The lattice has too many points.
    #[error(
        "found a lattice of {points} sub-cells in which images and noise land; expected at most {}",
        u32::MAX - 1
    )]
    TooFine {
        /// The number of sub-cells that are looked at.
        points: u128,
    },
}
