//! What a setting costs.

use crate::commands::sweep::figures::{Figure, figure};
use crate::commands::sweep::spec::Extent;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// What a choice is to have least of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Cost {
    /// The transitions of the model; where actions are inputs, its choices, each of which is one transition to the lattice that all
    /// share (the default).
    #[default]
    Transitions,
    /// The cells of the partition.
    Cells,
    /// The samples of the noise.
    Samples,
    /// The bytes of the tables of the exported controller.
    Table,
}

impl Cost {
    /// Its name in words.
    pub(super) fn words(self, takes_inputs: bool) -> &'static str {
        match self {
            Self::Transitions if takes_inputs => "choices",
            Self::Transitions => "transitions",
            Self::Cells => "cells",
            Self::Samples => "samples",
            Self::Table => "bytes of the controller's tables",
        }
    }

    /// What a setting costs at least, if that is known before it is compiled. A controller's tables have a number for every cell.
    pub(super) fn beforehand(self, extent: Extent) -> Option<u64> {
        match self {
            Self::Transitions => None,
            Self::Cells | Self::Table => Some(extent.cells),
            Self::Samples => Some(extent.samples.unwrap_or(0)),
        }
    }

    /// What it costs, if the result of its compilation says so.
    pub(super) fn of(self, extent: Extent, result: &Value) -> Option<u64> {
        match self {
            Self::Cells => Some(extent.cells),
            Self::Samples => Some(extent.samples.unwrap_or(0)),
            Self::Transitions | Self::Table => self.size(result),
        }
    }

    /// The size that tables show.
    pub(super) fn size(self, result: &Value) -> Option<u64> {
        let number = |of| figure(result, of).and_then(Value::as_u64);
        match self {
            Self::Table => number(Figure::ControllerBytes),
            _ => number(Figure::Transitions).or_else(|| number(Figure::Choices)),
        }
    }

    /// The name of its column.
    pub(super) fn column(self, takes_inputs: bool) -> &'static str {
        match self {
            Self::Table => "controller_bytes",
            _ if takes_inputs => "choices",
            _ => "transitions",
        }
    }
}
