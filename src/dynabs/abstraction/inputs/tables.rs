//! Where cells go, by coordinate: a table for every row of the images that many cells or inputs share.

use super::InputsError;
use crate::landing::ImageSource;
use crate::partition::{CellId, Grid};
use crate::system::{ImageError, ImageMap, ImageScratch, LatticeRange};
use rayon::prelude::*;
use std::cell::RefCell;
use std::collections::BTreeSet;

/// The images of all cells under the inputs that are enabled.
pub(super) struct Tables<'a> {
    grid: &'a Grid,
    images: &'a ImageMap,
    inputs: usize,
    /// By coordinate: the ranges that occur in its rows, ascending.
    ranges: Vec<Vec<(i64, i64)>>,
    rows: Vec<Table>,
}

/// The ranges of a row.
enum Table {
    /// By number, over the product of the coordinates that it depends on: how far apart neighbours are in each.
    Stored { strides: Vec<(usize, u32)>, ranges: Vec<u32> },
    /// Computed anew whenever they are needed.
    Computed,
}

/// Tables with more entries than this are not worth their memory.
const LARGEST: u64 = 1 << 24;

/// Neither are tables with more entries than this that have one for every cell and are soon computed.
const LARGEST_UNSHARED: u64 = 1 << 20;

/// How many cells one task looks at.
const BLOCK: usize = 1 << 12;

thread_local! {
    static SCRATCH: RefCell<(ImageScratch, Vec<u32>)> = RefCell::default();
}

impl<'a> Tables<'a> {
    /// Tabulates what is shared.
    ///
    /// # Errors
    /// The first [`ImageError`], by row and cell, where a row has a table.
    pub(super) fn new(grid: &'a Grid, images: &'a ImageMap, inputs: usize) -> Result<Self, InputsError> {
        let rows: Result<Vec<_>, ImageError> =
            (0..images.num_rows()).map(|row| Self::row(grid, images, row)).collect();
        let mut rows = rows.map_err(|error| InputsError::Image(Box::new(error)))?;
        let mut occurring = vec![BTreeSet::new(); grid.dimension()];
        for (row, (_, distinct)) in rows.iter().enumerate() {
            occurring[images.coordinate(row)].extend(distinct.iter().copied());
        }
        let ranges: Vec<Vec<_>> = occurring.into_iter().map(|ranges| ranges.into_iter().collect()).collect();
        for (row, (table, distinct)) in rows.iter_mut().enumerate() {
            let ranges = &ranges[images.coordinate(row)];
            let numbers: Vec<u32> = distinct.iter().map(|range| number(ranges, range)).collect();
            if let Table::Stored { ranges, .. } = table {
                ranges.par_iter_mut().for_each(|range| *range = numbers[*range as usize]);
            }
        }
        Ok(Self { grid, images, inputs, ranges, rows: rows.into_iter().map(|(table, _)| table).collect() })
    }

    /// A row over the coordinates that it depends on, and its ranges, ascending.
    fn row(grid: &Grid, images: &ImageMap, row: usize) -> Result<(Table, Vec<(i64, i64)>), ImageError> {
        let depends_on = images.depends_on(row);
        let lengths: Vec<u32> = depends_on.iter().map(|&j| grid.axes()[j].cells()).collect();
        let entries: u64 = lengths.iter().map(|&n| u64::from(n)).product();
        let unshared = images.is_exact(row) && lengths.len() == grid.dimension();
        if entries > if unshared { LARGEST_UNSHARED } else { LARGEST } {
            return Ok((Table::Computed, computed(grid, images, row).into_iter().collect()));
        }
        let entry = |index: usize| {
            let mut cell = vec![0; grid.dimension()];
            let mut rest = index as u32;
            for (&j, length) in depends_on.iter().zip(&lengths).rev() {
                cell[j] = rest % length;
                rest /= length;
            }
            let range = SCRATCH.with_borrow_mut(|(scratch, _)| images.range(row, &cell, scratch))?;
            Ok((range.first, range.last))
        };
        let ranges: Vec<_> = (0..entries as usize).into_par_iter().map(entry).collect::<Result<_, _>>()?;
        let mut distinct = ranges.clone();
        distinct.par_sort_unstable();
        distinct.dedup();
        let mut stride = 1;
        let along = |(&j, &length): (&usize, &u32)| {
            let own = stride;
            stride *= length;
            (j, own)
        };
        let strides = depends_on.iter().zip(&lengths).rev().map(along).collect();
        let ranges = ranges.par_iter().map(|range| number(&distinct, range)).collect();
        Ok((Table::Stored { strides, ranges }, distinct))
    }

    /// From which to which sub-cell those ranges of a coordinate lead that occur.
    pub(super) fn extent(&self, coordinate: usize, occurs: &[bool]) -> (i64, i64) {
        let ranges = self.ranges[coordinate].iter().zip(occurs).filter(|(_, occurs)| **occurs);
        ranges.fold((i64::MAX, i64::MIN), |(first, last), (range, _)| (first.min(range.0), last.max(range.1)))
    }

    fn range(&self, row: usize, coordinate: usize, cell: &[u32], scratch: &mut ImageScratch) -> u32 {
        match &self.rows[row] {
            Table::Stored { strides, ranges } => {
                ranges[strides.iter().map(|&(j, stride)| (cell[j] * stride) as usize).sum::<usize>()]
            }
            Table::Computed => number(&self.ranges[coordinate], &anew(self.images, row, cell, scratch)),
        }
    }
}

/// What is undefined somewhere may lead anywhere.
fn anew(images: &ImageMap, row: usize, cell: &[u32], scratch: &mut ImageScratch) -> (i64, i64) {
    let range = images.range(row, cell, scratch).unwrap_or(LatticeRange::EVERYTHING);
    (range.first, range.last)
}

/// The ranges that a row has in any cell.
fn computed(grid: &Grid, images: &ImageMap, row: usize) -> BTreeSet<(i64, i64)> {
    let of_block = |mut ranges: BTreeSet<(i64, i64)>, cell: u32| {
        SCRATCH.with_borrow_mut(|(scratch, place)| {
            find(grid, cell, place);
            ranges.insert(anew(images, row, place, scratch));
        });
        ranges
    };
    let cells = (0..grid.num_cells()).into_par_iter().with_min_len(BLOCK);
    cells.fold(BTreeSet::new, of_block).reduce(BTreeSet::new, |mut a, mut b| {
        a.append(&mut b);
        a
    })
}

fn number(ranges: &[(i64, i64)], range: &(i64, i64)) -> u32 {
    ranges.binary_search(range).unwrap_or_default() as u32
}

/// Writes the place of a cell in every coordinate.
fn find(grid: &Grid, cell: u32, place: &mut Vec<u32>) {
    place.clear();
    place.extend((0..grid.dimension()).map(|j| grid.coordinate(CellId(cell), j)));
}

impl ImageSource for Tables<'_> {
    fn inputs(&self) -> usize {
        self.inputs
    }

    fn ranges(&self, coordinate: usize) -> &[(i64, i64)] {
        &self.ranges[coordinate]
    }

    fn image(&self, cell: u32, input: u32, out: &mut [u32]) -> bool {
        SCRATCH.with_borrow_mut(|(scratch, place)| {
            find(self.grid, cell, place);
            for (j, out) in out.iter_mut().enumerate() {
                *out = self.range(self.images.row(input as usize, j), j, place, scratch);
            }
        });
        true
    }
}
