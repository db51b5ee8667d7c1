#!/usr/bin/env bash
# Compares every export of the controller (C, S-function, Python, ROS 2 node, .npz, .mat, MATLAB/Octave) with the library, bit by bit
# in 100,000 states of every shipped model: a line for each, with how often the library acts, ...
#
#   DYNABS_NUMPY=venv/bin/python DYNABS_OCTAVE=octave-cli scripts/compare-exports.sh [MODEL.json ...]
#
# needs a C compiler, a Python with NumPy and SciPy, and GNU Octave (Debian: octave).
set -euo pipefail
cd "$(dirname "$0")/.."
: "${DYNABS_NUMPY:?expected a Python with NumPy and SciPy}" "${DYNABS_OCTAVE:?expected GNU Octave}"
export DYNABS_NUMPY DYNABS_OCTAVE
if [ $# = 0 ]; then
    set -- $(ls models/*.json models/every_step/*.json models/tracking/*.json models/predecessors/*.json models/benchmarks/*.json \
        examples/*/*.json |
        grep -v schema.json)
fi
test=$(cargo test --release --locked --test main --no-run --message-format=json | sed -n 's/.*"executable":"\([^"]*main-[^"]*\)".*/\1/p')
said=$(mktemp)
trap 'rm -f "$said"' EXIT
different=0
for model in "$@"; do
    DYNABS_MODEL=$model "$test" --exact --nocapture exports::every_export_of_a_model 2>"$said" |
        grep "100,000 states" || {
        echo "$model: DIFFERENT, or not compared:"
        grep -v "^ " "$said" | head -5
        different=1
    }
done
exit $different
