//! Files of samples that are not the model's.

use clap::{Args, ValueEnum};
use dynabs::model_file::Document;
use dynabs::noise::DecimalMark;
use dynabs::problem::SampleKind;

/// How a CSV file of samples is to be read.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct OtherSamplesArguments {
    /// What a sample of the CSV file is the noise of.
    #[arg(long, value_name = "KIND", default_value = "step")]
    samples_of: Of,

    /// What separates whole numbers from decimals in the CSV file; as in the model's samples without.
    #[arg(long, value_name = "MARK")]
    decimal: Option<Mark>,
}

/// What a sample is the noise of.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Of {
    /// One original step.
    Step,
    /// One group of steps.
    Grouped,
}

/// What separates whole numbers from decimals.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Mark {
    /// 1.5
    #[value(name = ".")]
    Point,
    /// 1,5, with semicolons between numbers
    #[value(name = ",")]
    Comma,
}

impl OtherSamplesArguments {
    /// What a sample is the noise of.
    pub(crate) fn of(self) -> SampleKind {
        match self.samples_of {
            Of::Step => SampleKind::Step,
            Of::Grouped => SampleKind::Grouped,
        }
    }

    /// How decimals are written, beside a model.
    pub(crate) fn decimal_mark(self, model: &Document) -> DecimalMark {
        match self.decimal {
            Some(Mark::Point) => DecimalMark::Point,
            Some(Mark::Comma) => DecimalMark::Comma,
            None => model.decimal_mark(),
        }
    }
}
