//! What ids cost that are types: the same work with numbers and with ids, in the same run.
//!
//! `cargo bench --bench ids`; the two of a pair differ by noise only.
#![allow(missing_docs, unreachable_pub)]

use criterion::{Criterion, criterion_group, criterion_main};
use imdp::model::StateId;
use std::hint::black_box;

const STATES: usize = 1 << 16;
const ENTRIES: usize = 1 << 20;

/// `Σ values[successor]`, as every step of a solver does it.
fn of_numbers(successors: &[u32], values: &[f64]) -> f64 {
    successors.iter().map(|&successor| values[successor as usize]).sum()
}

fn of_ids(successors: &[StateId], values: &[f64]) -> f64 {
    successors.iter().map(|&successor| values[successor.index()]).sum()
}

fn benchmark(criterion: &mut Criterion) {
    let values: Vec<f64> = (0..STATES).map(|state| state as f64).collect();
    // A fixed walk through all states, as unordered as successors are.
    let numbers: Vec<u32> = (0..ENTRIES).map(|i| (i * 40_503 % STATES) as u32).collect();
    let ids: Vec<StateId> = numbers.iter().copied().map(StateId).collect();
    let mut sum = criterion.benchmark_group("sum over successors");
    sum.bench_function("numbers", |bencher| bencher.iter(|| of_numbers(black_box(&numbers), &values)));
    sum.bench_function("ids", |bencher| bencher.iter(|| of_ids(black_box(&ids), &values)));
    sum.finish();
    let mut sort = criterion.benchmark_group("sort successors");
    sort.sample_size(20);
    sort.bench_function("numbers", |bencher| bencher.iter_with_large_drop(|| sorted(&numbers)));
    sort.bench_function("ids", |bencher| bencher.iter_with_large_drop(|| sorted(&ids)));
    sort.finish();
}

fn sorted<T: Ord + Clone>(entries: &[T]) -> Vec<T> {
    let mut entries = entries.to_vec();
    entries.sort_unstable();
    entries
}

criterion_group!(benches, benchmark);
criterion_main!(benches);
