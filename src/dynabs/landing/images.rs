//! Where the images of all cells and inputs lie on the lattice: a position and a size each.

use super::axis::Axis;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// The box of sub-cells of one image: its first and last sub-cell in every coordinate.
pub type SubCells = [(i64, i64)];

/// Where a cell goes under an input.
pub trait ImageSource: Sync {
    /// The number of inputs.
    fn inputs(&self) -> usize;

    /// Writes the sub-cells that contain the image of a cell under an input, unwrapped; `false` if the input is not
    /// enabled there.
    fn image(&self, cell: u32, input: u32, out: &mut SubCells) -> bool;
}

/// All images of one size.
#[derive(Clone, Debug)]
pub struct SizeClass {
    /// The number of sub-cells in every coordinate.
    pub size: Vec<u32>,
    /// `cell · inputs + input`, ascending.
    pub of: Vec<u32>,
    /// The position of the first sub-cell in the array of landing values.
    pub at: Vec<u32>,
}

/// The images of a set of cells, by size.
#[derive(Clone, Debug)]
pub struct Images {
    inputs: u32,
    classes: Vec<SizeClass>,
}

/// Why images cannot be stored.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LandingError {
    /// Cells and inputs are too many to be numbered together.
    #[error("{cells} cells and {inputs} inputs are too many together; at most {} pairs", u32::MAX)]
    TooManyPairs {
        /// The number of cells.
        cells: u64,
        /// The number of inputs.
        inputs: u64,
    },
    /// The lattice has too many points.
    #[error(
        "a lattice of {points} sub-cells in which images and noise land is too fine; at most {}",
        u32::MAX
    )]
    TooFine {
        /// The number of sub-cells that are looked at.
        points: u128,
    },
}

/// How many cells one task looks at.
const BLOCK: usize = 1 << 12;

impl Images {
    /// The least and greatest sub-cells that images of `cells` touch.
    pub fn extent(source: &impl ImageSource, cells: &[u32], dimension: usize) -> Vec<(i64, i64)> {
        let none = || vec![(i64::MAX, i64::MIN); dimension];
        let join = |mut a: Vec<(i64, i64)>, b: Vec<(i64, i64)>| {
            a.iter_mut().zip(b).for_each(|(a, b)| *a = (a.0.min(b.0), a.1.max(b.1)));
            a
        };
        let of_block = |block: &[u32]| {
            let (mut all, mut image) = (none(), vec![(0, 0); dimension]);
            for &cell in block {
                for input in 0..source.inputs() as u32 {
                    if source.image(cell, input, &mut image) {
                        all.iter_mut().zip(&image).for_each(|(a, b)| *a = (a.0.min(b.0), a.1.max(b.1)));
                    }
                }
            }
            all
        };
        cells.par_chunks(BLOCK).map(of_block).reduce(none, join)
    }

    /// The images of `cells`, ascending, on a lattice with these axes.
    ///
    /// # Errors
    /// [`LandingError`] if positions or pairs do not fit 32 bits.
    pub fn new(source: &impl ImageSource, cells: &[u32], axes: &[Axis]) -> Result<Self, LandingError> {
        let inputs = source.inputs() as u32;
        let last = cells.last().map_or(0, |&cell| u64::from(cell));
        if (last + 1) * u64::from(inputs) > u64::from(u32::MAX) {
            return Err(LandingError::TooManyPairs { cells: last + 1, inputs: inputs.into() });
        }
        let points = axes.iter().map(|axis| axis.len as u128).product();
        if points > u128::from(u32::MAX) {
            return Err(LandingError::TooFine { points });
        }
        let mut classes: BTreeMap<Vec<u32>, (Vec<u32>, Vec<u32>)> = BTreeMap::new();
        // A few blocks at a time: what is found is soon where it belongs.
        for blocks in cells.chunks(64 * BLOCK) {
            let found: Vec<_> = blocks.par_chunks(BLOCK).map(|block| in_block(source, block, axes)).collect();
            for (size, of, at) in found.into_iter().flatten() {
                let class = classes.entry(size).or_default();
                class.0.extend_from_slice(&of);
                class.1.extend_from_slice(&at);
            }
        }
        let classes = classes.into_iter().map(|(size, (of, at))| SizeClass { size, of, at }).collect();
        Ok(Self { inputs, classes })
    }

    /// The number of inputs.
    pub fn inputs(&self) -> u32 {
        self.inputs
    }

    /// The images by size, sizes in lexicographic order.
    pub fn classes(&self) -> &[SizeClass] {
        &self.classes
    }

    /// The cells in which some input is enabled, ascending.
    pub fn acting(&self) -> Vec<u32> {
        let mut cells: Vec<u32> = vec![];
        for class in &self.classes {
            let mut own: Vec<u32> = class.of.iter().map(|pair| pair / self.inputs).collect();
            own.dedup();
            cells.append(&mut own);
        }
        cells.sort_unstable();
        cells.dedup();
        cells
    }

    /// The number of enabled pairs of cell and input.
    pub fn len(&self) -> usize {
        self.classes.iter().map(|class| class.of.len()).sum()
    }

    /// Whether nothing is enabled anywhere.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

type Found = Vec<(Vec<u32>, Vec<u32>, Vec<u32>)>;

fn in_block(source: &impl ImageSource, block: &[u32], axes: &[Axis]) -> Found {
    let mut classes: BTreeMap<Vec<u32>, usize> = BTreeMap::new();
    let mut found: Found = vec![];
    let (mut image, mut size) = (vec![(0, 0); axes.len()], vec![0; axes.len()]);
    for &cell in block {
        for input in 0..source.inputs() as u32 {
            if !source.image(cell, input, &mut image) {
                continue;
            }
            let mut at = 0;
            for (j, axis) in axes.iter().enumerate() {
                let (first, length) = axis.place(image[j].0, image[j].1);
                at = at * axis.len + first;
                size[j] = length as u32;
            }
            let class = match classes.get(&size) {
                Some(&class) => class,
                None => {
                    classes.insert(size.clone(), found.len());
                    found.push((size.clone(), vec![], vec![]));
                    found.len() - 1
                }
            };
            found[class].1.push(cell * source.inputs() as u32 + input);
            found[class].2.push(at as u32);
        }
    }
    found
}
