//! The sub-cells and pairs of every stage as states of an interval MDP.

use super::axis::Axis;
use super::move_layers::MoveLayer;
use super::picks::push_any;
use super::step::Landing;
use super::weights::Weights;
use imdp::model::{Rows, StateId};

/// The states for what happens between two decisions, after those for cells.
///
/// Micro-steps go backwards through the stages: from a sub-cell of the whole lattice, noise of the last coordinate leads
/// to a pair of neighbouring cells in that coordinate, nature picks one, and so on until all coordinates are cells.
pub(super) struct Layers<'a> {
    landing: &'a Landing,
    /// By stage: where its landing states and its pair states begin; the same place twice without noise.
    starts: Vec<(usize, usize)>,
    /// By stage: the shape of the array before it.
    shapes: Vec<Vec<usize>>,
    /// What the noise does before, in this order.
    moves: Vec<MoveLayer<'a>>,
    /// The state after the last one.
    end: usize,
    outcome: Outcomes<'a>,
}

/// The states that do not belong to layers.
#[derive(Clone, Copy)]
pub(super) struct Outcomes<'a> {
    /// Everything that failed.
    pub(super) failed: StateId,
    /// Noise that is not listed.
    pub(super) lost: StateId,
    /// By cell.
    pub(super) of_cell: &'a [StateId],
}

impl<'a> Layers<'a> {
    /// The layers whose states are numbered from `first`.
    pub(super) fn new(landing: &'a Landing, first: usize, outcome: Outcomes<'a>) -> Self {
        let mut shape: Vec<usize> = landing.inner().iter().map(|axis| axis.cells).collect();
        let (mut starts, mut shapes, mut end) = (vec![], vec![], first);
        for j in landing.order() {
            let axis = &landing.inner()[j];
            shapes.push(shape.clone());
            let others: usize = shape.iter().product::<usize>() / shape[j];
            shape[j] = axis.len;
            if axis.noise.is_some() {
                let pairs = end + others * axis.len;
                starts.push((end, pairs));
                end = pairs + others * passes(axis);
            } else {
                starts.push((end, end));
            }
        }
        let layer = |of| {
            let layer = MoveLayer::new(of, end);
            end = layer.end();
            layer
        };
        let moves = landing.moves().iter().map(layer).collect();
        Self { landing, starts, shapes, moves, end, outcome }
    }

    /// The number of all states up to the last of these.
    pub(super) fn end(&self) -> usize {
        self.end
    }

    /// The state of a sub-cell of the whole lattice.
    pub(super) fn of_sub_cell(&self, place: &[usize]) -> StateId {
        self.after_moves(0, place)
    }

    /// The state of a place after the first `moves` moves.
    fn after_moves(&self, moves: usize, place: &[usize]) -> StateId {
        match self.moves.get(moves) {
            Some(layer) => layer.of_place(place),
            None => self.before(self.starts.len(), place.to_vec()),
        }
    }

    /// The state before the first `stage` stages: places in coordinates without noise are cells at once.
    fn before(&self, mut stage: usize, mut place: Vec<usize>) -> StateId {
        while let Some(index) = stage.checked_sub(1) {
            let j = self.landing.order().nth(index).unwrap_or_default();
            let axis = &self.landing.inner()[j];
            if axis.noise.is_some() {
                let mut shape = self.shapes[index].clone();
                shape[j] = axis.len;
                return StateId::from_index(self.starts[index].0 + flat(&shape, &place));
            }
            match axis.cell(axis.first + place[j] as i64) {
                None => return self.outcome.failed,
                Some(cell) => place[j] = cell,
            }
            stage = index;
        }
        self.outcome.of_cell[flat(&self.shapes.first().map_or(vec![], Clone::clone), &place)]
    }

    /// Adds the rows of all these states, in their order: each has one.
    pub(super) fn push_rows(&self, rows: &mut Rows) {
        for (stage, j) in self.landing.order().enumerate() {
            let axis = &self.landing.inner()[j];
            let Some(taps) = &axis.noise else { continue };
            let (weights, slack) = (Weights::of(axis, taps), taps.slack());
            let mut shape = self.shapes[stage].clone();
            shape[j] = axis.len;
            each(&shape, |place| self.push_noise(rows, stage, j, place, &weights, slack));
            shape[j] = passes(axis);
            each(&shape, |place| self.push_pair(rows, stage, j, place));
        }
        for (index, layer) in self.moves.iter().enumerate() {
            layer.push_rows(rows, self.outcome.lost, |place| self.after_moves(index + 1, place));
        }
    }

    fn push_noise(
        &self,
        rows: &mut Rows,
        stage: usize,
        j: usize,
        place: &[usize],
        weights: &[Weights],
        slack: f64,
    ) {
        let axis = &self.landing.inner()[j];
        let (r, n) = (axis.resolution as i64, axis.cells as i64);
        let sub_cell = axis.first + place[j] as i64;
        let (q, of_place) = (sub_cell.div_euclid(r), &weights[sub_cell.rem_euclid(r) as usize]);
        let position = |offset: i64| if axis.periodic { (q + offset).rem_euclid(n) } else { q + offset };
        let mut shape = self.shapes[stage].clone();
        shape[j] = passes(axis);
        let mut to = place.to_vec();
        let mut state = |pass: usize| {
            to[j] = pass;
            StateId::from_index(self.starts[stage].1 + flat(&shape, &to))
        };
        let (mut entries, mut failing) = (vec![], 0.0);
        for (offset, mass) in of_place.single.iter().map(|&(o, p)| (position(o), p)) {
            if (0..n).contains(&offset) {
                entries.push((state(offset as usize), mass))
            } else {
                failing += mass
            }
        }
        for (offset, mass) in of_place.pair.iter().map(|&(o, p)| (position(o), p)) {
            let inside = (-1..n).contains(&offset);
            if inside { entries.push((state((n + offset + 1) as usize), mass)) } else { failing += mass }
        }
        entries.sort_by_key(|&(state, _)| state);
        let bounded = |mass: f64| (mass, (mass + slack).next_up().min(1.0));
        let heads = [
            (self.outcome.failed, bounded(failing.next_down().max(0.0)), failing > 0.0),
            (self.outcome.lost, (0.0, slack), slack > 0.0),
        ];
        for (state, (lower, upper), _) in heads.into_iter().filter(|(.., is_there)| *is_there) {
            rows.push_entry(state, lower, upper);
        }
        for (state, mass) in entries {
            let (lower, upper) = bounded(mass);
            rows.push_entry(state, lower, upper);
        }
        rows.finish_row();
    }

    /// Passes `0 … cells − 1` lead to that cell, the later ones to one of two neighbours: `cells + c + 1` to `c` or `c + 1`.
    fn push_pair(&self, rows: &mut Rows, stage: usize, j: usize, place: &[usize]) {
        let axis = &self.landing.inner()[j];
        let (n, pass) = (axis.cells as i64, place[j] as i64);
        let cells = if pass < n { vec![pass] } else { vec![pass - n - 1, pass - n] };
        let state = |cell: i64| {
            let cell = if axis.periodic { cell.rem_euclid(n) } else { cell };
            if !(0..n).contains(&cell) {
                return self.outcome.failed;
            }
            let mut to = place.to_vec();
            to[j] = cell as usize;
            self.before(stage, to)
        };
        push_any(rows, cells.into_iter().map(state).collect());
    }
}

/// The number of pair states of an axis.
fn passes(axis: &Axis) -> usize {
    2 * axis.cells + 1
}

fn flat(shape: &[usize], place: &[usize]) -> usize {
    shape.iter().zip(place).fold(0, |at, (len, place)| at * len + place)
}

/// All places of an array, row-major.
fn each(shape: &[usize], mut visit: impl FnMut(&[usize])) {
    let mut place = vec![0; shape.len()];
    for _ in 0..shape.iter().product::<usize>() {
        visit(&place);
        for j in (0..shape.len()).rev() {
            place[j] += 1;
            if place[j] < shape[j] {
                break;
            }
            place[j] = 0;
        }
    }
}
