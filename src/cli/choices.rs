//! Choices of the library that an option names.

use clap::ValueEnum;
use imdp::formats::{Encoding, Format};

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
}

impl From<EncodingName> for Encoding {
    fn from(name: EncodingName) -> Self {
        match name {
            EncodingName::Plain => Self::Plain,
            EncodingName::Rows => Self::Rows,
        }
    }
}
