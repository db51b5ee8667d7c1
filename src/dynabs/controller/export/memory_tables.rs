//! The tables of a task's memory.

use super::table::Table;
use super::tables::{MemorySizes, starts};
use crate::controller::Controller;
use crate::partition::CellId;
use crate::task::{HalfSpace, Standing};

/// The sizes and tables of a controller whose task is an automaton.
pub(super) fn memory_tables(controller: &Controller) -> Option<(MemorySizes, Vec<Table>)> {
    let task = controller.task();
    let letters = task.letters()?;
    let n = controller.state_dimension();
    let regions = controller.memory.letters().regions();
    let shapes: Vec<&Vec<HalfSpace>> = regions.iter().flatten().collect();
    let half_spaces: Vec<&HalfSpace> = shapes.iter().copied().flatten().collect();
    let sizes = MemorySizes {
        memories: task.memories(),
        letters: letters.next.first().map_or(1, Vec::len),
        regions: regions.len(),
    };
    let number = |standing: &Standing| match *standing {
        Standing::Open(memory) => memory,
        Standing::Reached => sizes.done(),
        Standing::Failed => sizes.failed(),
    };
    let normals: Vec<f64> = half_spaces.iter().flat_map(|half_space| &half_space.normal).copied().collect();
    // A letter is a number of next's columns: 32 bits hold it.
    let tables = vec![
        Table::whole("class_of", (0..controller.num_cells()).map(|cell| task.class(CellId(cell))).collect()),
        Table::whole("certain", letters.labels.iter().map(|label| label.certain as u32).collect()),
        Table::whole("possible", letters.labels.iter().map(|label| label.possible as u32).collect()),
        Table::whole("next_memory", letters.next.iter().flatten().map(number).collect()),
        Table::whole("first_shape", starts(regions.iter().map(Vec::len))),
        Table::whole("first_half_space", starts(shapes.iter().map(|shape| shape.len()))),
        Table::matrix("normal", [half_spaces.len(), n], normals),
        Table::doubles("offset", half_spaces.iter().map(|half_space| half_space.offset).collect()),
        Table::whole("strict", half_spaces.iter().map(|half_space| half_space.strict.into()).collect()),
    ];
    Some((sizes, tables))
}
