#!/bin/sh
# Everything in the experiments of the paper, computed again: Table I, the figure of the double integrator, the
# four spacecraft cases; each beside the published numbers, in reference and in pac mode.
#
#   scripts/reproduce-paper.sh [--keep] [DIRECTORY]
#
# Writes DIRECTORY/index.html and DIRECTORY/results.md (default out/paper). Needs Rust, Python 3 and 3 GB of disk for
# the time being; --keep leaves the PRISM files there (8 GB). Ends with 1 if a published number is not reproduced.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
(cd "$root" && cargo build --release --bins)
exec python3 "$root/scripts/reproduce_paper/main.py" \
    --dynabs "${CARGO_TARGET_DIR:-$root/target}/release" "$@"
