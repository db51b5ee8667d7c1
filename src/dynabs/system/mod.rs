//! Linear systems: grouping of steps, LQR, the two-layer closed loop, and the affine feedback law.

mod grouping;
mod law;
mod linear_system;
mod partial_image;
mod riccati;
mod two_layer;

pub use grouping::{group, smallest_group};
pub use law::{Extent, FeedbackLaw, SteeringConstraint, decimal_gain, lower_layer_violation};
pub use linear_system::LinearSystem;
pub use partial_image::PartialImage;
pub use riccati::{Lqr, RiccatiError, spectral_radius};
pub use two_layer::TwoLayer;
