//! Landing: where inputs take cells, and where noise takes them from there.
//!
//! A lattice cuts space into sub-cells, `r` a cell and coordinate. The image of a cell under an input is covered by a
//! box of sub-cells ([`Images`]); for every sub-cell there is a bound on the expected value after the noise
//! ([`Landing::values`]); a step is one extremum over each box ([`Landing::best`], [`Layout`]); a task is a [`Question`].
//!
//! # Why it is sound
//!
//! Let `m` be the image of the true state: it lies in some sub-cell `i` of the box. If `η ∈ [kδ, (k+1)δ)` in one
//! coordinate then `m + η` lies in sub-cell `i + k` or `i + k + 1`, also if `m` is on the upper face of `i`. Nature may choose
//! the sub-cell of the image, and for every coordinate and `k` which of the two it is, knowing all that happened before:
//! more than it can in truth. Its least (greatest) value is therefore a bound on the true one, step by step. In a
//! coordinate without noise sub-cells are cells, half-open like them.
//!
//! All numbers are rounded to the side that they bound: sums of products of numbers in `[0, 1]` err by a known factor.

mod arrays;
mod arrivals;
mod axis;
mod flat;
mod gather;
mod image_source;
mod images;
mod invariant;
mod kernel;
mod layers;
mod layout;
mod masses;
mod model;
mod model_size;
mod move_layers;
#[cfg(test)]
mod move_tests;
mod moves;
mod picks;
mod side;
mod solve;
mod stage;
mod stencil;
mod step;
mod stored;
mod taps;
#[cfg(test)]
mod tests;
mod weights;

pub(crate) use arrays::Arrays;
pub(crate) use arrivals::{FAILED, LOST};
pub use axis::Axis;
pub use flat::FlatModelError;
pub(crate) use gather::Gather;
pub use image_source::{ImageSource, LandingError};
pub use images::{Images, occurring};
pub use layout::Layout;
pub use model::LandingModel;
pub use side::{Lower, Side, Slack, Upper};
pub use solve::{LandingSolution, Question};
pub use stencil::{Band, Stencil, Tap};
pub use step::{Best, Landing};
pub use taps::Taps;
