//! Samples of the noise: read from CSV, or drawn from a Gaussian in a reproducible stream.

mod csv;
mod gaussian;
mod samples;

pub use csv::{CsvError, parse_csv};
pub use gaussian::Gaussian;
pub use samples::{NoiseSample, NoiseSamples};
