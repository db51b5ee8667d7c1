//! How long a step takes on a model of the size of the double integrator.
//!
//! `cargo test --release --test solver -- --ignored --nocapture`.

use super::models::{self, set};
use super::*;
use std::time::Instant;

fn grid_sets(model: &IntervalMdp) -> (StateSet, StateSet) {
    let states = model.num_states();
    let unsafe_cells = 41 * 10..41 * 10 + 30;
    let safe: Vec<usize> = (0..states).filter(|s| !unsafe_cells.contains(s)).collect();
    (set(states, &safe), set(states, &[20 * 41 + 20]))
}

#[test]
fn results_do_not_depend_on_threads() {
    let model = models::grid_model();
    let (safe, goal) = grid_sets(&model);
    for (resolution, _) in RESOLUTIONS {
        let run = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| until(&model, &safe, &goal, Some(5), resolution))
        };
        assert_eq!(run(1), run(3));
    }
}

#[test]
#[ignore = "a measurement"]
fn double_integrator_speed() {
    let model = models::grid_model();
    println!("{:?}", model.size());
    let (safe, goal) = grid_sets(&model);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    for (steps, policy) in [(Some(16), false), (Some(16), true), (None, true)] {
        let mut best = f64::INFINITY;
        let mut last = None;
        for _ in 0..30 {
            let start = Instant::now();
            let query = Query::Until { safe: &safe, goal: &goal, steps };
            let options = SolverOptions { policy, ..Default::default() };
            last = Some(pool.install(|| solve(&model, &query, Resolution::Pmaxmin, &options).unwrap()));
            best = best.min(start.elapsed().as_secs_f64());
        }
        let solution = last.unwrap();
        println!(
            "steps {steps:?} policy {policy}: {:.2} ms, {} iterations, {:?}, gap {:e}, value {}",
            best * 1e3,
            solution.iterations,
            solution.status,
            solution.values.gap(),
            solution.values.lower[0]
        );
    }
}
