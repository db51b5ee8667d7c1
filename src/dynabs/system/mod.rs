//! Systems: how the state moves, where it takes cells, and the feedback laws that steer it.
//!
//! For steering to targets: linear systems, grouping of steps, LQR, the two-layer closed loop, the affine feedback
//! law. For any system: [`expression`]s, [`Interval`]s, [`Mode`]s, and the [`ImageMap`] of cells under inputs.

mod allocation;
mod demands;
mod eigenvalues;
pub mod expression;
mod feedback;
mod gain;
mod grouping;
mod grouping_trial;
mod image;
mod interval;
mod law;
mod linear_system;
mod mode;
mod partial_image;
mod rehearsal;
mod riccati;
mod sampling;
mod shares;
mod two_layer;

pub(crate) use allocation::rough_right_inverse;
pub use demands::Demands;
pub use eigenvalues::eigenvalues;
pub use feedback::Feedback;
pub use gain::narrowing_gain;
pub use grouping::{TooManyDigits, group, require_digits, smallest_group};
pub use grouping_trial::GroupingTrial;
pub use image::{ImageError, ImageMap, ImageScratch, Lattice, LatticeRange};
pub use interval::Interval;
pub use law::{Extent, FeedbackLaw, SteeringConstraint, decimal_gain, lower_layer_violation};
pub use linear_system::LinearSystem;
pub use mode::{Discretisation, Mode, Variable};
pub use partial_image::PartialImage;
pub use riccati::{Lqr, RiccatiError, spectral_radius};
pub use sampling::{SampledLinear, SamplingError, TaylorError, TaylorStep};
pub use shares::Shares;
pub use two_layer::TwoLayer;
