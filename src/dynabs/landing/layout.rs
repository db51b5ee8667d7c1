//! Which extrema of landing values are computed in advance, and which when they are looked up.

use super::arrays::Arrays;
use super::axis::Axis;
use super::gather::Gather;
use super::image_source::{ImageSource, LandingError};
use super::side::Side;
use std::collections::BTreeSet;

/// An array of extrema in which images are looked up.
///
/// Images have a few ranges in each coordinate, which they share. Along the *gathered* axes the array has an entry for
/// each range: the extremum over it. Along the others it has one for each sub-cell, and a lookup goes through
/// the box of those. Axes are gathered one after the other, those first that become shorter, as long as it pays.
#[derive(Clone, Debug)]
pub struct Layout {
    axes: Vec<Line>,
    /// The axes that are gathered, in this order.
    gathers: Vec<Gather>,
    /// By shape: where the runs of a box begin, counted from its first place, and how long they are.
    runs: Vec<Vec<(u32, u32)>>,
    /// How many numbers the arrays have that exist at the same time, at most.
    numbers: u64,
}

/// One axis of the array.
#[derive(Clone, Debug)]
struct Line {
    /// The ranges of sub-cells: where they begin and how long they are, each once, ascending.
    places: Vec<(u32, u32)>,
    gathered: bool,
    /// How far apart neighbours are.
    stride: usize,
    /// The length: the number of places if gathered, of sub-cells if not.
    len: usize,
    /// The sizes of boxes along an axis that is not gathered.
    sizes: Vec<u32>,
    /// How many shapes later axes have.
    shapes_apart: u16,
    /// By range of the source: what it adds to the position, and to the number of the shape.
    of_range: Vec<(u32, u16)>,
}

/// Numbers of shapes fit 16 bits.
const MOST_SHAPES: usize = 1 << 16;

impl Layout {
    /// The layout for the ranges that occur, for about `pairs` lookups.
    ///
    /// # Errors
    /// [`LandingError`] if positions do not fit 32 bits.
    pub fn new(
        source: &impl ImageSource,
        occurs: &[Vec<bool>],
        axes: &[Axis],
        pairs: u64,
    ) -> Result<Self, LandingError> {
        let points = axes.iter().map(|axis| axis.len as u128).product();
        if points >= u128::from(u32::MAX) {
            return Err(LandingError::TooFine { points });
        }
        let place = |j: usize, range: usize| {
            let (first, last) = source.ranges(j)[range];
            let (first, size) = axes[j].place(first, last);
            (first as u32, size as u32)
        };
        let places = |j: usize| -> Vec<(u32, u32)> {
            let occurring = occurs[j].iter().enumerate().filter(|(_, occurs)| **occurs);
            occurring.map(|(range, _)| place(j, range)).collect::<BTreeSet<_>>().into_iter().collect()
        };
        let lines: Vec<Line> =
            axes.iter().enumerate().map(|(j, axis)| Line::new(places(j), axis.len)).collect();
        let mut layout = Self { axes: lines, gathers: vec![], runs: vec![], numbers: 0 };
        layout.choose(axes, pairs);
        layout.number();
        for (j, occurs) in occurs.iter().enumerate() {
            let number = |(range, &occurs): (usize, &bool)| {
                if occurs { layout.axes[j].number(place(j, range)) } else { (0, 0) }
            };
            layout.axes[j].of_range = occurs.iter().enumerate().map(number).collect();
        }
        Ok(layout)
    }

    /// Decides which axes are gathered.
    fn choose(&mut self, axes: &[Axis], pairs: u64) {
        let mut order: Vec<usize> = (0..axes.len()).collect();
        let growth = |&j: &usize| self.axes[j].places.len() as f64 / axes[j].len as f64;
        // Boxes along periodic axes do not lie at fixed distances from their first place.
        order.sort_by(|a, b| axes[*b].periodic.cmp(&axes[*a].periodic).then(growth(a).total_cmp(&growth(b))));
        let needed = axes.iter().filter(|axis| axis.periodic).count();
        let costs = (needed..=order.len()).map(|count| (self.cost(&order[..count], pairs), count));
        let best = costs.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(order.len(), |(_, count)| count);
        self.numbers = 2 * axes.iter().map(|axis| axis.len as u64).product::<u64>();
        for &j in &order[..best] {
            let shape = |lines: &[Line]| lines.iter().map(|line| line.len).collect::<Vec<_>>();
            let before = shape(&self.axes);
            let line = &mut self.axes[j];
            line.gathered = true;
            line.len = line.places.len();
            self.gathers.push(Gather::new(j, &before, axes[j].periodic, line.places.clone()));
            let numbers = |shape: &[usize]| shape.iter().map(|&n| n as u64).product::<u64>();
            self.numbers = self.numbers.max(numbers(&before) + numbers(&shape(&self.axes)));
        }
    }

    /// About how long it takes to gather these axes and look the images up, in reads of a number.
    fn cost(&self, gathered: &[usize], pairs: u64) -> f64 {
        let mut numbers: f64 = self.axes.iter().map(|line| line.len as f64).product();
        let (mut cost, mut shapes, mut scanned) = (0.0, 1, 1.0);
        for &j in gathered {
            let line = &self.axes[j];
            numbers *= line.places.len() as f64 / line.len as f64;
            // Rows next to each other are read several numbers at a time.
            cost += 0.5 * numbers * line.mean_size().min(8.0);
        }
        for line in self.axes.iter().enumerate().filter(|(j, _)| !gathered.contains(j)).map(|(_, line)| line)
        {
            scanned *= line.mean_size();
            shapes *= line.sizes.len().max(1);
        }
        if numbers >= f64::from(u32::MAX) || shapes > MOST_SHAPES {
            return f64::INFINITY;
        }
        cost + pairs as f64 * (2.0 + 1.5 * (scanned - 1.0))
    }

    /// Gives every place of an axis its share of a position.
    fn number(&mut self) {
        let (mut stride, mut shapes) = (1, 1);
        for line in self.axes.iter_mut().rev() {
            line.stride = stride;
            stride *= line.len;
            line.shapes_apart = shapes as u16;
            shapes *= if line.gathered { 1 } else { line.sizes.len().max(1) };
        }
        self.runs = (0..shapes).map(|shape| self.runs_of(shape as u16)).collect();
    }

    /// The number of coordinates.
    pub(super) fn dimension(&self) -> usize {
        self.axes.len()
    }

    /// Whether there are boxes of different shapes.
    pub(super) fn has_shapes(&self) -> bool {
        self.runs.len() > 1
    }

    /// Whether there is more to look at than the entry at the position of an image.
    pub(super) fn is_scanned(&self) -> bool {
        self.runs.iter().flatten().any(|&run| run != (0, 1))
    }

    /// Bytes of the arrays that a step needs.
    pub(super) fn bytes(&self) -> u64 {
        8 * self.numbers
    }

    /// The position and the shape of an image, given by the numbers of its ranges.
    pub(super) fn place(&self, image: &[u32]) -> (u32, u16) {
        let shares = self.axes.iter().zip(image).map(|(line, &range)| line.of_range[range as usize]);
        shares.fold((0, 0), |(at, shape), (a, b)| (at + a, shape + b))
    }

    /// The box of an image, by coordinate: the position of its first sub-cell and how many it has.
    pub(super) fn sub_cells(&self, at: u32, shape: u16) -> Vec<(u32, u32)> {
        let of_line = |line: &Line| {
            let index = at as usize / line.stride % line.len;
            if line.gathered { line.places[index] } else { (index as u32, line.size(shape)) }
        };
        self.axes.iter().map(of_line).collect()
    }

    /// The runs of a box: the last axis along which places are next to each other makes them long.
    fn runs_of(&self, shape: u16) -> Vec<(u32, u32)> {
        let mut runs = vec![(0u32, 1u32)];
        for line in self.axes.iter().filter(|line| !line.gathered) {
            let size = line.size(shape);
            if line.stride == 1 {
                runs.iter_mut().for_each(|run| run.1 = size);
            } else {
                let stride = line.stride as u32;
                let along =
                    |&(from, length): &(u32, u32)| (0..size).map(move |k| (from + k * stride, length));
                runs = runs.iter().flat_map(along).collect();
            }
        }
        runs
    }

    /// The array, from the values of all sub-cells.
    pub(super) fn gather<S: Side>(&self, values: Vec<f64>, arrays: &Arrays) -> Vec<f64> {
        self.gathers.iter().fold(values, |values, gather| {
            let gathered = gather.apply::<S>(&values, arrays);
            arrays.keep(values);
            gathered
        })
    }

    /// The extremum over an image.
    pub(super) fn extremum<S: Side>(&self, array: &[f64], (at, shape): (u32, u16)) -> f64 {
        let mut best = array[at as usize];
        for &(from, length) in &self.runs[shape as usize] {
            let from = (at + from) as usize;
            array[from..from + length as usize].iter().for_each(|&value| best = S::of(best, value));
        }
        best
    }
}

impl Line {
    fn new(places: Vec<(u32, u32)>, len: usize) -> Self {
        let sizes: BTreeSet<u32> = places.iter().map(|(_, size)| *size).collect();
        Self {
            places,
            gathered: false,
            stride: 1,
            len,
            sizes: sizes.into_iter().collect(),
            shapes_apart: 1,
            of_range: vec![],
        }
    }

    fn mean_size(&self) -> f64 {
        let sum: f64 = self.places.iter().map(|(_, size)| f64::from(*size)).sum();
        if self.places.is_empty() { 1.0 } else { sum / self.places.len() as f64 }
    }

    /// The size of a box of some shape along this axis, which is not gathered.
    fn size(&self, shape: u16) -> u32 {
        let index = (shape / self.shapes_apart) as usize % self.sizes.len().max(1);
        self.sizes.get(index).copied().unwrap_or(1)
    }

    /// What a place adds to the position and the number of the shape.
    fn number(&self, place: (u32, u32)) -> (u32, u16) {
        if self.gathered {
            let index = self.places.binary_search(&place).unwrap_or_default();
            return ((index * self.stride) as u32, 0);
        }
        let size = self.sizes.binary_search(&place.1).unwrap_or_default();
        (place.0 * self.stride as u32, size as u16 * self.shapes_apart)
    }
}
