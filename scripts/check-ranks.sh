#!/usr/bin/env bash
# Compares what one process makes with what several make together, byte for byte, and sees a job end when one of them dies.
#
#     check-ranks.sh DIRECTORY
#
# The directory holds dynabs-compile and dynabs-check, built with `--features mpi`. Needs mpirun and python3.
set -euo pipefail
bin=$(cd "$1" && pwd)
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# Open MPI: more processes than processors are fine here, and so is root, as in containers.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_hwloc_base_binding_policy=none
ranks() { mpirun -n "$@"; }

fail() {
    echo "error: $1" >&2
    exit 1
}

python3 scripts/random-model.py 4000 4 16 1 "$scratch/random"
for n in 0 1 2 4; do
    # 0: without mpirun.
    run() { if [ "$n" = 0 ]; then "$@"; else ranks "$n" "$@"; fi; }
    out="$scratch/$n"
    mkdir "$out"
    run "$bin/dynabs-compile" models/double_integrator.json --threads 1 -q --solve -o "$out/targets"
    run "$bin/dynabs-check" solve "$out/targets" --threads 1 -q --values "$out/targets.values" --policy "$out/targets.policy" \
        --certificate "$out/targets.certificate"
    run "$bin/dynabs-compile" models/benchmarks/integrator_n.json --threads 1 -q --solve --no-tra -o "$out/inputs"
    run "$bin/dynabs-check" solve "$out/inputs" --threads 1 -q --values "$out/inputs.values" --policy "$out/inputs.policy"
    for bounds in '<=8' ''; do
        run "$bin/dynabs-check" solve "$scratch/random.tra" --threads 1 -q -p "Pmaxmin=? [ F$bounds \"goal\" ]" \
            --values "$out/random$bounds.values" --policy "$out/random$bounds.policy" --certificate "$out/random$bounds.certificate"
    done
    diff -r "$scratch/0" "$out" || fail "$n processes do not write what one does"
done

# One says what is wrong, all end with its code.
code=0
ranks 3 "$bin/dynabs-check" solve "$scratch/none.tra" 2>"$scratch/errors" || code=$?
[ "$code" = 2 ] || fail "found exit code $code for a file that is missing; expected 2"
[ "$(grep -c '^error:' "$scratch/errors")" = 1 ] || fail "found not one error for a file that is missing: $(cat "$scratch/errors")"
code=0
ranks 2 "$bin/dynabs-check" verify "$scratch/1/targets.certificate" "$scratch/1/targets" 2>"$scratch/errors" || code=$?
[ "$code" = 2 ] || fail "found exit code $code for a command that is not shared; expected 2"

# One of them has another file: nothing is computed.
code=0
mpirun -n 1 "$bin/dynabs-compile" models/room_temperature.json --dry-run : \
    -n 1 "$bin/dynabs-compile" models/room_temperature.json --dry-run --seed 7 >"$scratch/printed" 2>"$scratch/errors" || code=$?
[ "$code" = 4 ] || fail "found exit code $code for processes with different input; expected 4: $(cat "$scratch/errors")"
grep -q '^error: found processes that have read different input' "$scratch/errors" ||
    fail "found no word of different input: $(cat "$scratch/errors")"

# One of them lacks memory: it says so, and all end.
limited() { if [ "$OMPI_COMM_WORLD_RANK" = 1 ]; then exec "$@" --memory 1M; else exec "$@"; fi; }
export -f limited
code=0
ranks 3 bash -c 'limited "$@"' limited "$bin/dynabs-check" solve "$scratch/random.tra" -p 'Pmaxmin=? [ F "goal" ]' \
    >"$scratch/printed" 2>"$scratch/errors" || code=$?
[ "$code" -gt 0 ] || fail "found exit code 0 for a process that failed"
grep -q '^error: rank 1: ' "$scratch/errors" || fail "found no word of the process that failed: $(cat "$scratch/errors")"

# One of them is killed in the middle: all end, with a word of it, and nothing is left.
long=(solve "$scratch/random.tra" --threads 1 -q -p 'Pmaxmin=? [ F<=1000000000 "goal" ]' --values "$scratch/values")
killed() { if [ "$OMPI_COMM_WORLD_RANK" = 1 ]; then (sleep 2; kill -KILL $$) & fi; exec "$@"; }
export -f killed
code=0
timeout 60 mpirun -n 3 bash -c 'killed "$@"' killed "$bin/dynabs-check" "${long[@]}" 2>"$scratch/errors" || code=$?
[ "$code" -gt 128 ] || fail "found exit code $code for a process that was killed; expected that of its signal: $(cat "$scratch/errors")"
grep -qi 'signal 9' "$scratch/errors" || fail "found no word of the process that was killed: $(cat "$scratch/errors")"
[ ! -e "$scratch/values" ] || fail "found the output of a job that did not end"
