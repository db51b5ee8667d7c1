//! Which files are written that nobody asked for: none that would surprise by its size.

use super::{CliError, thousands};
use dynabs::run::RunDirectoryError;
use imdp::formats::umb::Compression;
use imdp::formats::{Format, ModelWriter};
use imdp::model::IntervalMdp;

/// Larger files are only written if their format is asked for.
const MOST_BYTES: u64 = 100_000_000;

/// The formats to write, and a line for the summary about what is left out.
#[derive(Clone, Debug, Default)]
pub(super) struct Unasked {
    pub(super) formats: Vec<Format>,
    pub(super) left_out: Option<String>,
}

impl Unasked {
    /// PRISM's files, if they are small.
    ///
    /// # Errors
    /// [`CliError`] if the model cannot be written in this format, or not within the memory there is.
    pub(super) fn of(model: &IntervalMdp) -> Result<Self, CliError> {
        let writer = ModelWriter::new(model, Format::Prism, Compression::Gzip)
            .map_err(|error| CliError::from(RunDirectoryError::from(error)))?;
        let bytes = writer.bytes();
        Ok(match bytes <= MOST_BYTES {
            true => Self { formats: vec![Format::Prism], left_out: None },
            false => {
                let size = thousands(bytes / 1_000_000);
                let line = format!("  {:<13}model.tra of {size} MB: --format prism writes it\n", "left out");
                Self { formats: vec![], left_out: Some(line) }
            }
        })
    }
}
