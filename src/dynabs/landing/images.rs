//! Where the images of all cells and inputs lie on the lattice.

use super::arrays::Arrays;
use super::axis::Axis;
use super::image_source::ImageSource;
use super::layout::Layout;
use super::side::Side;
use imdp::ranks::Share;
use imdp::solver::NO_CHOICE;
use rayon::prelude::*;

/// The images of a set of cells.
///
/// An image is a position in an array of extrema, and the shape of the box that is still to be looked at from there:
/// see [`Layout`].
#[derive(Clone, Debug)]
pub struct Images {
    inputs: usize,
    /// The cells, ascending.
    cells: Vec<u32>,
    /// By cell, by input: the position, or [`NOWHERE`].
    at: Vec<u32>,
    /// By cell, by input: the shape; nothing if there is only one.
    shapes: Vec<u16>,
    layout: Layout,
}

/// What an input that is not enabled has for a position.
const NOWHERE: u32 = u32::MAX;

/// What is stored of an image.
const BYTES_OF_IMAGE: u64 = 6;

/// How many cells one task looks at.
const BLOCK: usize = 1 << 12;

/// Which ranges occur in the images of some cells, by coordinate.
pub fn occurring(source: &impl ImageSource, cells: &[u32], dimension: usize) -> Vec<Vec<bool>> {
    let none = || -> Vec<Vec<bool>> { (0..dimension).map(|j| vec![false; source.ranges(j).len()]).collect() };
    let of_block = |mut occurs: Vec<Vec<bool>>, block: &[u32]| {
        let mut image = vec![0; dimension];
        for &cell in block {
            for input in 0..source.inputs() as u32 {
                if source.image(cell, input, &mut image) {
                    occurs.iter_mut().zip(&image).for_each(|(occurs, &range)| occurs[range as usize] = true);
                }
            }
        }
        occurs
    };
    let join = |mut a: Vec<Vec<bool>>, b: Vec<Vec<bool>>| {
        a.iter_mut().zip(b).for_each(|(a, b)| a.iter_mut().zip(b).for_each(|(a, b)| *a |= b));
        a
    };
    cells.par_chunks(BLOCK).fold(none, of_block).reduce(none, join)
}

impl Images {
    /// Bytes that the images of so many cells under all inputs need, and the arrays of a step.
    pub fn bytes(layout: &Layout, cells: usize, inputs: usize) -> u64 {
        BYTES_OF_IMAGE * cells as u64 * inputs as u64 + layout.bytes()
    }

    /// The images of `cells`, ascending.
    pub fn new(source: &impl ImageSource, cells: &[u32], layout: Layout) -> Self {
        let inputs = source.inputs();
        let many = layout.has_shapes();
        let mut at = vec![NOWHERE; cells.len() * inputs];
        let mut shapes = vec![0; if many { at.len() } else { 0 }];
        let fill = |cells: &[u32], at: &mut [u32], mut shapes: Option<&mut [u16]>| {
            let mut image = vec![0; layout.dimension()];
            let pairs = cells.iter().flat_map(|&cell| (0..inputs as u32).map(move |input| (cell, input)));
            for (i, (cell, input)) in pairs.enumerate() {
                if source.image(cell, input, &mut image) {
                    let (position, shape) = layout.place(&image);
                    at[i] = position;
                    if let Some(shapes) = &mut shapes {
                        shapes[i] = shape;
                    }
                }
            }
        };
        let share = Share::new(cells.len(), at.len() * layout.dimension());
        let own = share.own();
        let of_own = own.start * inputs..own.end * inputs;
        let blocks = cells[own].par_chunks(BLOCK).zip(at[of_own.clone()].par_chunks_mut(BLOCK * inputs));
        if many {
            let blocks = blocks.zip(shapes[of_own].par_chunks_mut(BLOCK * inputs));
            blocks.for_each(|((cells, at), shapes)| fill(cells, at, Some(shapes)));
        } else {
            blocks.for_each(|(cells, at)| fill(cells, at, None));
        }
        share.complete(&mut at);
        share.complete(&mut shapes);
        Self { inputs, cells: cells.to_vec(), at, shapes, layout }
    }

    /// The number of inputs.
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// The cells in which some input is enabled, ascending.
    pub fn acting(&self) -> Vec<u32> {
        let cells = self.cells.iter().zip(self.at.chunks(self.inputs));
        cells.filter(|(_, at)| at.iter().any(|&at| at != NOWHERE)).map(|(&cell, _)| cell).collect()
    }

    /// The number of enabled pairs of cell and input.
    pub fn len(&self) -> usize {
        self.at.iter().filter(|&&at| at != NOWHERE).count()
    }

    /// Whether nothing is enabled anywhere.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Whether some image of an enabled pair has a sub-cell that belongs to a cell.
    pub fn some_meet_cells(&self, axes: &[Axis]) -> bool {
        self.all().any(|(.., image)| {
            let sides = self.sub_cells(image);
            axes.iter().zip(sides).all(|(axis, (first, size))| {
                let first = axis.first + i64::from(first);
                axis.periodic || first + i64::from(size) > 0 && first < axis.sub_cells()
            })
        })
    }

    /// The images of all enabled pairs, by cell and input: the cell, the input, and what [`Images::sub_cells`] takes.
    pub(super) fn all(&self) -> impl Iterator<Item = (u32, u32, (u32, u16))> + '_ {
        let pair = |i: usize| (self.cells[i / self.inputs], (i % self.inputs) as u32, self.image(i));
        (0..self.at.len()).filter(|&i| self.at[i] != NOWHERE).map(pair)
    }

    /// The box of an image, by coordinate: the position of its first sub-cell and how many it has.
    pub(super) fn sub_cells(&self, (at, shape): (u32, u16)) -> Vec<(u32, u32)> {
        self.layout.sub_cells(at, shape)
    }

    fn image(&self, i: usize) -> (u32, u16) {
        (self.at[i], self.shapes.get(i).copied().unwrap_or_default())
    }

    /// The extrema over some images, given the values of all sub-cells.
    pub(super) fn extrema<S: Side>(
        &self,
        landed: Vec<f64>,
        images: &[(u32, u16)],
        arrays: &Arrays,
    ) -> Vec<f64> {
        let worth = self.layout.gather::<S>(landed, arrays);
        let of_image = |&image: &(u32, u16)| self.layout.extremum::<S>(&worth, image);
        let extrema = images.par_iter().with_min_len(BLOCK).map(of_image).collect();
        arrays.keep(worth);
        extrema
    }

    /// The extrema over all images, given the values of all sub-cells: by cell, the greatest over its inputs and the
    /// first input that has it.
    pub(super) fn best<S: Side>(
        &self,
        landed: Vec<f64>,
        arrays: &Arrays,
        mut note: impl FnMut(u32, f64, u32),
    ) {
        let worth = self.layout.gather::<S>(landed, arrays);
        let scanned = self.layout.is_scanned();
        let of_cell = |c: usize| {
            let mut best: Option<(f64, u32)> = None;
            let first = c * self.inputs;
            for (input, &at) in (0..).zip(&self.at[first..first + self.inputs]) {
                if at == NOWHERE {
                    continue;
                }
                let value = match scanned {
                    true => self.layout.extremum::<S>(&worth, self.image(first + input as usize)),
                    false => worth[at as usize],
                };
                if best.is_none_or(|(greatest, _)| value > greatest) {
                    best = Some((value, input));
                }
            }
            best
        };
        let cells = self.cells.len();
        let share = Share::new(cells, self.at.len());
        let (mut values, mut inputs) = (vec![0.0; cells], vec![NO_CHOICE; cells]);
        let both = values[share.own()].par_iter_mut().zip(&mut inputs[share.own()]);
        both.zip(share.own()).with_min_len(BLOCK / 8).for_each(|((value, input), cell)| {
            if let Some(best) = of_cell(cell) {
                (*value, *input) = best;
            }
        });
        share.complete(&mut values);
        share.complete(&mut inputs);
        for ((&cell, value), input) in self.cells.iter().zip(values).zip(inputs) {
            if input != NO_CHOICE {
                note(cell, value, input);
            }
        }
        arrays.keep(worth);
    }
}
