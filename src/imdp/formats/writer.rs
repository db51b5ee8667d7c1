//! Writing a model in any format.

use super::bmdp::BmdpWriter;
use super::drn::DrnWriter;
use super::names::NameError;
use super::netcdf::{NetcdfError, NetcdfWriter};
use super::prism::{MAX_COUNT, RewardFile, TraWriter, check_names, write_lab, write_sta};
use super::umb::{Compression, UmbWriter};
use super::{Format, native};
use crate::model::{
    ExactBound, IntervalMdp, MemoryError, RewardStructure, RowBuffer, RowId, StateId, require_memory,
};
use crate::progress::Progress;
use std::io::{self, Write};

/// Writes a model in one of the formats, one file after the other.
#[derive(Debug)]
pub struct ModelWriter<'a> {
    model: &'a IntervalMdp,
    format: Format,
    writer: FormatWriter<'a>,
}

#[derive(Debug)]
enum FormatWriter<'a> {
    Native,
    Prism(TraWriter<'a>),
    Drn(DrnWriter<'a>),
    Umb(Box<UmbWriter<'a>>, Compression),
    Bmdp(BmdpWriter<'a>),
    Netcdf(NetcdfWriter<'a>),
}

/// Why a model cannot be written in a format.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum WriteError {
    /// It has a name that the format cannot express.
    #[error(transparent)]
    Name(#[from] NameError),
    /// It is beyond what IntervalMDP.jl reads.
    #[error(transparent)]
    Netcdf(#[from] NetcdfError),
    /// The format is only read.
    #[error("found the format {format}, which is only read; expected one of {}", written())]
    ReadOnly {
        /// The format.
        format: Format,
    },
    /// It is beyond what PRISM reads.
    #[error(
        "found {states} states, {choices} choices and {transitions} transitions; expected at most {MAX_COUNT} of \
         each, which is what PRISM reads"
    )]
    TooLargeForPrism {
        /// The number of states.
        states: u64,
        /// The number of choices.
        choices: u64,
        /// The number of transitions.
        transitions: u64,
    },
    /// The text of the rows, which is made once, does not fit into memory.
    #[error(transparent)]
    Memory(#[from] MemoryError),
    /// It has a bound that the format cannot express.
    #[error(
        "found the bound {bound} of successor {successor} in row {row}, which {format} cannot hold; expected {holds}; write \
         {instead}, which keeps the number"
    )]
    Bound {
        /// The row.
        row: RowId,
        /// The successor.
        successor: StateId,
        /// The bound.
        bound: String,
        /// The format.
        format: &'static str,
        /// What it has instead.
        holds: &'static str,
        /// A format that has such bounds.
        instead: &'static str,
    },
}

/// The names of the formats that are written.
fn written() -> String {
    Format::written().map(Format::name).collect::<Vec<_>>().join(", ")
}

/// Refuses bounds that a format would have to replace by others.
fn check_bounds(model: &IntervalMdp, format: Format) -> Result<(), WriteError> {
    const DOUBLES: &str = "doubles, each for its shortest decimal";
    let (name, holds, instead) = match format {
        Format::Native => ("a .dynabs file", DOUBLES, ".tra or .drn"),
        Format::Umb => ("UMB", DOUBLES, ".tra or .drn"),
        Format::Netcdf => ("NetCDF", DOUBLES, ".tra or .drn"),
        Format::Prism | Format::Combined => ("a .tra file", "decimals only", ".drn"),
        Format::Bmdp => ("bmdp-tool's format", "decimals only", ".drn"),
        Format::Drn => return Ok(()),
    };
    let fits = |bound: &ExactBound| holds != DOUBLES && bound.value.is_decimal();
    for row in model.rows().inexact_rows() {
        let buffer = &mut RowBuffer::default();
        let entries = model.rows().row(row, buffer);
        let mut bounds = entries.exact.iter();
        if let Some(bound) = bounds.find(|bound| !fits(bound)) {
            let successor = entries.successors[bound.position as usize];
            let bound = bound.value.to_string();
            return Err(WriteError::Bound { row, successor, bound, format: name, holds, instead });
        }
    }
    Ok(())
}

/// What an entry of a row takes as text, or as the arrays of an archive.
const ENTRY_BYTES: u64 = 64;

impl<'a> ModelWriter<'a> {
    /// Prepares to write `model`; `compression` is that of UMB.
    ///
    /// # Errors
    /// [`WriteError`] if the format cannot express the model.
    pub fn new(model: &'a IntervalMdp, format: Format, compression: Compression) -> Result<Self, WriteError> {
        check_bounds(model, format)?;
        if format != Format::Native {
            let bytes = ENTRY_BYTES * model.rows().num_entries() as u64;
            require_memory(format!("writing the rows as {}", format.extension()), bytes)?;
        }
        let writer = match format {
            Format::Native => FormatWriter::Native,
            Format::Drn => FormatWriter::Drn(DrnWriter::new(model)?),
            Format::Umb => FormatWriter::Umb(Box::new(UmbWriter::new(model)?), compression),
            Format::Bmdp => FormatWriter::Bmdp(BmdpWriter::new(model)),
            Format::Netcdf => FormatWriter::Netcdf(NetcdfWriter::new(model)?),
            Format::Combined => return Err(WriteError::ReadOnly { format }),
            Format::Prism => {
                check_names(model)?;
                let size = model.size();
                if size.states.max(size.choices).max(size.transitions) > MAX_COUNT {
                    return Err(WriteError::TooLargeForPrism {
                        states: size.states,
                        choices: size.choices,
                        transitions: size.transitions,
                    });
                }
                FormatWriter::Prism(TraWriter::new(model))
            }
        };
        Ok(Self { model, format, writer })
    }

    /// The extensions of the files, the largest one first.
    pub fn extensions(&self) -> &'static [&'static str] {
        self.format.extensions()
    }

    /// The files of what is earned, which PRISM has beside the others.
    pub fn reward_files(&self) -> Vec<RewardFile<'a>> {
        match self.writer {
            FormatWriter::Prism(_) => RewardFile::all(self.model),
            _ => vec![],
        }
    }

    /// The reward structures that the format cannot hold, by name: they are not written.
    pub fn rewards_left_out(&self) -> Vec<&'a str> {
        let is_left_out = |structure: &&RewardStructure| match self.writer {
            FormatWriter::Native | FormatWriter::Prism(_) | FormatWriter::Umb(..) => false,
            FormatWriter::Drn(_) => !DrnWriter::holds(structure),
            FormatWriter::Bmdp(_) | FormatWriter::Netcdf(_) => true,
        };
        self.model.rewards().iter().filter(is_left_out).map(|structure| structure.name.as_str()).collect()
    }

    /// The size of the largest file in bytes, before compression; 0 if it is small anyway.
    pub fn bytes(&self) -> u64 {
        match &self.writer {
            FormatWriter::Native | FormatWriter::Bmdp(_) | FormatWriter::Netcdf(_) => 0,
            FormatWriter::Prism(writer) => writer.bytes(),
            FormatWriter::Drn(writer) => writer.bytes(),
            FormatWriter::Umb(writer, _) => writer.bytes(),
        }
    }

    /// Writes the file with one of the [`extensions`](Self::extensions).
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(
        &self,
        extension: &str,
        out: &mut (impl Write + Send),
        progress: &dyn Progress,
    ) -> io::Result<()> {
        match (&self.writer, extension) {
            (FormatWriter::Native, _) => native::write(self.model, out),
            (FormatWriter::Prism(_), "sta") => write_sta(self.model, out),
            (FormatWriter::Prism(_), "lab") => write_lab(self.model, out),
            (FormatWriter::Prism(writer), _) => writer.write(out, progress),
            (FormatWriter::Drn(writer), _) => writer.write(out, progress),
            (FormatWriter::Bmdp(writer), _) => writer.write(out, progress),
            (FormatWriter::Netcdf(writer), _) => writer.write(out),
            (FormatWriter::Umb(writer, compression), _) => writer.write(out, *compression, progress),
        }
    }
}
