//! Images against sampled states, exact cases, and controls.

use super::{ImageMap, ImageScratch, Lattice, LatticeRange};
use crate::linear_algebra::ExactMatrix;
use crate::partition::Grid;
use crate::system::expression::{Graph, Scope, parse};
use crate::system::{Feedback, Interval, Mode, Variable};
use imdp::numeric::{Rational, from_decimal, to_f64};
use nalgebra::DMatrix;
use proptest::prelude::*;

fn exact(values: &[f64]) -> Vec<Rational> {
    values.iter().map(|&x| from_decimal(x).unwrap()).collect()
}

fn grid(lower: &[f64], upper: &[f64], cells: &[u32]) -> Grid {
    Grid::new(&exact(lower), &exact(upper), cells).unwrap()
}

fn matrix(rows: usize, entries: &[f64]) -> ExactMatrix {
    ExactMatrix::from_decimals(&DMatrix::from_row_slice(rows, entries.len() / rows, entries)).unwrap()
}

/// A mode with states x1, x2, inputs u1, … and one parameter m.
fn mode(texts: &[&str], inputs: usize, parameter: Interval) -> Mode {
    let (mut graph, mut scope) = (Graph::default(), Scope::default());
    let states = (1..=texts.len()).map(|k| format!("x{k}"));
    let names = states.chain((1..=inputs).map(|i| format!("u{i}"))).chain(["m".to_owned()]);
    for (number, name) in names.enumerate() {
        let variable = graph.variable(number as u32);
        scope.insert(&name, variable).unwrap();
    }
    let next = texts.iter().map(|text| parse(&mut graph, &scope, text, text).unwrap()).collect();
    Mode::new(
        graph,
        next,
        Variable::numbered("x", texts.len()),
        Variable::numbered("u", inputs),
        vec![parameter],
    )
}

fn images(mode: &Mode, feedback: &Feedback, grid: &Grid, noisy: bool, inputs: &[Vec<f64>]) -> ImageMap {
    let n = grid.dimension();
    let lattice = Lattice::new(grid, &vec![1; n], &vec![noisy; n]);
    let inputs: Vec<_> = inputs.iter().map(|input| exact(input)).collect();
    ImageMap::new(mode, feedback, grid, lattice, &inputs)
}

fn range(images: &ImageMap, input: usize, coordinate: usize, cell: &[u32]) -> (i64, i64) {
    let row = images.row(input, coordinate);
    let LatticeRange { first, last } = images.range(row, cell, &mut ImageScratch::default()).unwrap();
    (first, last)
}

#[test]
fn linear_images_end_exactly_on_faces() {
    // Cells of 0.1, which no double is: positions and velocities move by whole cells all the same.
    let grid = grid(&[0.0, -1.0], &[10.0, 1.0], &[100, 20]);
    let mode = mode(&["x1 + x2 + 0.05*u1", "x2 + 0.1*u1"], 1, Interval::ZERO);
    let images = images(&mode, &Feedback::none(1, &grid), &grid, false, &[vec![0.0], vec![1.0]]);
    // Velocity [0, 0.1), position [5, 5.1): the next position is in [5, 5.2), the next velocity in [0.1, 0.2).
    assert_eq!(range(&images, 0, 0, &[50, 10]), (50, 51));
    assert_eq!(range(&images, 1, 1, &[50, 10]), (11, 11));
    assert_eq!(range(&images, 1, 0, &[50, 10]), (50, 52));
    assert_eq!(images.depends_on(images.row(1, 1)), [1]);
    assert!(images.is_exact(images.row(1, 0)));
}

#[test]
fn faces_that_are_attained_count_unless_noise_moves_them_on() {
    let grid = grid(&[-2.0], &[2.0], &[4]);
    let mode = mode(&["-x1"], 0, Interval::ZERO);
    // −[0, 1) = (−1, 0], and 0 belongs to the cell [0, 1).
    let closed = images(&mode, &Feedback::none(0, &grid), &grid, false, &[vec![]]);
    assert_eq!(range(&closed, 0, 0, &[2]), (1, 2));
    let noisy = images(&mode, &Feedback::none(0, &grid), &grid, true, &[vec![]]);
    assert_eq!(range(&noisy, 0, 0, &[2]), (1, 1));
}

#[test]
fn dead_beat_feedback_is_the_target_action() {
    // K = B⁻¹A makes the image the point A c + B ū + q, whatever the cell.
    let (a, b) = (matrix(2, &[1.0, 0.7, -0.2, 0.9]), matrix(2, &[0.5, 0.1, 0.0, 0.4]));
    let grid = grid(&[-3.0, -3.0], &[3.0, 3.0], &[7, 9]);
    let gain = b.inverse().unwrap().times(&a);
    let mode = mode(&["x1 + 0.7*x2 + 0.5*u1 + 0.1*u2", "-0.2*x1 + 0.9*x2 + 0.4*u2"], 2, Interval::ZERO);
    let images = images(&mode, &Feedback::new(gain, &grid), &grid, false, &[vec![0.3, -0.2]]);
    let u = ExactMatrix::column_from_decimals(&[0.3, -0.2]).unwrap();
    for i in 0..7 {
        for k in 0..9 {
            let center = [grid.axes()[0].center(i), grid.axes()[1].center(k)];
            let center = ExactMatrix::from_fn(2, 1, |j, _| center[j].clone());
            let target = a.times(&center).plus(&b.times(&u));
            for j in 0..2 {
                let index = grid.axes()[j].position(target.get(j, 0)).floor();
                let index = to_f64(&index) as i64;
                assert_eq!(range(&images, 0, j, &[i, k]), (index, index));
            }
        }
    }
}

#[test]
fn feedback_contracts_the_image() {
    let grid = grid(&[-7.0, -7.0], &[7.0, 7.0], &[28, 28]);
    let mode = mode(&["x1 + x2 + 0.5*u1", "x2 + u1"], 1, Interval::ZERO);
    let inputs = [vec![0.0]];
    let plain = images(&mode, &Feedback::none(1, &grid), &grid, true, &inputs);
    let feedback = Feedback::new(matrix(1, &[0.0, 1.0]), &grid);
    let steered = images(&mode, &feedback, &grid, true, &inputs);
    let width = |images: &ImageMap, j| {
        let (first, last) = range(images, 0, j, &[14, 14]);
        last - first + 1
    };
    assert_eq!((width(&plain, 0), width(&plain, 1)), (2, 1));
    assert_eq!((width(&steered, 0), width(&steered, 1)), (2, 1));
    assert_eq!(feedback.margins(), [from_decimal(0.25).unwrap()]);
}

#[test]
fn rows_are_shared_between_inputs() {
    let grid = grid(&[-1.0, -3.0], &[1.0, 3.0], &[10, 10]);
    let mode = mode(&["x1 + u1*cos(x2)", "x2 + u2"], 2, Interval::ZERO);
    let inputs: Vec<_> = (0..9).map(|i| vec![f64::from(i % 3 - 1), f64::from(i / 3 - 1)]).collect();
    let images = images(&mode, &Feedback::none(2, &grid), &grid, false, &inputs);
    assert_eq!(images.num_rows(), 6);
    // Without speed the first state stays: 0·cos(x2) is exactly 0.
    let row = images.row(1, 0);
    assert!(images.is_exact(row) && images.depends_on(row) == [0]);
    assert_eq!(range(&images, 1, 0, &[3, 7]), (3, 3));
    assert_eq!(images.depends_on(images.row(0, 0)), [0, 1]);
}

#[test]
fn undefined_dynamics_name_the_operation() {
    let grid = grid(&[-1.0], &[1.0], &[5]);
    let mode = mode(&["x1 + 1/x1"], 0, Interval::ZERO);
    let images = images(&mode, &Feedback::none(0, &grid), &grid, false, &[vec![]]);
    let error = images.range(0, &[2], &mut ImageScratch::default()).unwrap_err();
    assert_eq!(error.place, Some(("x1 + 1/x1".to_owned(), 7)));
    assert!(error.to_string().contains("a division by"), "{error}");
    assert!(images.range(0, &[4], &mut ImageScratch::default()).is_ok());
}

const SYSTEMS: [[&str; 2]; 8] = [
    ["x1 + 0.1*x2", "x2 + 0.1*((1 - x1^2)*x2 - x1) + u1"],
    ["x1 + m*u1*cos(x2)", "x2 + 0.5*u2*sin(x1)"],
    ["x1*x2 - x2*abs(x2) + u1", "max(x1, x2) - min(x1, -x2)"],
    ["x1/(1 + x2^2) + u2", "exp(-x1^2)*x2 + m"],
    ["clip(x1 + u1, -1, 1) + 0.3*sin(3*x2)", "x2 - 0.2*x2^3 + u2*x1"],
    ["m*x1 - x2/m", "x1 + m*m*u2 - m*x2"],
    ["tanh(x1 - x2) + sqrt(2 + x1)", "cosh(x2)/3 - atan(x1*u1)"],
    ["x1 + 0.1*x2 + 0.005*u1", "x2 + 0.1*u1"],
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    /// Every state of a cell, with every parameter, lands in the image; and the image is no wider than the
    /// states need by more than the cells that cutting may leave.
    #[test]
    fn images_enclose_what_states_do(
        system in 0usize..8,
        gain in prop::array::uniform4(-8i32..8),
        input in prop::array::uniform2(-10i32..10),
        cell in prop::array::uniform2(0u32..12),
        inside in prop::collection::vec(prop::array::uniform3(0f64..1.0), 40),
    ) {
        let grid = grid(&[-1.2, -1.5], &[1.2, 1.5], &[12, 12]);
        let mode = mode(&SYSTEMS[system], 2, Interval::new(0.75, 1.25));
        let gain: Vec<f64> = gain.iter().map(|&k| f64::from(k.max(0)) / 10.0).collect();
        let feedback = Feedback::new(matrix(2, &gain), &grid);
        let nominal = input.map(|u| f64::from(u) / 10.0);
        let images = images(&mode, &feedback, &grid, false, &[nominal.to_vec()]);
        let center: Vec<f64> = (0..2).map(|j| to_f64(&grid.axes()[j].center(cell[j]))).collect();
        let mut reached = [(i64::MAX, i64::MIN); 2];
        // What is monotone reaches its extremes at corners of the cell and ends of the parameter.
        let corners = (0..8).map(|bits| [0, 1, 2].map(|j| f64::from(bits >> j & 1)));
        for point in inside.iter().copied().chain(corners) {
            let x: Vec<f64> = (0..2).map(|j| {
                let face = to_f64(&grid.axes()[j].face(cell[j]));
                face + point[j] * to_f64(grid.axes()[j].width())
            }).collect();
            let (mut u, mut next) = ([0.0; 2], [0.0; 2]);
            feedback.input(&nominal, &x, &center, &mut u);
            mode.step(&x, &u, &[0.75 + 0.5 * point[2]], &mut Vec::new(), &mut next);
            for j in 0..2 {
                let position = (next[j] - to_f64(grid.axes()[j].lower())) / to_f64(grid.axes()[j].width());
                // A state within rounding of a face may be on either side of it.
                let (first, last) = range(&images, 0, j, &cell);
                prop_assert!((position + 1e-9).floor() as i64 >= first && (position - 1e-9).floor() as i64 <= last,
                    "{} at {:?} goes to {}, image {:?}", SYSTEMS[system][j], x, position, (first, last));
                reached[j].0 = reached[j].0.min(position.floor() as i64);
                reached[j].1 = reached[j].1.max(position.floor() as i64);
            }
        }
        for j in 0..2 {
            let (first, last) = range(&images, 0, j, &cell);
            prop_assert!(last - first <= reached[j].1 - reached[j].0 + 3, "{}: {:?} but {:?} reached",
                SYSTEMS[system][j], (first, last), reached[j]);
        }
    }
}
