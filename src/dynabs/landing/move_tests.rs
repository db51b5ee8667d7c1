//! Noise in boxes against its definition in exact arithmetic, and against the general solver.

use super::*;
use crate::partition::CellKind;
use crate::task::{Aim, CellTask};
use imdp::numeric::{Rational, from_dyadic, to_f64};
use imdp::property::{PathFormula, Property, Resolution, StateFormula};
use imdp::solver::{Answer, SolverOptions};
use num_traits::{One, Zero};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha12Rng;

/// A small game with one or two noises, made up.
struct Game {
    axes: Vec<Axis>,
    noise: Vec<Stencil>,
    goal: Vec<bool>,
    open: Vec<u32>,
    /// By cell: the image under the only input.
    boxes: Vec<Vec<(i64, i64)>>,
    /// By coordinate: all of them.
    ranges: Vec<Vec<(i64, i64)>>,
}

impl ImageSource for Game {
    fn inputs(&self) -> usize {
        1
    }

    fn ranges(&self, coordinate: usize) -> &[(i64, i64)] {
        &self.ranges[coordinate]
    }

    fn image(&self, cell: u32, _: u32, out: &mut [u32]) -> bool {
        for (j, range) in self.boxes[cell as usize].iter().enumerate() {
            out[j] = self.ranges[j].iter().position(|of| of == range).unwrap() as u32;
        }
        true
    }
}

fn stencil(rng: &mut impl Rng, dimension: usize, known: bool) -> Stencil {
    let count = rng.random_range(2..6);
    let weights: Vec<f64> = (0..count).map(|_| f64::from(rng.random_range(1..8))).collect();
    let sum = weights.iter().sum::<f64>() * 1.1;
    let tap = |weight: &f64| Tap {
        first: (0..dimension).map(|_| rng.random_range(-4..4)).collect(),
        size: (0..dimension).map(|_| rng.random_range(1..4)).collect(),
        lower: weight / sum * if known { 1.0 } else { 0.8 },
        upper: (weight / sum + if known { 1e-9 } else { 0.1 }).min(1.0),
    };
    let taps: Vec<Tap> = weights.iter().map(tap).collect();
    Stencil { taps, elsewhere: if known { 0.1 } else { 0.05 }, band: None }
}

fn game(seed: u64) -> Game {
    let mut rng = ChaCha12Rng::seed_from_u64(1000 + seed);
    let dimension = 1 + (seed % 2) as usize;
    let boxes_of = |rng: &mut ChaCha12Rng, length: i64| {
        let first = rng.random_range(-4..length + 3);
        (first, first + rng.random_range(0..3))
    };
    let axes: Vec<Axis> = (0..dimension)
        .map(|_| {
            let resolution = rng.random_range(1..3);
            Axis::new(rng.random_range(2..5), resolution, rng.random_bool(0.3), None, (-6, 14))
        })
        .collect();
    let cells: usize = axes.iter().map(|axis| axis.cells).product();
    let kinds: Vec<u32> = (0..cells).map(|_| rng.random_range(0..5)).collect();
    let noise =
        (0..1 + seed % 3 / 2).map(|i| stencil(&mut rng, dimension, (seed + i).is_multiple_of(4))).collect();
    let boxes: Vec<Vec<(i64, i64)>> =
        (0..cells).map(|_| axes.iter().map(|axis| boxes_of(&mut rng, axis.sub_cells())).collect()).collect();
    let range = |j: usize| boxes.iter().map(|image| image[j]).collect();
    Game {
        ranges: (0..dimension).map(range).collect(),
        noise,
        goal: kinds.iter().map(|&kind| kind == 0).collect(),
        open: (0..cells as u32).filter(|&cell| kinds[cell as usize] > 1).collect(),
        axes,
        boxes,
    }
}

/// The worst or best expectation from a place, unbounded in space: nature knows everything before it decides.
fn expectation(game: &Game, noise: &[Stencil], values: &[Rational], place: &[i64], lower: bool) -> Rational {
    let Some((first, then)) = noise.split_first() else {
        let cells = game.axes.iter().zip(place).map(|(axis, &i)| axis.cell(i));
        let at = cells.zip(&game.axes).try_fold(0, |at, (c, axis)| c.map(|c| at * axis.cells + c));
        return at.map_or(Rational::zero(), |at| values[at].clone());
    };
    let dyadic = |x: f64| from_dyadic(x).unwrap();
    let worth = |tap: &Tap| {
        let count: u32 = tap.size.iter().product();
        let all = (0..count).map(|mut index| {
            let step = tap.first.iter().zip(&tap.size).zip(place).map(|((first, size), place)| {
                let i = place + first + i64::from(index % size);
                index /= size;
                i
            });
            expectation(game, then, values, &step.collect::<Vec<_>>(), lower)
        });
        if lower { all.min() } else { all.max() }.unwrap()
    };
    let mut all: Vec<(Rational, Rational)> =
        vec![(if lower { Rational::zero() } else { Rational::one() }, dyadic(first.elsewhere))];
    let (mut sum, mut rest) = (Rational::zero(), Rational::one());
    for tap in &first.taps {
        let value = worth(tap);
        sum += dyadic(tap.lower) * &value;
        rest -= dyadic(tap.lower);
        all.push((value, dyadic(tap.upper) - dyadic(tap.lower)));
    }
    all.sort();
    if !lower {
        all.reverse();
    }
    for (value, room) in all {
        let more = room.min(rest.clone());
        sum += &more * value;
        rest -= more;
    }
    sum
}

#[test]
fn noise_in_boxes_has_its_value() {
    for seed in 0..24 {
        let game = game(seed);
        let hull = |j: usize| {
            let ranges = || game.ranges[j].iter();
            (ranges().map(|r| r.0).min().unwrap(), ranges().map(|r| r.1).max().unwrap())
        };
        let extent: Vec<(i64, i64)> = (0..game.axes.len()).map(hull).collect();
        let landing = Landing::with_noise_in_boxes(game.axes.clone(), &extent, &game.noise);
        let occurs = occurring(&game, &game.open, game.axes.len());
        let pairs = game.open.len() as u64;
        let layout = Layout::new(&game, &occurs, landing.axes(), pairs).unwrap();
        let images = Images::new(&game, &game.open, layout);
        let Game { open, goal, .. } = &game;
        let kind = |cell: usize| match (goal[cell], open.contains(&(cell as u32))) {
            (true, _) => CellKind::Goal,
            (false, true) => CellKind::Ordinary,
            (false, false) => CellKind::Unsafe,
        };
        let kinds: Vec<CellKind> = (0..goal.len()).map(kind).collect();
        let task = &CellTask::of_kinds(Aim::Reach, &kinds, &kinds);
        let question = Question { landing: &landing, images: &images, open, task, steps: Some(2) };
        let solution = question.solve(&SolverOptions::default());
        for (lower, bounds) in [(true, &solution.values.lower), (false, &solution.values.upper)] {
            let start = |&goal: &bool| if goal { Rational::one() } else { Rational::zero() };
            let mut exact: Vec<Rational> = goal.iter().map(start).collect();
            for _ in 0..2 {
                let before = exact.clone();
                for &cell in open {
                    let image = &game.boxes[cell as usize];
                    let count: i64 = image.iter().map(|(a, b)| b - a + 1).product();
                    let worths = (0..count).map(|mut index| {
                        let place = image.iter().map(|(a, b)| {
                            let i = a + index % (b - a + 1);
                            index /= b - a + 1;
                            i
                        });
                        expectation(&game, &game.noise, &before, &place.collect::<Vec<_>>(), lower)
                    });
                    exact[cell as usize] = if lower { worths.min() } else { worths.max() }.unwrap();
                }
            }
            for (cell, (bound, exact)) in bounds.iter().zip(&exact).enumerate() {
                let bound_exactly = from_dyadic(*bound).unwrap();
                let sound = if lower { bound_exactly <= *exact } else { bound_exactly >= *exact };
                assert!(sound && (bound - to_f64(exact)).abs() < 1e-12, "{seed}, {cell}: {bound} {exact}");
            }
        }
        let encoded = question.model(&[0]).unwrap();
        for (resolution, own) in
            [(Resolution::Pmaxmin, &solution.values.lower), (Resolution::Pmaxmax, &solution.values.upper)]
        {
            let property = Property::value(
                resolution,
                PathFormula::Until {
                    left: StateFormula::negation(StateFormula::label("failed")),
                    right: StateFormula::label("reached"),
                    steps: Some(2 * encoded.micro_steps),
                },
            );
            let answer = Answer::new(&encoded.model, &property, &SolverOptions::default()).unwrap();
            for (cell, states) in encoded.of_cell.iter().enumerate() {
                let [state] = states[..] else { panic!("one start") };
                let state = state.index();
                let (lower, upper) = (answer.values.lower[state], answer.values.upper[state]);
                let own = own[cell];
                assert!(
                    own >= lower - 1e-9 && own <= upper + 1e-9,
                    "{seed}, {cell}: {own} [{lower}, {upper}]"
                );
            }
        }
    }
}
