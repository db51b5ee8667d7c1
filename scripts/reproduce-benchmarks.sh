#!/bin/sh
# The benchmarks of models/benchmarks, each beside the figures published for it.
#
#   scripts/reproduce-benchmarks.sh [--only NAME ...] [DIRECTORY]
#
# Writes DIRECTORY/results.md and results.json (default out/benchmarks): cells, inputs, resolution, bound, simulated
# value, time, memory. Needs Rust, Python 3 and 8 GB of memory for drone_3d_obstacles, which takes the longest; --only
# leaves out all others. Ends with 1 if a bound is below what docs/benchmarks.md states.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
(cd "$root" && cargo build --release --bins)
exec python3 "$root/scripts/reproduce_benchmarks.py" \
    --dynabs "${CARGO_TARGET_DIR:-$root/target}/release" "$@"
