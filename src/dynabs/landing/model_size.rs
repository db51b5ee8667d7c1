//! How large the model of a lattice game is, before it is made.

use super::solve::Question;
use crate::task::Aim;

/// Per memory and cell: its state and where runs arrive.
const PAIR_BYTES: u64 = 48;

/// Per memory, cell and input: a choice, its name and its image, in lists that grow.
const CHOICE_BYTES: u64 = 48;

/// Per entry of a row: successor and bounds, in lists that grow, and what is searched for it.
const ENTRY_BYTES: u64 = 60;

impl Question<'_> {
    /// About how many bytes [`model`](Self::model) takes.
    pub fn model_bytes(&self) -> u64 {
        let clock = if self.task.aim() == Aim::End { self.steps.unwrap_or(1) } else { 1 };
        let memories = u64::from(self.task.memories()).saturating_mul(clock);
        let pairs = PAIR_BYTES * self.task.num_cells() as u64;
        let choices = CHOICE_BYTES * self.images.len() as u64;
        let lattice = self.lattice_entries().saturating_mul(ENTRY_BYTES);
        pairs.saturating_add(choices).saturating_add(lattice).saturating_mul(memories)
    }

    /// The entries of the rows of all sub-cells, pairs and boxes: once for every memory.
    fn lattice_entries(&self) -> u64 {
        let axes = self.landing.inner();
        let mut shape: Vec<u64> = axes.iter().map(|axis| axis.cells as u64).collect();
        let mut entries = 0u64;
        for &(j, _) in self.landing.stages() {
            let axis = &axes[j];
            let others = shape.iter().fold(1u64, |a, &b| a.saturating_mul(b)) / shape[j].max(1);
            shape[j] = axis.len as u64;
            if let Some(taps) = &axis.noise {
                let noise = (axis.len as u64).saturating_mul(taps.lower.len() as u64 + 2);
                entries = entries.saturating_add(others.saturating_mul(noise + 4 * axis.cells as u64 + 2));
            }
        }
        for noise in self.landing.moves() {
            let places = noise.from.iter().fold(1u64, |a, span| a.saturating_mul(span.len as u64));
            let of_tap =
                |size: &[u32]| size.iter().fold(1u64, |a, &b| a.saturating_mul(b.into())).saturating_add(1);
            let boxes = noise.taps.iter().fold(0u64, |sum, tap| sum.saturating_add(of_tap(&tap.size)));
            entries = entries.saturating_add(places.saturating_mul(boxes));
        }
        // From images to sub-cells.
        let sub_cells = self.landing.axes().iter().fold(1u64, |a, axis| a.saturating_mul(axis.len as u64));
        entries.saturating_add(sub_cells)
    }
}
