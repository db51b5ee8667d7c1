//! Small games against their definition in exact arithmetic, and against the general solver.

use super::*;
use crate::partition::CellKind;
use crate::task::{Aim, CellTask};
use imdp::numeric::{Rational, from_dyadic, to_f64};
use imdp::property::{PathFormula, Property, Resolution, StateFormula};
use imdp::solver::{Answer, SolverOptions};
use num_traits::{One, Zero};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha12Rng;

/// Ranges of sub-cells.
type Image = Vec<(i64, i64)>;

/// A small game, made up.
struct Game {
    axes: Vec<Axis>,
    goal: Vec<bool>,
    open: Vec<u32>,
    aim: Aim,
    /// By cell and input.
    boxes: Vec<Vec<Option<Image>>>,
    /// By coordinate: the ranges of all images.
    ranges: Vec<Vec<(i64, i64)>>,
}

impl Game {
    /// The images of open cells, as if they were looked up so many times.
    fn images(&self, pairs: u64) -> Images {
        let occurs = occurring(self, &self.open, self.axes.len());
        Images::new(self, &self.open, Layout::new(self, &occurs, &self.axes, pairs).unwrap())
    }
}

impl Game {
    fn task(&self) -> CellTask {
        let kind = |cell: usize| match (self.goal[cell], self.open.contains(&(cell as u32))) {
            (true, _) => CellKind::Goal,
            (false, true) => CellKind::Ordinary,
            (false, false) => CellKind::Unsafe,
        };
        let kinds: Vec<CellKind> = (0..self.goal.len()).map(kind).collect();
        CellTask::of_kinds(self.aim, &kinds, &kinds)
    }
}

impl ImageSource for Game {
    fn inputs(&self) -> usize {
        self.boxes[0].len()
    }

    fn ranges(&self, coordinate: usize) -> &[(i64, i64)] {
        &self.ranges[coordinate]
    }

    fn image(&self, cell: u32, input: u32, out: &mut [u32]) -> bool {
        let image = &self.boxes[cell as usize][input as usize];
        for (j, range) in image.iter().flatten().enumerate() {
            out[j] = self.ranges[j].iter().position(|of| of == range).unwrap() as u32;
        }
        image.is_some()
    }
}

fn some_taps(rng: &mut impl Rng, complete: bool) -> Taps {
    let count = rng.random_range(1..5);
    let mut lower: Vec<f64> = (0..count).map(|_| f64::from(rng.random_range(0..8))).collect();
    lower[0] += 1.0;
    let sum: f64 = lower.iter().sum::<f64>() * if complete { 1.0 } else { 1.25 };
    lower.iter_mut().for_each(|p| *p /= sum);
    let upper = lower.iter().map(|p| if *p > 0.0 { (p + 1e-15).min(1.0) } else { 0.0 }).collect();
    Taps { first: rng.random_range(-3..2), lower, upper, elsewhere: if complete { 0.0 } else { 0.2 } }
}

fn game(seed: u64) -> Game {
    let mut rng = ChaCha12Rng::seed_from_u64(seed);
    let dimension = 1 + (seed % 3) as usize;
    let axes: Vec<Axis> = (0..dimension)
        .map(|_| {
            let noise = rng.random_bool(0.8).then(|| some_taps(&mut rng, seed.is_multiple_of(2)));
            let resolution = if noise.is_some() { rng.random_range(1..4) } else { 1 };
            Axis::new(rng.random_range(2..5), resolution, rng.random_bool(0.3), noise, (-9, 30))
        })
        .collect();
    let cells: usize = axes.iter().map(|axis| axis.cells).product();
    let aim = if rng.random_bool(0.6) { Aim::Reach } else { Aim::Stay };
    let kinds: Vec<u32> = (0..cells).map(|_| rng.random_range(0..6)).collect();
    let goal = kinds.iter().map(|&kind| aim == Aim::Reach && kind == 0).collect();
    let image = |rng: &mut ChaCha12Rng| {
        rng.random_bool(0.8).then(|| {
            let of_axis = |axis: &Axis| {
                let first = rng.random_range(-5..axis.sub_cells() + 3);
                (first, first + rng.random_range(0..3))
            };
            axes.iter().map(of_axis).collect()
        })
    };
    let boxes: Vec<Vec<_>> = (0..cells).map(|_| (0..3).map(|_| image(&mut rng)).collect()).collect();
    let open: Vec<u32> = (0..cells as u32).filter(|&cell| kinds[cell as usize] > 1).collect();
    let open = open.into_iter().filter(|&cell| boxes[cell as usize].iter().any(Option::is_some)).collect();
    let all = || boxes.iter().flatten().flatten();
    let ranges = (0..axes.len()).map(|j| all().map(|image: &Image| image[j]).collect()).collect();
    Game { axes, goal, open, aim, boxes, ranges }
}

/// The value of the game by its definition: nature knows everything before it decides.
fn by_definition(game: &Game, landing: &Landing, steps: usize, lower: bool) -> Vec<Rational> {
    let mut values: Vec<Rational> = vec![Rational::zero(); game.goal.len()];
    let start = |cell: usize| game.goal[cell] || game.aim == Aim::Stay && game.open.contains(&(cell as u32));
    (0..values.len()).filter(|&cell| start(cell)).for_each(|cell| values[cell] = Rational::one());
    let order: Vec<usize> = landing.order().collect();
    for _ in 0..steps {
        let mut next = values.clone();
        for &cell in &game.open {
            let worth = |image: &Image| {
                let count: i64 = image.iter().map(|(a, b)| b - a + 1).product();
                let places = (0..count).map(|mut index| {
                    let place = image.iter().map(|(a, b)| {
                        let i = a + index % (b - a + 1);
                        index /= b - a + 1;
                        i
                    });
                    landed(game, &order, &values, &place.collect::<Vec<_>>(), lower)
                });
                if lower { places.min() } else { places.max() }.unwrap()
            };
            let worths = game.boxes[cell as usize].iter().flatten().map(worth);
            next[cell as usize] = worths.max().unwrap_or(Rational::zero());
        }
        values = next;
    }
    values
}

fn landed(game: &Game, order: &[usize], values: &[Rational], place: &[i64], lower: bool) -> Rational {
    let Some((&j, before)) = order.split_last() else {
        let cells = game.axes.iter().zip(place).map(|(axis, &i)| axis.cell(i * axis.resolution as i64));
        let at =
            cells.zip(&game.axes).try_fold(0, |at, (cell, axis)| cell.map(|cell| at * axis.cells + cell));
        return at.map_or(Rational::zero(), |at| values[at].clone());
    };
    let axis = &game.axes[j];
    // From here on, this coordinate is a cell; outside there is none.
    let then = |sub_cell: i64| {
        if axis.cell(sub_cell).is_none() {
            return Rational::zero();
        }
        let mut to = place.to_vec();
        to[j] = sub_cell.div_euclid(axis.resolution as i64);
        landed(game, before, values, &to, lower)
    };
    let Some(taps) = &axis.noise else { return then(place[j]) };
    let mut sum = Rational::zero();
    let mut rest = Rational::one();
    for (k, &mass) in taps.lower.iter().enumerate() {
        let mass = from_dyadic(mass).unwrap();
        let to = place[j] + taps.first + k as i64;
        let (a, b) = (then(to), then(to + 1));
        sum += &mass * if lower { a.min(b) } else { a.max(b) };
        rest -= mass;
    }
    if lower { sum } else { sum + rest }
}

fn property(game: &Game, resolution: Resolution, steps: Option<u64>) -> Property {
    let not_failed = StateFormula::negation(StateFormula::label("failed"));
    Property::value(
        resolution,
        match game.aim {
            Aim::Reach => {
                PathFormula::Until { left: not_failed, right: StateFormula::label("reached"), steps }
            }
            Aim::Stay | Aim::End => PathFormula::Globally { formula: not_failed, steps },
        },
    )
}

#[test]
fn small_games_have_their_value() {
    for seed in 0..18 {
        let game = game(seed);
        let landing = Landing::new(game.axes.clone());
        // Few lookups are scanned, for many it pays to gather all axes.
        let images = game.images([0, 100, 100_000][seed as usize / 3 % 3]);
        let (open, task) = (&game.open, &game.task());
        assert_eq!(images.acting(), *open);
        let question = Question { landing: &landing, images: &images, open, task, steps: Some(3) };
        let solution = question.solve(&SolverOptions::default());
        for (lower, bounds) in [(true, &solution.values.lower), (false, &solution.values.upper)] {
            let exact = by_definition(&game, &landing, 3, lower);
            for (cell, (bound, exact)) in bounds.iter().zip(&exact).enumerate() {
                let sound = if lower {
                    from_dyadic(*bound).unwrap() <= *exact
                } else {
                    from_dyadic(*bound).unwrap() >= *exact
                };
                assert!(
                    sound && (bound - to_f64(exact)).abs() < 1e-12,
                    "game {seed}, cell {cell}: {bound} for {exact}"
                );
            }
        }
    }
}

#[test]
fn the_general_solver_gives_the_same_values() {
    for seed in 0..20 {
        let game = game(seed);
        let landing = Landing::new(game.axes.clone());
        let images = game.images(game.open.len() as u64);
        let (open, task) = (&game.open, &game.task());
        for steps in [Some(3), None] {
            let question = Question { landing: &landing, images: &images, open, task, steps };
            let solution = question.solve(&SolverOptions::default());
            let encoded = question.model(&[0]).unwrap();
            let micro_steps = steps.map(|steps| steps * encoded.micro_steps);
            for (resolution, own) in
                [(Resolution::Pmaxmin, &solution.values.lower), (Resolution::Pmaxmax, &solution.values.upper)]
            {
                let options = SolverOptions { epsilon: 1e-9, ..SolverOptions::default() };
                let answer =
                    Answer::new(&encoded.model, &property(&game, resolution, micro_steps), &options).unwrap();
                for (cell, states) in encoded.of_cell.iter().enumerate() {
                    let [state] = states[..] else { panic!("one start") };
                    let (lower, upper, own) =
                        (answer.values.lower[state.index()], answer.values.upper[state.index()], own[cell]);
                    let agrees = match (steps, resolution) {
                        (Some(_), _) => own >= lower - 1e-9 && own <= upper + 1e-9,
                        (None, Resolution::Pmaxmin) => own <= upper && own >= lower - 1e-5,
                        (None, _) => own >= lower,
                    };
                    assert!(
                        agrees,
                        "game {seed}, {steps:?}, {resolution:?}, cell {cell}: {own} in [{lower}, {upper}]"
                    );
                }
            }
        }
    }
}
