//! Steps of differential equations against closed forms and fine integration.

use super::{SampledLinear, TaylorError, TaylorStep};
use crate::linear_algebra::ExactMatrix;
use crate::system::expression::{Graph, NodeId, Scope, Tape, parse};
use crate::system::{Interval, LinearSystem, Variable};
use imdp::numeric::{Rational, from_decimal};
use nalgebra::DMatrix;

fn exact(x: f64) -> Rational {
    from_decimal(x).unwrap()
}

fn matrix(rows: usize, entries: &[f64]) -> ExactMatrix {
    ExactMatrix::from_decimals(&DMatrix::from_row_slice(rows, entries.len() / rows, entries)).unwrap()
}

fn holds_tightly(enclosure: Interval, value: f64) {
    let nearby = Interval::new(value - 1e-14 * (1.0 + value.abs()), value + 1e-14 * (1.0 + value.abs()));
    assert!(nearby.encloses(enclosure), "{enclosure:?} is not {value}");
}

#[test]
fn integrators_are_exact() {
    let system =
        LinearSystem::new(matrix(2, &[0.0, 1.0, 0.0, 0.0]), matrix(2, &[0.0, 1.0]), ExactMatrix::zeros(2, 1));
    let sampled = SampledLinear::new(&system, &exact(0.1)).unwrap();
    assert!(sampled.is_exact());
    let mode = sampled.mode(Variable::numbered("x", 2), Variable::numbered("u", 1));
    let linear = mode.as_linear().unwrap();
    assert_eq!(*linear.a(), matrix(2, &[1.0, 0.1, 0.0, 1.0]));
    assert_eq!(*linear.b(), matrix(2, &[0.005, 0.1]));
}

#[test]
fn exponentials_are_enclosed_tightly() {
    // A rotation with damping, and a stiff scalar.
    let system = LinearSystem::new(
        matrix(3, &[-0.5, 3.0, 0.0, -3.0, -0.5, 0.0, 0.0, 0.0, -20.0]),
        matrix(3, &[0.0, 0.0, 20.0]),
        matrix(3, &[0.0, 0.0, 1.0]),
    );
    let sampled = SampledLinear::new(&system, &exact(0.7)).unwrap();
    let decay = (-0.35f64).exp();
    holds_tightly(sampled.entry(0, 0), decay * 2.1f64.cos());
    holds_tightly(sampled.entry(0, 1), decay * 2.1f64.sin());
    holds_tightly(sampled.entry(2, 3), 1.0 - (-14f64).exp());
    holds_tightly(sampled.entry(2, 4), (1.0 - (-14f64).exp()) / 20.0);
    assert!(!sampled.is_exact());
    assert!(SampledLinear::new(&system, &exact(10.0)).is_err());
}

fn rates(texts: &[&str], graph: &mut Graph) -> Vec<NodeId> {
    let mut scope = Scope::default();
    for (number, name) in ["x", "y", "u"].iter().enumerate() {
        let variable = graph.variable(number as u32);
        scope.insert(name, variable).unwrap();
    }
    texts.iter().map(|text| parse(graph, &scope, text, text).unwrap()).collect()
}

/// Runge and Kutta with steps so small that their error does not count here.
fn integrated(tape: &Tape, start: [f64; 3], time: f64) -> [f64; 2] {
    let mut x = start;
    let mut slots = Vec::new();
    let steps = 2000;
    let h = time / f64::from(steps);
    let mut slope = |x: [f64; 3]| {
        let mut out = [0.0; 2];
        tape.at_point(&x, &mut slots, &mut out);
        out
    };
    for _ in 0..steps {
        let moved = |k: [f64; 2], t: f64| [x[0] + t * k[0], x[1] + t * k[1], x[2]];
        let k1 = slope(x);
        let k2 = slope(moved(k1, h / 2.0));
        let k3 = slope(moved(k2, h / 2.0));
        let k4 = slope(moved(k3, h));
        for j in 0..2 {
            x[j] += h / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]);
        }
    }
    [x[0], x[1]]
}

#[test]
fn flows_are_enclosed() {
    let domain = [Interval::new(-2.0, 2.0), Interval::new(-2.0, 2.0), Interval::new(-1.0, 1.0)];
    for texts in [["y", "(1 - x^2)*y - x + u"], ["y", "-sin(x) - 0.2*y + u"], ["-x + u*y", "x - y/(2 + x^2)"]]
    {
        let mut graph = Graph::default();
        let roots = rates(&texts, &mut graph);
        let field = Tape::new(&graph, &roots);
        let step = TaylorStep::find(&mut graph, &roots, &exact(0.2), 2, &domain).unwrap();
        assert!(step.remainder < 4e-4);
        let next = Tape::new(&graph, &step.next);
        for i in 0..60u32 {
            let at = |k: u32| f64::from((i * k) % 41) / 40.0;
            let start = [4.0 * at(7) - 2.0, 4.0 * at(11) - 2.0, 2.0 * at(13) - 1.0];
            let mut enclosure = [Interval::ZERO; 2];
            next.on_box(&start.map(Interval::point), &mut Vec::new(), &mut enclosure);
            for (enclosure, value) in enclosure.iter().zip(integrated(&field, start, 0.4)) {
                assert!(enclosure.contains(value), "{texts:?} from {start:?}: {enclosure:?} misses {value}");
                assert!(enclosure.width() < 3e-2, "{enclosure:?}");
            }
        }
    }
}

#[test]
fn kinks_and_explosions_are_refused() {
    let domain = [Interval::new(-2.0, 2.0); 3];
    let mut graph = Graph::default();
    let roots = rates(&["y", "abs(x)"], &mut graph);
    let error = TaylorStep::find(&mut graph, &roots, &exact(0.1), 1, &domain).unwrap_err();
    assert!(matches!(error, TaylorError::Kink { name: "abs", .. }));
    assert_eq!(error.place(&graph), Some(("abs(x)", 1)));
    let mut graph = Graph::default();
    let roots = rates(&["10*x^3", "y"], &mut graph);
    let error = TaylorStep::find(&mut graph, &roots, &exact(1.0), 1, &domain).unwrap_err();
    assert_eq!(error, TaylorError::NotBounded);
}
