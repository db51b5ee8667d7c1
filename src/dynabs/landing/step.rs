//! One robust step for all cells: `V⁺(s) = max_a min { G(i) : i ∈ I(s,a) }`, or with maxima for the upper bound.

use super::arrays::Arrays;
use super::axis::Axis;
use super::images::Images;
use super::moves::{Move, Span};
use super::side::Side;
use super::stage::Stage;
use super::stencil::Stencil;
use super::taps::Taps;
use imdp::solver::NO_CHOICE;

/// The lattice on which images land, and the noise that takes them on.
#[derive(Clone, Debug)]
pub struct Landing {
    axes: Vec<Axis>,
    /// In the order in which they are applied, with the axis that each is about.
    stages: Vec<(usize, Stage)>,
    /// The axes of the array after all stages: those above, if there are no moves.
    inner: Vec<Axis>,
    /// What else the noise does, before what the stages do.
    moves: Vec<Move>,
    arrays: Arrays,
}

/// The best input of every cell and what it is worth.
#[derive(Clone, Debug)]
pub struct Best {
    /// By cell: 0 where nothing is enabled.
    pub values: Vec<f64>,
    /// By cell: the first of the best inputs, or [`NO_CHOICE`].
    pub inputs: Vec<u32>,
}

impl Landing {
    /// A lattice with these axes, row-major.
    pub fn new(axes: Vec<Axis>) -> Self {
        Self::between(axes.clone(), axes, vec![])
    }

    /// A lattice with these axes, none of which has noise of its own, and noise that moves what lands on it: one after
    /// the other. Images occupy sub-cells from `images[j].0` to `images[j].1`.
    pub fn with_noise_in_boxes(axes: Vec<Axis>, images: &[(i64, i64)], noise: &[Stencil]) -> Self {
        let lengths: Vec<usize> = axes.iter().map(|axis| axis.cells * axis.resolution).collect();
        let periodic: Vec<bool> = axes.iter().map(|axis| axis.periodic).collect();
        let moves = Move::chain(noise, &lengths, &periodic, images);
        let over = |spans: &[Span]| -> Vec<Axis> {
            let axes = axes.iter().zip(spans);
            axes.map(|(axis, span)| Axis { first: span.first, len: span.len, ..axis.clone() }).collect()
        };
        let (Some(first), Some(last)) = (moves.first(), moves.last()) else { return Self::new(axes) };
        Self::between(over(&first.from), over(&last.to), moves)
    }

    fn between(axes: Vec<Axis>, inner: Vec<Axis>, moves: Vec<Move>) -> Self {
        let mut stages: Vec<_> = inner.iter().map(Stage::new).enumerate().collect();
        // Those that make the array longer last: the others then have less to do.
        stages.sort_by(|(_, a), (_, b)| a.growth().total_cmp(&b.growth()));
        Self { axes, stages, inner, moves, arrays: Arrays::default() }
    }

    /// The axes.
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    pub(super) fn stages(&self) -> &[(usize, Stage)] {
        &self.stages
    }

    /// The axes of the array after all stages.
    pub(super) fn inner(&self) -> &[Axis] {
        &self.inner
    }

    /// What the noise does before the stages, in this order.
    pub(super) fn moves(&self) -> &[Move] {
        &self.moves
    }

    /// Bytes of the arrays that noise in boxes takes in a step; those of stages are no larger than those of images.
    pub fn bytes_of_moves(&self) -> u64 {
        self.moves.iter().map(Move::bytes).max().unwrap_or(0)
    }

    /// The number of cells of the partition.
    pub fn num_cells(&self) -> usize {
        self.axes.iter().map(|axis| axis.cells).product()
    }

    /// This lattice with other noise, and the product of its least masses; `None` if some noise is unknown or that
    /// product is too small to be told from rounding.
    pub(super) fn with_noise(
        &self,
        noise: impl Iterator<Item = Option<Option<Taps>>>,
    ) -> Option<(Self, f64)> {
        if !self.moves.is_empty() {
            return None;
        }
        let mut axes = self.axes.clone();
        let mut least = 1.0;
        for (axis, noise) in axes.iter_mut().zip(noise) {
            axis.noise = match noise {
                None => None,
                Some(taps) => Some(taps?),
            };
            let masses = axis.noise.iter().flat_map(|taps| &taps.lower).filter(|&&p| p > 0.0);
            least *= masses.fold(1.0, |a: f64, &b| a.min(b));
        }
        (least > 1e-9).then(|| (Self::new(axes), least))
    }

    /// The landing value `G` of every sub-cell that is looked at, for the values of all cells.
    pub fn values<S: Side>(&self, of_cells: &[f64]) -> Vec<f64> {
        let mut values = self.arrays.take(of_cells.len());
        values.iter_mut().zip(of_cells).for_each(|(v, &of_cell)| *v = S::above_underflow(of_cell));
        let mut shape: Vec<usize> = self.inner.iter().map(|axis| axis.cells).collect();
        for (j, stage) in &self.stages {
            let inner = shape[j + 1..].iter().product();
            let landed = stage.apply::<S>(&values, inner, &self.arrays);
            self.arrays.keep(std::mem::replace(&mut values, landed));
            shape[*j] = stage.axis().len;
        }
        for noise in self.moves.iter().rev() {
            values = noise.apply::<S>(&values);
        }
        values
    }

    /// The extremum over each of some images for the values of all cells.
    pub(super) fn extrema<S: Side>(&self, images: &Images, of: &[(u32, u16)], of_cells: &[f64]) -> Vec<f64> {
        images.extrema::<S>(self.values::<S>(of_cells), of, &self.arrays)
    }

    /// The best input of every cell for the values of all cells.
    pub fn best<S: Side>(&self, images: &Images, of_cells: &[f64]) -> Best {
        let mut best = Best { values: vec![0.0; of_cells.len()], inputs: vec![NO_CHOICE; of_cells.len()] };
        images.best::<S>(self.values::<S>(of_cells), &self.arrays, |cell, value, input| {
            best.values[cell as usize] = value;
            best.inputs[cell as usize] = input;
        });
        best
    }
}
