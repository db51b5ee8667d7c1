//! Benchmarks of the compiler.
fn main() {}
