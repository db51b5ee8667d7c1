//! Noise: samples, read from CSV or drawn from a Gaussian in a reproducible stream, and known distributions.

mod csv;
mod gaussian;
pub mod known;
mod overlap;
mod samples;

pub use csv::{CsvError, DecimalMark, parse_csv};
pub use gaussian::Gaussian;
pub use overlap::overlap;
pub use samples::{NoiseSample, NoiseSamples};
