//! What a controller remembers of a run.

use crate::partition::CellId;
use crate::problem::Objective;
use crate::task::{CellTask, LetterLookup, Memory, Standing};

/// What a run has done so far, as far as its task cares; the default before it begins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RunMemory(Option<Standing>);

impl RunMemory {
    /// Where the run stands with its task, if it has begun.
    pub fn standing(self) -> Option<Standing> {
        self.0
    }

    /// The memory with which the task is open, if it is.
    pub fn open(self) -> Option<Memory> {
        match self.0 {
            Some(Standing::Open(memory)) => Some(memory),
            _ => None,
        }
    }

    /// Its number in exported code, where a task has so many memories: that of an open memory; then those of a run that has
    /// not begun, of one that has done its task, and of one that has failed.
    pub fn number(self, memories: u32) -> u32 {
        match self.0 {
            Some(Standing::Open(memory)) => memory,
            None => memories,
            Some(Standing::Reached) => memories + 1,
            Some(Standing::Failed) => memories + 2,
        }
    }

    /// The memory with this [`number`](Self::number), if there is one.
    pub fn of_number(number: u32, memories: u32) -> Option<Self> {
        let standing = match number.checked_sub(memories) {
            None => Some(Standing::Open(number)),
            Some(0) => None,
            Some(1) => Some(Standing::Reached),
            Some(2) => Some(Standing::Failed),
            Some(_) => return None,
        };
        Some(Self(standing))
    }

    pub(super) fn fail(&mut self) {
        self.0 = Some(Standing::Failed);
    }
}

/// How states change what is remembered.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MemoryUpdate {
    task: CellTask,
    letters: LetterLookup,
}

impl MemoryUpdate {
    pub(super) fn new(task: &CellTask, objective: &Objective) -> Self {
        let letters = match objective {
            Objective::Reach { .. } | Objective::Stay { .. } => LetterLookup::default(),
            Objective::Automaton(task) => LetterLookup::new(task.regions()),
        };
        Self { task: task.clone(), letters }
    }

    pub(super) fn task(&self) -> &CellTask {
        &self.task
    }

    pub(super) fn letters(&self) -> &LetterLookup {
        &self.letters
    }

    /// Remembers a state in a cell: where the run stands then. What is decided stays so.
    pub(super) fn look(&self, memory: &mut RunMemory, cell: CellId, x: &[f64]) -> Standing {
        let standing = match memory.0 {
            Some(decided @ (Standing::Failed | Standing::Reached)) => decided,
            Some(Standing::Open(before)) => self.task.arrive(Some(before), cell, || self.letters.letter(x)),
            None => self.task.arrive(None, cell, || self.letters.letter(x)),
        };
        memory.0 = Some(standing);
        standing
    }
}
