//! A control problem stated in memory: no model file, no JSON.
//!
//! A cart with position and velocity is to come to rest near the origin, and not to leave the track. The noise is known
//! by samples only.

use dynabs::abstraction::compile;
use dynabs::problem::{
    GivenSamples, InputSet, LinearDynamics, Partition, Probabilities, Problem, RegionBox, SampleKind, Task,
};
use imdp::solver::{Answer, SolverOptions};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let dynamics =
        LinearDynamics { a: vec![vec![1.0, 1.0], vec![0.0, 1.0]], b: vec![vec![0.5], vec![1.0]], q: None };
    // Stand-ins for measurements, one pair of numbers per step: a low-discrepancy sequence.
    let measured = (0..4000).map(|i| f64::from(i) * 0.618_033_988_749_894_9);
    let samples: Vec<f64> = measured.map(|x| 0.4 * (x.fract() - 0.5)).collect();

    let problem = Problem::builder(dynamics, InputSet::Box { lower: vec![-4.0], upper: vec![4.0] })
        .name("cart")
        .partition(Partition { lower: vec![-10.5; 2], upper: vec![10.5; 2], cells: vec![21, 21] })
        .task(
            Task::reach(vec![RegionBox { lower: vec![-1.5; 2], upper: vec![1.5; 2] }])
                .avoiding(vec![RegionBox {
                    lower: vec![9.5, f64::NEG_INFINITY],
                    upper: vec![f64::INFINITY; 2],
                }])
                .within(16)
                .at_least(0.9),
        )
        .initial_state(vec![-6.0, 0.0])
        .noise(GivenSamples { values: samples, of: SampleKind::Step })
        .probabilities(Probabilities::with_confidence(0.99)?)
        .build()?;
    for warning in problem.warnings() {
        println!("note: {warning}");
    }

    let abstraction = compile(&problem, &())?;
    let answer = Answer::new(&abstraction.model, &abstraction.property, &SolverOptions::default())?;
    println!("{}\n  at least {:.4} from (−6, 0)", abstraction.property, answer.lower);
    assert!(answer.lower > 0.5);
    Ok(())
}
