//! What every exported controller computes with: sizes and tables, the same in C, Python, MATLAB, .npz and .mat.

use super::law_tables::{law_tables, used};
use super::memory_tables::memory_tables;
use super::table::Table;
use crate::controller::Controller;
use crate::controller::law::Law;
use crate::partition::{CellId, CellKind};

/// Why a controller cannot be exported.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// The horizon does not fit the exported code's counter of 32 bits.
    #[error(
        "found a horizon of {steps} grouped steps; expected at most 4294967295, up to which exported code counts"
    )]
    HorizonTooLong {
        /// The horizon.
        steps: u64,
    },
    /// A table is too large for the format.
    #[error("the tables cannot be packed: {0}")]
    Packing(#[from] std::io::Error),
    /// The template cannot be rendered: a mistake in this program.
    #[error("the template of the exported code cannot be rendered: {0}")]
    Template(#[from] askama::Error),
}

/// Sizes and tables of a controller.
pub(super) struct Tables {
    /// `n`.
    pub(super) states: usize,
    /// `p`, the inputs of one step.
    pub(super) inputs: usize,
    /// `d`, the steps between two looks at the state.
    pub(super) group: usize,
    /// In groups of steps; 0 if there is no horizon.
    pub(super) horizon: u32,
    pub(super) cells: u32,
    /// Whether actions are targets.
    pub(super) steers: bool,
    /// If the task is an automaton.
    pub(super) memory: Option<MemorySizes>,
    pub(super) all: Vec<Table>,
}

/// How many memories, letters and regions there are. Memory `memories` is the start; the next two are done and failed.
pub(super) struct MemorySizes {
    pub(super) memories: u32,
    pub(super) letters: usize,
    pub(super) regions: usize,
}

impl MemorySizes {
    pub(super) fn done(&self) -> u32 {
        self.memories + 1
    }

    pub(super) fn failed(&self) -> u32 {
        self.memories + 2
    }
}

impl Tables {
    /// The tables of a controller.
    ///
    /// # Errors
    /// [`ExportError::HorizonTooLong`].
    pub(super) fn new(controller: &Controller) -> Result<Self, ExportError> {
        let steps = controller.horizon().unwrap_or(0);
        let horizon = u32::try_from(steps).map_err(|_| ExportError::HorizonTooLong { steps })?;
        let faces = controller.lookup.faces();
        let kind = |cell| match controller.kind(CellId(cell)) {
            CellKind::Ordinary => 0,
            CellKind::Goal => 1,
            CellKind::Unsafe => 2,
        };
        let mut all = vec![
            Table::doubles("faces", faces.concat()),
            Table::whole("first_face", starts(faces.iter().map(Vec::len))),
            Table::whole("stride", controller.lookup.strides().to_vec()),
        ];
        let memory = memory_tables(controller).map(|(sizes, tables)| {
            all.extend(tables);
            sizes
        });
        if memory.is_none() {
            all.push(Table::whole("kind", (0..controller.num_cells()).map(kind).collect()));
        }
        let schedule = &controller.schedule;
        let used = used(controller);
        let action = |action: u32| used.partition_point(|&other| other < action) as u32;
        all.push(Table::whole("first_entry", schedule.starts.iter().map(|&start| start as u32).collect()));
        // Nobody looks further ahead than the horizon.
        let left = schedule.entries.iter().map(|entry| entry.steps_left as u32).collect();
        all.push(Table::whole("steps_left", left));
        all.push(Table::whole(
            "action_of",
            schedule.entries.iter().map(|entry| action(entry.action)).collect(),
        ));
        all.extend(law_tables(controller, &used));
        Ok(Self {
            states: controller.state_dimension(),
            inputs: controller.step_inputs(),
            group: controller.group_steps(),
            horizon,
            cells: controller.num_cells(),
            steers: matches!(controller.law, Law::Steering(_)),
            memory,
            all,
        })
    }

    /// Sizes by name, for formats that hold tables alone: 0 where there is no horizon, or no memory.
    pub(super) fn sizes(&self) -> [(&'static str, u32); 5] {
        [
            ("states", self.states as u32),
            ("inputs", self.inputs as u32),
            ("group_steps", self.group as u32),
            ("horizon", self.horizon),
            ("memories", self.memory.as_ref().map_or(0, |memory| memory.memories)),
        ]
    }

    /// The table of a name.
    ///
    /// # Errors
    /// If there is none: a template asks for what this controller has not.
    pub(super) fn get(&self, name: &str) -> askama::Result<&Table> {
        let found = self.all.iter().find(|table| table.name == name);
        found.ok_or_else(|| askama::Error::Custom(format!("no table {name}").into()))
    }
}

/// Where each of some lists begins if they are put together, and where the last one ends.
pub(super) fn starts(lengths: impl Iterator<Item = usize>) -> Vec<u32> {
    let ends = lengths.scan(0, |sum, length| {
        *sum += length as u32;
        Some(*sum)
    });
    std::iter::once(0).chain(ends).collect()
}
