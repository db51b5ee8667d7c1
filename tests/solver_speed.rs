//! How long a step takes on a model of the size of the double integrator. Run with `--release -- --ignored`.

use dynabs::imdp::*;
use dynabs::property::Resolution;
use dynabs::solver::{Query, SolverOptions, solve};
use std::time::Instant;

/// 41 × 41 cells, rows that spread over 39 neighbours of their target, and ranges of targets per state.
fn grid_model() -> IntervalMdp {
    let n = 41i64;
    let outside = (n * n) as u32;
    let mut rows = Rows::new();
    for i in 0..n {
        for j in 0..n {
            let mut left = 1.0;
            let mut entries = vec![];
            for (di, dj) in (-4..=4i64).flat_map(|di| (-2..=2i64).map(move |dj| (di, dj))) {
                if (di.abs() + 2 * dj.abs()) > 6 {
                    continue;
                }
                let p = 0.13 * (-0.25 * (di * di) as f64 - 0.7 * (dj * dj) as f64).exp();
                let (i, j) = (i + di, j + dj);
                if (0..n).contains(&i) && (0..n).contains(&j) {
                    entries.push(((i * n + j) as u32, (p - 0.006).max(0.0), p + 0.008));
                    left -= (p - 0.006).max(0.0);
                }
            }
            entries.push((outside, 0.0, left.max(0.01).min(1.0)));
            for (s, l, u) in entries {
                rows.push_entry(s, l, u);
            }
            rows.finish_row();
        }
    }
    let mut builder = ChoicesBuilder::with_capacity((n * n + 1) as usize);
    for i in 0..n {
        for j in 0..n {
            for t in (i - 12).max(0)..=(i + 12).min(n - 1) {
                let first = t * n + (j - 14).max(0);
                let last = t * n + (j + 14).min(n - 1);
                builder.push_range(RowRange { first: first as u32, last: last as u32 });
            }
            builder.finish_state();
        }
    }
    builder.push_absorbing();
    let states = (n * n + 1) as usize;
    let mut initial = StateSet::with_capacity(states);
    initial.insert(0);
    IntervalMdp::new(Parts {
        kind: ModelKind::Imdp,
        rows,
        choices: builder.finish(),
        actions: ActionNames::OfRow,
        initial,
        labels: Labels::default(),
        variables: StateVariables::default(),
    })
    .unwrap()
}

#[test]
#[ignore = "a measurement"]
fn double_integrator_speed() {
    let model = grid_model();
    println!("{:?}", model.size());
    let states = model.num_states();
    let mut goal = StateSet::with_capacity(states);
    goal.insert(20 * 41 + 20);
    let mut safe = StateSet::with_capacity(states);
    safe.insert_range(..);
    for s in 0..30 {
        safe.set(41 * 10 + s, false);
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    for (steps, policy) in [(Some(16), false), (Some(16), true)] {
        let mut best = f64::INFINITY;
        let mut last = None;
        for _ in 0..10 {
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
