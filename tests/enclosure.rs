//! Bounds of actions that are inputs enclose the truth, on a grid so fine that it is known.
//!
//! Twelve systems with five noises each, in one coordinate; with regions that consist of cells and, for a third of them, also with
//! regions that cut cells. The truth comes from the closed formulas of the dynamics and
//! of the distribution functions below, which share nothing with the library. Controls compute the lower bound as one
//! would who forgets something; this test would notice.

use dynabs::abstraction::inputs::InputAbstraction;
use dynabs::controller::{Controller, Decision};
use dynabs::landing::Question;
use dynabs::model_file::{Document, StatedProblem};
use dynabs::partition::CellId;
use dynabs::problem::InputProblem;
use dynabs::task::{CellTask, Standing};
use imdp::solver::SolverOptions;
use serde_json::{Value, json};
use std::path::Path;

/// The state is in `[−2, 2)`, in so many cells of so many points each.
const CELLS: usize = 16;
const POINTS: usize = 16;
const H: f64 = 4.0 / (CELLS * POINTS) as f64;
const STEPS: usize = 4;
const INPUTS: [f64; 3] = [-0.5, 0.0, 0.5];
/// Sub-cells of a cell.
const FINE: usize = 2;
/// What midpoints may err.
const TOLERANCE: f64 = 2e-3;

type Dynamics = fn(f64, f64, f64) -> f64;
type Cdf = fn(f64) -> f64;

/// `x`, `u` and the parameter `p` to the next state; whether it is periodic.
const SYSTEMS: [(&str, Dynamics, bool); 12] = [
    ("0.5*x + u", |x, u, _| 0.5 * x + u, false),
    ("0.9*x + 0.7*u", |x, u, _| 0.9 * x + 0.7 * u, false),
    ("1.1*x + u", |x, u, _| 1.1 * x + u, false),
    ("x + 0.3*sin(3*x) + u", |x, u, _| x + 0.3 * (3.0 * x).sin() + u, false),
    ("x - 0.2*x^3 + u", |x, u, _| x - 0.2 * x * x * x + u, false),
    ("cos(2*x) + u", |x, u, _| (2.0 * x).cos() + u, false),
    ("0.8*abs(x) - 0.6 + u", |x, u, _| 0.8 * x.abs() - 0.6 + u, false),
    ("atan(2*x) + u", |x, u, _| (2.0 * x).atan() + u, false),
    ("clip(1.2*x, -1.1, 1.3) + u", |x, u, _| (1.2 * x).clamp(-1.1, 1.3) + u, false),
    ("p*x + u", |x, u, p| p * x + u, false),
    ("x + u + 0.1*p", |x, u, p| x + u + 0.1 * p, true),
    ("max(x - 0.3, 0.5*x) + u*exp(-x^2)", |x, u, _| (x - 0.3).max(0.5 * x) + u * (-x * x).exp(), false),
];
/// Ends and middle of the parameter.
const PARAMETERS: [f64; 3] = [0.75, 0.875, 1.0];

fn noises() -> [(Value, Cdf); 5] {
    [
        (json!({"gaussian": {"deviation": 0.2}}), |x| 0.5 * erfc(-x / (0.2 * std::f64::consts::SQRT_2))),
        (json!({"uniform": {"lower": -0.3, "upper": 0.4}}), |x| ((x + 0.3) / 0.7).clamp(0.0, 1.0)),
        (json!({"triangular": {"lower": -0.5, "mode": 0.1, "upper": 0.5}}), |x| {
            let x = x.clamp(-0.5, 0.5);
            if x < 0.1 { (x + 0.5) * (x + 0.5) / 0.6 } else { 1.0 - (0.5 - x) * (0.5 - x) / 0.4 }
        }),
        (json!({"laplace": {"mean": 0.05, "scale": 0.15}}), |x| {
            let x = (x - 0.05) / 0.15;
            if x < 0.0 { 0.5 * x.exp() } else { 1.0 - 0.5 * (-x).exp() }
        }),
        (json!({"logistic": {"scale": 0.1}}), |x| 1.0 / (1.0 + (-x / 0.1).exp())),
    ]
}

/// The complementary error function, to about 1e-7 (Abramowitz and Stegun 7.1.26).
fn erfc(x: f64) -> f64 {
    let t = 1.0 / (1.0 + 0.327_591_1 * x.abs());
    let series = [1.061_405_429, -1.453_152_027, 1.421_413_741, -0.284_496_736, 0.254_829_592];
    let tail = series.iter().fold(0.0, |sum, a| (sum + a) * t) * (-x * x).exp();
    if x >= 0.0 { tail } else { 2.0 - tail }
}

/// One of the cases, with everything that its truth depends on.
struct Case {
    name: String,
    problem: InputProblem,
    dynamics: Dynamics,
    parameters: &'static [f64],
    periodic: bool,
    cdf: Cdf,
    stay: bool,
    /// To be reached or kept.
    wanted: [f64; 2],
    /// Unsafe below this.
    wall: f64,
}

fn cases() -> Vec<Case> {
    let mut cases = vec![];
    for (s, (text, dynamics, periodic)) in SYSTEMS.into_iter().enumerate() {
        for (n, (noise, cdf)) in noises().into_iter().enumerate() {
            let stay = (s + n) % 2 == 1;
            // On faces of the grid, or between points somewhere in a cell.
            let whole = if stay { ([-1.5, 1.5], -2.0) } else { ([1.0, 1.5], -1.5) };
            let cut = if stay { ([-101.0 * H, 101.0 * H], -2.0) } else { ([57.0 * H, 103.0 * H], -91.0 * H) };
            for (wanted, wall) in if (s + n) % 3 == 0 { vec![whole, cut] } else { vec![whole] } {
                let wanted_box = json!([{"lower": [wanted[0]], "upper": [wanted[1]]}]);
                let task = if stay {
                    json!({"type": "stay", "safe": wanted_box, "horizon": STEPS})
                } else {
                    json!({"goal": wanted_box, "unsafe": [{"lower": [-2], "upper": [wall]}], "horizon": STEPS})
                };
                let model = json!({
                    "name": "case",
                    "dynamics": {"states": ["x"], "inputs": ["u"], "next": [text], "parameters": {"p": [0.75, 1]}},
                    "noise": {"components": [noise]},
                    "input": {"lower": [-0.5], "upper": [0.5], "points": [3]},
                    "partition": {"lower": [-2], "upper": [2], "cells": [CELLS], "periodic": [periodic], "resolution": [FINE]},
                    "task": task
                });
                let document = Document::parse(Path::new("case.json"), &model.to_string()).unwrap();
                let StatedProblem::Inputs(problem) = document.stated().unwrap() else { panic!("not inputs") };
                let parameters: &[f64] = if text.contains('p') && text != "clip(1.2*x, -1.1, 1.3) + u" {
                    &PARAMETERS
                } else {
                    &[1.0]
                };
                let name = format!("{text}, {noise}, {} {wanted:?}", if stay { "stay in" } else { "reach" });
                cases.push(Case {
                    name,
                    problem: *problem,
                    dynamics,
                    parameters,
                    periodic,
                    cdf,
                    stay,
                    wanted,
                    wall,
                });
            }
        }
    }
    cases
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Goal,
    Lost,
    Open,
}

/// The middle of a point.
fn middle(point: usize) -> f64 {
    -2.0 + (point as f64 + 0.5) * H
}

impl Case {
    /// What a point is.
    fn at(&self, point: usize) -> Kind {
        let x = middle(point);
        match (self.wanted[0] < x && x < self.wanted[1], self.stay) {
            (false, true) => Kind::Lost,
            (true, false) => Kind::Goal,
            _ if x < self.wall => Kind::Lost,
            _ => Kind::Open,
        }
    }

    /// What a cell is in the worst of its points.
    fn kind(&self, cell: usize) -> Kind {
        let points = || (0..POINTS).map(|i| self.at(cell * POINTS + i));
        if points().any(|kind| kind == Kind::Lost) {
            Kind::Lost
        } else if points().all(|kind| kind == Kind::Goal) {
            Kind::Goal
        } else {
            Kind::Open
        }
    }

    /// What something is worth at the start.
    fn worth(&self, kind: Kind) -> f64 {
        let won = if self.stay { Kind::Open } else { Kind::Goal };
        f64::from(u8::from(kind == won))
    }

    /// The probability that noise leads from `m` into an interval, or into one that is the same turned around.
    fn mass(&self, m: f64, from: f64, to: f64) -> f64 {
        let direct = |shift: f64| (self.cdf)(to + shift - m) - (self.cdf)(from + shift - m);
        if self.periodic { [-8.0, -4.0, 0.0, 4.0, 8.0].into_iter().map(direct).sum() } else { direct(0.0) }
    }

    /// Worst and best values of all points after all steps: of the inputs of a controller, and of the best ones.
    fn truth(&self, decide: impl Fn(usize, u64) -> Option<u32>) -> (Vec<f64>, Vec<f64>) {
        let points = CELLS * POINTS;
        // By point, input and parameter: the masses that lead to all points.
        let row = |i: usize, u: f64, p: f64| -> Vec<f64> {
            let m = (self.dynamics)(middle(i), u, p);
            (0..points).map(|j| self.mass(m, middle(j) - H / 2.0, middle(j) + H / 2.0)).collect()
        };
        let rows =
            |i: usize| INPUTS.map(|u| self.parameters.iter().map(|&p| row(i, u, p)).collect::<Vec<_>>());
        let open: Vec<usize> = (0..points).filter(|&i| self.at(i) == Kind::Open).collect();
        let rows: Vec<_> = open.iter().map(|&i| rows(i)).collect();
        let start: Vec<f64> = (0..points).map(|i| self.worth(self.at(i))).collect();
        let (mut of_controller, mut best) = (start.clone(), start);
        for left in 1..=STEPS {
            let (old, old_best) = (of_controller.clone(), best.clone());
            for (&i, rows) in open.iter().zip(&rows) {
                let expected = |row: &Vec<f64>, v: &[f64]| row.iter().zip(v).map(|(p, v)| p * v).sum::<f64>();
                let decided = decide(i / POINTS, (STEPS - left) as u64);
                of_controller[i] = decided.map_or(0.0, |input| {
                    rows[input as usize].iter().map(|row| expected(row, &old)).fold(1.0, f64::min)
                });
                best[i] = rows.iter().flatten().map(|row| expected(row, &old_best)).fold(0.0, f64::max);
            }
        }
        (of_controller, best)
    }

    /// The lower bound as one would compute it who thinks of everything but, perhaps, one thing.
    fn bound(&self, forgotten: Option<Forgotten>) -> Vec<f64> {
        let pitch = 4.0 / (CELLS * FINE) as f64;
        let sub_cells = (CELLS * FINE) as i64;
        let taps: Vec<(i64, f64)> = (-64..64)
            .map(|k| (k, (self.cdf)((k + 1) as f64 * pitch) - (self.cdf)(k as f64 * pitch)))
            .collect();
        let near: Vec<(i64, f64)> = taps.iter().copied().filter(|(k, _)| (-2..2).contains(k)).collect();
        let listed: f64 = near.iter().map(|(_, p)| p).sum();
        let taps = match forgotten {
            // As if the noise had no more than what is near.
            Some(Forgotten::Tail) => near.iter().map(|&(k, p)| (k, p / listed)).collect(),
            _ => taps,
        };
        let mut values: Vec<f64> = (0..CELLS).map(|cell| self.worth(self.kind(cell))).collect();
        for _ in 0..STEPS {
            let at = |i: i64| {
                let i = if self.periodic { i.rem_euclid(sub_cells) } else { i };
                if (0..sub_cells).contains(&i) { values[i as usize / FINE] } else { 0.0 }
            };
            let landed = |i: i64| {
                let of_tap = |&(k, p): &(i64, f64)| match forgotten {
                    Some(Forgotten::Neighbour) => p * at(i + k),
                    _ => p * at(i + k).min(at(i + k + 1)),
                };
                taps.iter().map(of_tap).sum::<f64>()
            };
            let new = |cell: usize| {
                if self.kind(cell) != Kind::Open {
                    return values[cell];
                }
                let worth = |u: f64| {
                    let states = (0..=64).map(|i| -2.0 + (cell as f64 + f64::from(i) / 64.0) * 0.25);
                    let images =
                        states.flat_map(|x| self.parameters.iter().map(move |&p| (self.dynamics)(x, u, p)));
                    let (a, b) = images.fold((9.0f64, -9.0f64), |(a, b), m| (a.min(m), b.max(m)));
                    let (a, b) = ((a + 2.0) / pitch, (b + 2.0) / pitch);
                    let (first, last) = match forgotten {
                        // Inwards instead of outwards.
                        Some(Forgotten::Rounding) => {
                            (a.ceil() as i64, (b.ceil() as i64 - 1).max(a.ceil() as i64))
                        }
                        _ => (a.floor() as i64, b.ceil() as i64 - 1),
                    };
                    (first..=last.max(first)).map(landed).fold(1.0, f64::min)
                };
                INPUTS.into_iter().map(worth).fold(0.0, f64::max)
            };
            values = (0..CELLS).map(new).collect();
        }
        values
    }
}

#[derive(Clone, Copy)]
enum Forgotten {
    Rounding,
    Tail,
    Neighbour,
}

#[test]
fn bounds_enclose_the_truth() {
    let (mut caught, mut too_low) = ([0; 3], 0);
    let mut promised = 0;
    for case in cases() {
        let abstraction = InputAbstraction::new(&case.problem).unwrap();
        let solution = abstraction.question().solve(&SolverOptions::default());
        let controller = Controller::of_inputs(&case.problem, &abstraction, &solution);
        let decide = |cell: usize, elapsed: u64| match controller.decide(
            Standing::Open(0),
            CellId(cell as u32),
            elapsed,
        ) {
            Decision::Act { action } => Some(action),
            _ => None,
        };
        let (of_controller, best) = case.truth(decide);
        let of_cell = |values: &[f64], cell: usize| values[cell * POINTS..(cell + 1) * POINTS].to_vec();
        let too_high = |bound: &[f64], truth: &[f64]| {
            let exceeds = |cell: &usize| {
                of_cell(truth, *cell).into_iter().any(|truth| bound[*cell] > truth + TOLERANCE)
            };
            (0..CELLS).find(exceeds)
        };
        let values = &solution.values;
        // As if the regions were the cells inside, which is where the lower bounds are from.
        let kinds = case.problem.labels().kinds();
        let inside = CellTask::of_kinds(case.problem.objective().aim(), kinds, kinds);
        let inside =
            Question { task: &inside, ..abstraction.question() }.solve(&SolverOptions::default()).values;
        assert_eq!(inside.lower, values.lower, "{}", case.name);
        if let Some(cell) = too_high(&values.lower, &of_controller) {
            panic!(
                "{}: {} promised in cell {cell}: {:?}",
                case.name,
                values.lower[cell],
                of_cell(&of_controller, cell)
            );
        }
        for cell in 0..CELLS {
            let most = of_cell(&best, cell).into_iter().fold(0.0, f64::max);
            assert!(
                values.upper[cell] >= most - TOLERANCE,
                "{}: {} in cell {cell}",
                case.name,
                values.upper[cell]
            );
            too_low += usize::from(inside.upper[cell] < most - TOLERANCE);
        }
        promised += values.lower.iter().filter(|&&v| v > 0.05 && v < 0.95).count();
        // Nobody does better than the best: a bound above it is wrong whatever the controller.
        assert_eq!(too_high(&case.bound(None), &best), None, "{}", case.name);
        for (caught, forgotten) in
            caught.iter_mut().zip([Forgotten::Rounding, Forgotten::Tail, Forgotten::Neighbour])
        {
            *caught += usize::from(too_high(&case.bound(Some(forgotten)), &best).is_some());
        }
    }
    assert!(promised > 200, "{promised} bounds that say something");
    assert!(caught.iter().all(|&caught| caught >= 5), "{caught:?}");
    assert!(too_low >= 20, "{too_low} upper bounds for the cells inside are too low for the regions");
}
