//! Choices of the library that an option names.

use clap::ValueEnum;
use dynabs::abstraction::inputs::InputEncoding;
use imdp::formats::{Encoding, Format, Names};

/// The formats, as `--format` names them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FormatName {
    /// PRISM's explicit files: .tra, .sta and .lab.
    Prism,
    /// Storm's explicit text format, .drn.
    Drn,
    /// The unified Markov binary format that PRISM and Storm read, .umb.
    Umb,
    /// The compact format of this program, .dynabs.
    Dynabs,
}

impl From<FormatName> for Format {
    fn from(name: FormatName) -> Self {
        match name {
            FormatName::Prism => Self::Prism,
            FormatName::Drn => Self::Drn,
            FormatName::Umb => Self::Umb,
            FormatName::Dynabs => Self::Native,
        }
    }
}

/// The encodings, as `--encoding` names them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum EncodingName {
    /// Every choice with all its transitions.
    #[default]
    Plain,
    /// Every choice with one transition to a state that stands for its row.
    Rows,
    /// Actions "inputs": every choice with an interval for each cell instead of the states of the lattice; looser.
    Flat,
}

impl From<EncodingName> for Encoding {
    fn from(name: EncodingName) -> Self {
        match name {
            EncodingName::Plain | EncodingName::Flat => Self::Plain,
            EncodingName::Rows => Self::Rows,
        }
    }
}

impl From<EncodingName> for InputEncoding {
    fn from(name: EncodingName) -> Self {
        match name {
            EncodingName::Plain | EncodingName::Rows => Self::Landing,
            EncodingName::Flat => Self::Flat,
        }
    }
}

/// The formats that models can be converted into, as `--to` names them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum AnyFormatName {
    /// PRISM's explicit files: .tra, .sta and .lab.
    Prism,
    /// Storm's explicit text format, .drn.
    Drn,
    /// The unified Markov binary format that PRISM and Storm read, .umb.
    Umb,
    /// The compact format of this program, .dynabs.
    Dynabs,
    /// The text format of bmdp-tool, .txt: transitions and the states to be reached only.
    Bmdp,
    /// The NetCDF format of IntervalMDP.jl, .nc: transitions only; .json beside has what is asked.
    Netcdf,
}

impl From<AnyFormatName> for Format {
    fn from(name: AnyFormatName) -> Self {
        match name {
            AnyFormatName::Prism => Self::Prism,
            AnyFormatName::Drn => Self::Drn,
            AnyFormatName::Umb => Self::Umb,
            AnyFormatName::Dynabs => Self::Native,
            AnyFormatName::Bmdp => Self::Bmdp,
            AnyFormatName::Netcdf => Self::Netcdf,
        }
    }
}

/// What becomes of names that PRISM's files cannot express, as `--names` names it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum NamesChoice {
    /// They are an error.
    Keep,
    /// They are replaced by similar ones.
    #[default]
    Rename,
    /// They are left out.
    Drop,
}

impl From<NamesChoice> for Names {
    fn from(choice: NamesChoice) -> Self {
        match choice {
            NamesChoice::Keep => Self::Keep,
            NamesChoice::Rename => Self::Rename,
            NamesChoice::Drop => Self::Drop,
        }
    }
}
