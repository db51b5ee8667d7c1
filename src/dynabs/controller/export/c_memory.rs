//! The tables of a task's memory, for C.

use super::c_text::{double, filled, list, rows};
use crate::controller::Controller;
use crate::partition::CellId;
use crate::task::{HalfSpace, Standing};

/// The tables, field by field as the template names them.
pub(super) struct MemorySource {
    pub(super) memories: u32,
    pub(super) done: u32,
    pub(super) failed: u32,
    pub(super) letters: usize,
    pub(super) class_of: String,
    pub(super) classes: usize,
    pub(super) certain: String,
    pub(super) possible: String,
    pub(super) next: String,
    pub(super) regions: usize,
    pub(super) shapes: usize,
    pub(super) half_spaces: usize,
    pub(super) first_shape: String,
    pub(super) first_half_space: String,
    pub(super) normal: String,
    pub(super) offset: String,
    pub(super) strict: String,
}

impl MemorySource {
    /// The tables of a controller whose task is an automaton.
    pub(super) fn new(controller: &Controller) -> Option<Self> {
        let task = controller.task();
        let letters = task.letters()?;
        let memories = task.memories();
        let number = |standing: &Standing| match *standing {
            Standing::Open(memory) => memory,
            Standing::Reached => memories + 1,
            Standing::Failed => memories + 2,
        };
        let regions = controller.memory.letters().regions();
        let shapes: Vec<&Vec<HalfSpace>> = regions.iter().flatten().collect();
        let half_spaces: Vec<&HalfSpace> = shapes.iter().copied().flatten().collect();
        let none = vec![0.0; controller.state_dimension()];
        let normals = half_spaces.iter().map(|half_space| half_space.normal.as_slice()).collect();
        let offsets: Vec<f64> = half_spaces.iter().map(|half_space| half_space.offset).collect();
        let strict: Vec<u8> = half_spaces.iter().map(|half_space| half_space.strict.into()).collect();
        Some(Self {
            memories,
            done: memories + 1,
            failed: memories + 2,
            letters: letters.next.first().map_or(1, Vec::len),
            class_of: list((0..controller.num_cells()).map(|cell| task.class(CellId(cell)))),
            classes: letters.labels.len(),
            certain: list(letters.labels.iter().map(|label| label.certain)),
            possible: list(letters.labels.iter().map(|label| label.possible)),
            next: list(letters.next.iter().flatten().map(number)),
            regions: regions.len(),
            shapes: shapes.len(),
            half_spaces: half_spaces.len().max(1),
            first_shape: list(starts(regions.iter().map(Vec::len))),
            first_half_space: list(starts(shapes.iter().map(|shape| shape.len()))),
            normal: rows(&filled(normals, &none[..]).concat(), controller.state_dimension()),
            offset: list(filled(offsets, 0.0).iter().map(double)),
            strict: list(filled(strict, 0).into_iter()),
        })
    }
}

/// Where each of some lists begins if they are put together, and where the last one ends.
fn starts(lengths: impl Iterator<Item = usize>) -> impl Iterator<Item = usize> {
    let ends = lengths.scan(0, |sum, length| {
        *sum += length;
        Some(*sum)
    });
    std::iter::once(0).chain(ends)
}
