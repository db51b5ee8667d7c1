//! Everything but writing, for the largest row of Table I: 39.8 million transitions in `reference` mode.
#![allow(missing_docs, clippy::unwrap_used, unreachable_pub)]

use criterion::{Criterion, criterion_group, criterion_main};
use dynabs::abstraction::compile;
use dynabs::model_file::Document;
use dynabs::problem::Problem;
use imdp::model::{RowBuffer, StateId};
use imdp::solver::{Answer, SolverOptions};
use std::path::Path;

fn problem(set: &str) -> Problem {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/models/double_integrator.json"));
    let mut document = Document::parse(path, &std::fs::read_to_string(path).unwrap()).unwrap();
    document.set(&set.parse().unwrap()).unwrap();
    document.set(&"/task/horizon=32".parse().unwrap()).unwrap();
    document.problem().unwrap()
}

fn benchmark(criterion: &mut Criterion) {
    for mode in ["reference", "pac"] {
        let problem = problem(&format!("/probabilities={{\"mode\":\"{mode}\"}}"));
        let mut group = criterion.benchmark_group(format!("double_integrator/{mode}"));
        group.sample_size(20);
        group.bench_function("compile", |bencher| bencher.iter(|| compile(&problem, &()).unwrap()));
        let compiled = compile(&problem, &()).unwrap();
        let solve = || Answer::new(&compiled.model, &compiled.property, &SolverOptions::default()).unwrap();
        group.bench_function("16 steps", |bencher| bencher.iter(solve));
        // The alternative to rows and ranges: one pass over all transitions with the least work that a solver
        // which expands them could do.
        let model = &compiled.model;
        let values = solve().values.lower;
        group.bench_function("one step over expanded transitions", |bencher| {
            bencher.iter(|| {
                let mut best = vec![0.0f64; model.num_states()];
                for state in StateId::first(model.num_states()) {
                    for row in model.choices().rows(state) {
                        let buffer = &mut RowBuffer::default();
                        let row = model.rows().row(row, buffer);
                        let value: f64 =
                            row.successors.iter().zip(row.lower).map(|(&s, l)| l * values[s.index()]).sum();
                        best[state.index()] = best[state.index()].max(value);
                    }
                }
                best
            });
        });
        group.finish();
    }
}

criterion_group!(benches, benchmark);
criterion_main!(benches);
