//! The points that actions steer to.

use crate::partition::{Grid, GridAxis};
use crate::problem::{TargetId, TargetPoints};
use imdp::model::RowId;
use imdp::numeric::{Rational, to_f64};
use num_traits::ToPrimitive;

/// The target points `d_a`, numbered from 0; the action of the same number steers there.
#[derive(Clone, Debug)]
pub struct Targets {
    dimension: usize,
    layout: Layout,
    /// Targets that stand there again, after all others: with a row of their own.
    again: Vec<TargetId>,
}

#[derive(Clone, Debug)]
enum Layout {
    /// All combinations of coordinates, numbered row-major, with the cells of the coordinates.
    Lattice { axes: Vec<Vec<f64>>, cells: Vec<Vec<i32>>, alignment: Option<Vec<Alignment>> },
    /// Any points, one after the other, and the coordinates of their cells.
    List { points: Vec<f64>, cells: Vec<i32> },
}

/// How the targets of one dimension sit in the cells of the partition.
#[derive(Clone, Debug, PartialEq)]
pub struct Alignment {
    /// The cell of the first target.
    pub first_cell: u32,
    /// How many cells apart neighbouring targets are.
    pub stride: u32,
    /// Where in its cell every target sits: 0 at the lower face, ½ at the center.
    pub phase: Rational,
}

impl Targets {
    /// The targets of a problem on its partition.
    pub fn new(points: &TargetPoints, partition: &Grid) -> Self {
        let lattice = |grid: &Grid| Layout::Lattice {
            axes: grid.axes().iter().map(|axis| axis.centers()).collect(),
            cells: (grid.axes().iter().zip(partition.axes()))
                .map(|(own, axis)| (0..own.cells()).map(|i| cell_along(axis, &own.center(i))).collect())
                .collect(),
            alignment: align(grid, partition),
        };
        let layout = match points {
            TargetPoints::Centers => lattice(partition),
            TargetPoints::Grid(grid) => lattice(grid),
            TargetPoints::List(points) => Layout::List {
                points: points.iter().flatten().map(to_f64).collect(),
                cells: (points.iter())
                    .flat_map(|point| point.iter().zip(partition.axes()))
                    .map(|(x, axis)| cell_along(axis, x))
                    .collect(),
            },
        };
        Self { dimension: partition.dimension(), layout, again: vec![] }
    }

    /// These targets and, after them, some of them again.
    pub(super) fn standing_again(&self, again: Vec<TargetId>) -> Self {
        Self { again, ..self.clone() }
    }

    /// The target that a number stands for: itself, but for targets that stand there again.
    pub(super) fn original(&self, target: TargetId) -> TargetId {
        self.copy(target).map_or(target, |copy| self.again[copy])
    }

    /// The how manieth of those that stand there again it is, if it is one.
    pub(super) fn copy(&self, target: TargetId) -> Option<usize> {
        target.index().checked_sub(self.num_originals())
    }

    /// All of them, ascending.
    pub fn ids(&self) -> impl ExactSizeIterator<Item = TargetId> + use<> {
        (0..self.len() as u32).map(TargetId)
    }

    /// What a row is for if there is one for every memory and target, memory after memory: the place of the memory, and the
    /// target.
    pub(super) fn of_row(&self, row: RowId) -> (usize, TargetId) {
        let targets = self.len().max(1);
        (row.index() / targets, TargetId::from_index(row.index() % targets))
    }

    /// The number of different targets.
    pub(super) fn num_originals(&self) -> usize {
        match &self.layout {
            Layout::Lattice { axes, .. } => axes.iter().map(Vec::len).product(),
            Layout::List { points, .. } => points.len() / self.dimension,
        }
    }

    /// The number of targets, with those that stand there again.
    pub fn len(&self) -> usize {
        self.num_originals() + self.again.len()
    }

    /// Whether there are no targets.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The dimension of the state space.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The coordinates of the targets per dimension, if all their combinations are targets.
    pub fn axes(&self) -> Option<&[Vec<f64>]> {
        match &self.layout {
            Layout::Lattice { axes, .. } => Some(axes),
            Layout::List { .. } => None,
        }
    }

    /// How the targets sit in the partition, if all of them do so in the same way.
    pub fn alignment(&self) -> Option<&[Alignment]> {
        match &self.layout {
            Layout::Lattice { alignment, .. } => alignment.as_deref(),
            Layout::List { .. } => None,
        }
    }

    /// The cells of the targets' coordinates per dimension, if all their combinations are targets.
    pub(super) fn cells_along_axes(&self) -> Option<&[Vec<i32>]> {
        match &self.layout {
            Layout::Lattice { cells, .. } => Some(cells),
            Layout::List { .. } => None,
        }
    }

    /// Writes the coordinates of a target into `point`.
    pub fn point(&self, target: TargetId, point: &mut [f64]) {
        let target = self.original(target).index();
        match &self.layout {
            Layout::Lattice { axes, .. } => {
                let mut rest = target;
                for (x, axis) in point.iter_mut().zip(axes).rev() {
                    *x = axis[rest % axis.len()];
                    rest /= axis.len();
                }
            }
            Layout::List { points, .. } => {
                point.copy_from_slice(&points[target * self.dimension..(target + 1) * self.dimension]);
            }
        }
    }

    /// Writes the coordinates of the cell that contains a target into `cell`: decided exactly, whatever the samples.
    ///
    /// −1 and the number of cells stand for what lies below and above the partition.
    pub fn cell(&self, target: TargetId, cell: &mut [i32]) {
        let target = self.original(target).index();
        match &self.layout {
            Layout::Lattice { cells, .. } => {
                let mut rest = target;
                for (index, axis) in cell.iter_mut().zip(cells).rev() {
                    *index = axis[rest % axis.len()];
                    rest /= axis.len();
                }
            }
            Layout::List { cells, .. } => {
                cell.copy_from_slice(&cells[target * self.dimension..(target + 1) * self.dimension]);
            }
        }
    }

    /// `max |d_j|` over all targets, per dimension.
    pub fn magnitudes(&self) -> Vec<f64> {
        let mut magnitudes = vec![0.0f64; self.dimension];
        match &self.layout {
            Layout::Lattice { axes, .. } => {
                for (magnitude, axis) in magnitudes.iter_mut().zip(axes) {
                    *magnitude = axis.iter().fold(0.0, |m, x| m.max(x.abs()));
                }
            }
            Layout::List { points, .. } => {
                for (i, x) in points.iter().enumerate() {
                    let magnitude = &mut magnitudes[i % self.dimension];
                    *magnitude = magnitude.max(x.abs());
                }
            }
        }
        magnitudes
    }
}

/// The index of the cell that contains `x`, or −1 below the partition and the number of cells above it.
fn cell_along(axis: &GridAxis, x: &Rational) -> i32 {
    let outside = if x < axis.lower() { -1 } else { axis.cells() as i32 };
    axis.locate(x).map_or(outside, |index| index as i32)
}

fn align(grid: &Grid, partition: &Grid) -> Option<Vec<Alignment>> {
    let lattice = grid.lattice_in(partition)?;
    lattice
        .into_iter()
        .map(|(first, stride)| {
            let cell = first.floor();
            let first_cell = cell.to_integer().to_u32()?;
            Some(Alignment { first_cell, stride, phase: first - cell })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use imdp::numeric::from_decimal;

    #[test]
    fn centers_are_aligned() {
        let exact = |values: &[f64]| values.iter().map(|&x| from_decimal(x).unwrap()).collect::<Vec<_>>();
        let grid = Grid::new(&exact(&[-1.0, 0.0]), &exact(&[1.0, 3.0]), &[2, 3]).unwrap();
        let targets = Targets::new(&TargetPoints::Centers, &grid);
        assert_eq!(targets.len(), 6);
        let mut point = [0.0; 2];
        targets.point(TargetId(4), &mut point);
        assert_eq!(point, [0.5, 1.5]);
        let alignment = targets.alignment().unwrap();
        assert!(alignment.iter().all(|a| a.stride == 1 && a.phase == Rational::new(1.into(), 2.into())));
        let mut cell = [0; 2];
        targets.cell(TargetId(4), &mut cell);
        assert_eq!(cell, [1, 1]);
    }

    #[test]
    fn cells_of_points_are_exact() {
        let exact = |values: &[f64]| values.iter().map(|&x| from_decimal(x).unwrap()).collect::<Vec<_>>();
        let grid = Grid::new(&exact(&[-3.4]), &exact(&[1.0]), &[11]).unwrap();
        // In doubles −0.2 is below the face −3.4 + 8 · 0.4.
        let points = [-0.2, -0.200_000_001, 1.0, -3.5].map(|x| exact(&[x]));
        let targets = Targets::new(&TargetPoints::List(points.to_vec()), &grid);
        let mut cell = [0];
        for (target, expected) in targets.ids().zip([8, 7, 11, -1]) {
            targets.cell(target, &mut cell);
            assert_eq!(cell, [expected]);
        }
    }
}
