//! Images of cells: where the dynamics take all states of a cell under one input.

mod affine_row;
mod enclosure;
mod error;
mod lattice;
#[cfg(test)]
mod tests;

pub use error::ImageError;
pub use lattice::{Lattice, LatticeRange};

use super::expression::{Graph, NodeId, Tape};
use super::{Feedback, Interval, Mode};
use crate::linear_algebra::ExactMatrix;
use crate::partition::Grid;
use affine_row::{AffineImage, AffineRow, exact_ends};
use enclosure::{Direction, Enclosure, Follower, Scratch, Undefined, VariableBox};
use imdp::numeric::Rational;
use num_traits::{Signed, Zero};
use std::collections::HashMap;

/// The images of the cells of a grid under a list of inputs with local feedback:
/// `M(s, a) ⊇ {f(x, ū − K(x − c), θ) : x ∈ s, θ ∈ Θ}` as a box of lattice sub-cells.
///
/// A box is a product of one range per state coordinate. The range of coordinate `j` under input `a` is a
/// *row*: a function of the cell. Rows depend on few coordinates of the cell, and many inputs share one (the
/// heading of a car does not depend on its speed), so whatever is stored is stored per row.
///
/// Rows that are affine functions of the state are exact, in integers; others are enclosed by the natural
/// extension, the mean-value form and monotonicity, intersected, on parts of the cell where that helps.
#[derive(Clone, Debug)]
pub struct ImageMap {
    graph: Graph,
    states: Vec<String>,
    rows: Vec<Row>,
    /// Input by input, coordinate by coordinate.
    row_of: Vec<u32>,
    lattice: Lattice,
    faces: Vec<AxisFaces>,
}

/// Scratch space for computing images; one per thread.
#[derive(Clone, Debug, Default)]
pub struct ImageScratch {
    scratch: Scratch,
}

#[derive(Clone, Debug)]
struct Row {
    coordinate: usize,
    depends_on: Vec<usize>,
    kind: RowKind,
}

#[derive(Clone, Debug)]
enum RowKind {
    Affine(AffineRow),
    /// The enclosure, and the box of the variables other than states.
    Enclosed(Box<Enclosure>, VariableBox),
}

/// The faces and centers of one dimension of the grid, enclosed.
#[derive(Clone, Debug)]
struct AxisFaces {
    cells: Vec<Interval>,
    centers: Vec<Interval>,
}

impl ImageMap {
    /// Prepares the images of the cells of `grid` under `mode`, for each of `inputs`.
    pub fn new(
        mode: &Mode,
        feedback: &Feedback,
        grid: &Grid,
        lattice: Lattice,
        inputs: &[Vec<Rational>],
    ) -> Self {
        let mut builder = Builder { graph: mode.graph().clone(), mode, feedback, grid, lattice: &lattice };
        let mut rows = Vec::new();
        let mut row_of = Vec::with_capacity(inputs.len() * grid.dimension());
        let mut known: HashMap<(usize, NodeId, Vec<Rational>), u32> = HashMap::new();
        for input in inputs {
            for coordinate in 0..grid.dimension() {
                let root = builder.with_input(mode.next()[coordinate], input);
                let nominal = builder.nominal(root, input);
                let row = *known.entry((coordinate, root, nominal)).or_insert_with(|| {
                    rows.push(builder.row(coordinate, root, input));
                    rows.len() as u32 - 1
                });
                row_of.push(row);
            }
        }
        let faces = grid.axes().iter().map(|axis| AxisFaces {
            cells: (0..axis.cells()).map(|i| Interval::enclosing(&axis.face(i), &axis.face(i + 1))).collect(),
            centers: (0..axis.cells()).map(|i| Interval::of_rational(&axis.center(i))).collect(),
        });
        let faces = faces.collect();
        Self {
            graph: builder.graph,
            states: mode.states().iter().map(|state| state.name.clone()).collect(),
            rows,
            row_of,
            lattice,
            faces,
        }
    }

    /// The number of different rows.
    pub fn num_rows(&self) -> usize {
        self.rows.len()
    }

    /// The row of a coordinate under an input.
    pub fn row(&self, input: usize, coordinate: usize) -> usize {
        self.row_of[input * self.faces.len() + coordinate] as usize
    }

    /// The coordinates of the cell that a row depends on, ascending.
    pub fn depends_on(&self, row: usize) -> &[usize] {
        &self.rows[row].depends_on
    }

    /// Whether a row is computed exactly, by a few integer operations.
    pub fn is_exact(&self, row: usize) -> bool {
        matches!(self.rows[row].kind, RowKind::Affine(_))
    }

    /// The coordinate of the next state that a row is about.
    pub fn coordinate(&self, row: usize) -> usize {
        self.rows[row].coordinate
    }

    /// The sub-cells that the image of `cell` (its index in every dimension) meets, in the row's coordinate.
    ///
    /// # Errors
    /// [`ImageError`] if the dynamics are undefined or unbounded somewhere in the cell.
    pub fn range(
        &self,
        row: usize,
        cell: &[u32],
        scratch: &mut ImageScratch,
    ) -> Result<LatticeRange, ImageError> {
        let Row { coordinate, kind, .. } = &self.rows[row];
        match kind {
            RowKind::Affine(row) => Ok(row.range(cell)),
            RowKind::Enclosed(enclosure, domain) => {
                let mut domain = domain.clone();
                for (k, faces) in self.faces.iter().enumerate() {
                    domain.values[k] = faces.cells[cell[k] as usize];
                    domain.centers[k] = faces.centers[cell[k] as usize];
                }
                let axis = self.lattice.axis(*coordinate);
                enclosure
                    .range(&self.graph, &domain, axis, &mut scratch.scratch)
                    .map_err(|undefined| self.error(*coordinate, cell, &undefined))
            }
        }
    }

    fn error(&self, coordinate: usize, cell: &[u32], undefined: &Undefined) -> ImageError {
        let (found, expected) = error::explained(self.graph.node(undefined.node), undefined.operand);
        let sides: Vec<_> = self.faces.iter().zip(cell).map(|(faces, &i)| faces.cells[i as usize]).collect();
        let sides: Vec<_> =
            sides.iter().map(|side| format!("[{}, {}]", side.lower(), side.upper())).collect();
        ImageError {
            state: self.states[coordinate].clone(),
            place: self.graph.place(undefined.node).map(|(text, column)| (text.to_owned(), column)),
            cell: sides.join("×"),
            found,
            expected,
        }
    }
}

/// What rows are made from.
struct Builder<'a> {
    graph: Graph,
    mode: &'a Mode,
    feedback: &'a Feedback,
    grid: &'a Grid,
    lattice: &'a Lattice,
}

impl Builder<'_> {
    fn states(&self) -> usize {
        self.mode.num_states()
    }

    /// Whether feedback makes an input vary over a cell.
    fn varies(&self, input: usize) -> bool {
        (0..self.states()).any(|k| !self.feedback.gain().get(input, k).is_zero())
    }

    /// `root` with the inputs that do not vary over a cell replaced by their values.
    fn with_input(&mut self, root: NodeId, input: &[Rational]) -> NodeId {
        let mut replacements = vec![None; self.states()];
        for (i, value) in input.iter().enumerate() {
            replacements.push((!self.varies(i)).then(|| self.graph.constant(value.clone())));
        }
        self.graph.substitute(root, &replacements)
    }

    /// The nominal values of the inputs that `root` still depends on.
    fn nominal(&self, root: NodeId, input: &[Rational]) -> Vec<Rational> {
        let variables = Tape::new(&self.graph, &[root]).variables();
        let occurs = |i: usize| variables.contains(&((self.states() + i) as u32));
        input.iter().enumerate().filter(|(i, _)| occurs(*i)).map(|(_, value)| value.clone()).collect()
    }

    fn row(&mut self, coordinate: usize, root: NodeId, input: &[Rational]) -> Row {
        let axis = self.lattice.axis(coordinate);
        let cells: Vec<u32> = self.grid.axes().iter().map(|axis| axis.cells()).collect();
        let affine = self.affine_image(root, input);
        if let Some(row) = affine.and_then(|image| AffineRow::new(&image, axis, &cells)) {
            return Row { coordinate, depends_on: row.depends_on(), kind: RowKind::Affine(row) };
        }
        let directions = self.directions(root);
        let enclosure = Enclosure::new(&mut self.graph, root, directions);
        let (n, p) = (self.states(), input.len());
        let mut depends_on: Vec<usize> =
            enclosure.directions().iter().map(|d| d.variable as usize).filter(|&k| k < n).collect();
        depends_on.sort_unstable();
        let count = n + p + self.mode.parameters().len();
        let mut domain = VariableBox {
            values: vec![Interval::ZERO; count],
            nominal: vec![Interval::ZERO; count],
            centers: vec![Interval::ZERO; count],
        };
        for (i, value) in input.iter().enumerate() {
            domain.nominal[n + i] = Interval::of_rational(value);
            domain.values[n + i] = domain.nominal[n + i];
        }
        domain.values[n + p..].copy_from_slice(self.mode.parameters());
        Row { coordinate, depends_on, kind: RowKind::Enclosed(Box::new(enclosure), domain) }
    }

    /// The image of an expression that is affine in state and inputs, with exact slopes.
    fn affine_image(&mut self, root: NodeId, input: &[Rational]) -> Option<AffineImage> {
        let n = self.states();
        let form = self.graph.affine(root, (n + input.len()) as u32)?;
        let (rest_lower, rest_upper) = self.constant_ends(form.rest)?;
        let two = Rational::from_integer(2.into());
        let zero = Rational::zero();
        let slope = |variable: usize| form.slopes.get(&(variable as u32)).unwrap_or(&zero);
        let mut center = Rational::zero();
        for (i, value) in input.iter().enumerate() {
            center += slope(n + i) * value;
        }
        let (mut half_width, mut upper_open, mut slopes) = (Rational::zero(), false, Vec::new());
        for (k, axis) in self.grid.axes().iter().enumerate() {
            center += slope(k) * axis.center(0);
            let feedback = |i: usize| slope(n + i) * self.feedback.gain().get(i, k);
            let inside = (0..input.len()).fold(slope(k).clone(), |sum, i| sum - feedback(i));
            half_width += inside.abs() * axis.width() / &two;
            // Cells are half-open, so a coordinate with a positive slope never attains its upper end.
            upper_open |= inside.is_positive();
            if !slope(k).is_zero() {
                slopes.push((k, slope(k) * axis.width()));
            }
        }
        let first = (&center - &half_width + rest_lower, center + half_width + rest_upper);
        Some(AffineImage { slopes, first, upper_open })
    }

    /// The ends of an expression without states and inputs, over all parameters.
    fn constant_ends(&self, rest: NodeId) -> Option<(Rational, Rational)> {
        if let Some(value) = self.graph.number(rest) {
            return Some((value.clone(), value.clone()));
        }
        let mut variables = vec![Interval::ZERO; self.states() + self.mode.num_inputs()];
        variables.extend_from_slice(self.mode.parameters());
        let mut value = [Interval::EVERYTHING];
        Tape::new(&self.graph, &[rest]).on_box(&variables, &mut Vec::new(), &mut value);
        exact_ends(value[0])
    }

    /// The states and parameters along which the value of `root` varies over a cell.
    fn directions(&mut self, root: NodeId) -> Vec<Direction> {
        let (n, p) = (self.states(), self.mode.num_inputs());
        let variables = Tape::new(&self.graph, &[root]).variables();
        let occurs = |variable: usize| variables.contains(&(variable as u32));
        let gain: &ExactMatrix = self.feedback.gain();
        let mut directions = Vec::new();
        for k in 0..n {
            let followers: Vec<Follower> = (0..p)
                .filter(|&i| occurs(n + i) && !gain.get(i, k).is_zero())
                .map(|i| Follower {
                    variable: (n + i) as u32,
                    gain: Interval::of_rational(gain.get(i, k)),
                    gain_node: self.graph.constant(gain.get(i, k).clone()),
                })
                .collect();
            if occurs(k) || !followers.is_empty() {
                directions.push(Direction { variable: k as u32, followers });
            }
        }
        for (l, parameter) in self.mode.parameters().iter().enumerate() {
            if occurs(n + p + l) && !parameter.is_point() {
                directions.push(Direction { variable: (n + p + l) as u32, followers: Vec::new() });
            }
        }
        directions
    }
}
