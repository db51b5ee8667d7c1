//! Choices of the library that an option names.

use clap::ValueEnum;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use dynabs::abstraction::inputs::InputEncoding;
use imdp::formats::{Encoding, Format, Names};

/// Takes one of these formats by its name.
pub(crate) fn format_names(formats: impl Iterator<Item = Format>) -> impl TypedValueParser<Value = Format> {
    let names = formats.map(|format| PossibleValue::new(format.name()).help(format.about()));
    PossibleValuesParser::new(names)
        .try_map(|name| Format::of_name(&name).ok_or_else(|| format!("found no format {name}")))
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
