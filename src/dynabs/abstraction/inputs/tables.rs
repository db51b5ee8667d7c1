//! Where cells go, by coordinate: a table for every row of the images that many cells or inputs share.

use super::InputsError;
use crate::landing::{ImageSource, SubCells};
use crate::partition::{CellId, Grid};
use crate::system::{ImageError, ImageScratch, ImageMap, LatticeRange};
use rayon::prelude::*;
use std::cell::RefCell;

/// The images of all cells under the inputs that are enabled.
pub(super) struct Tables<'a> {
    grid: &'a Grid,
    images: &'a ImageMap,
    inputs: usize,
    /// By row: its ranges over the product of the coordinates that it depends on, or nothing if it is computed anew.
    ranges: Vec<Option<Vec<LatticeRange>>>,
}

/// Tables with more entries than this are not worth their memory.
const LARGEST: u64 = 1 << 24;

thread_local! {
    static SCRATCH: RefCell<(ImageScratch, Vec<u32>)> = RefCell::default();
}

impl<'a> Tables<'a> {
    /// Tabulates what is shared.
    ///
    /// # Errors
    /// The first [`ImageError`], by row and cell, where a row has a table.
    pub(super) fn new(grid: &'a Grid, images: &'a ImageMap, inputs: usize) -> Result<Self, InputsError> {
        let table = |row: usize| -> Result<Option<Vec<LatticeRange>>, ImageError> {
            let lengths: Vec<u32> = images.depends_on(row).iter().map(|&j| grid.axes()[j].cells()).collect();
            let entries: u64 = lengths.iter().map(|&n| u64::from(n)).product();
            if images.is_exact(row) && lengths.len() == grid.dimension() || entries > LARGEST {
                return Ok(None);
            }
            let entry = |index: usize| {
                let mut cell = vec![0; grid.dimension()];
                let mut rest = index as u32;
                for (&j, length) in images.depends_on(row).iter().zip(&lengths).rev() {
                    cell[j] = rest % length;
                    rest /= length;
                }
                SCRATCH.with_borrow_mut(|(scratch, _)| images.range(row, &cell, scratch))
            };
            (0..entries as usize).into_par_iter().map(entry).collect::<Result<Vec<_>, _>>().map(Some)
        };
        let ranges = (0..images.num_rows()).map(table).collect::<Result<_, _>>();
        let ranges = ranges.map_err(|error| InputsError::Image(Box::new(error)))?;
        Ok(Self { grid, images, inputs, ranges })
    }

    fn range(&self, row: usize, cell: &[u32], scratch: &mut ImageScratch) -> LatticeRange {
        let Some(table) = &self.ranges[row] else {
            // What is undefined somewhere may lead anywhere; that is reported before.
            return self.images.range(row, cell, scratch).unwrap_or(LatticeRange::EVERYTHING);
        };
        let index = |at: usize, &j: &usize| at * self.grid.axes()[j].cells() as usize + cell[j] as usize;
        table[self.images.depends_on(row).iter().fold(0, index)]
    }
}

impl ImageSource for Tables<'_> {
    fn inputs(&self) -> usize {
        self.inputs
    }

    fn image(&self, cell: u32, input: u32, out: &mut SubCells) -> bool {
        SCRATCH.with_borrow_mut(|(scratch, place)| {
            place.clear();
            place.extend((0..self.grid.dimension()).map(|j| self.grid.coordinate(CellId(cell), j)));
            for (j, out) in out.iter_mut().enumerate() {
                let range = self.range(self.images.row(input as usize, j), place, scratch);
                *out = (range.first, range.last);
            }
        });
        true
    }
}
