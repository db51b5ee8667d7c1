#!/usr/bin/env bash
# Writes Table I's largest .tra (1.4 GB) and compares with dd on the same disk; both end with fdatasync.
#
# Usage: scripts/benchmark-writing.sh [DIRECTORY] [ROUNDS]
set -euo pipefail
cd "$(dirname "$0")/.."
directory=$(mktemp -d -p "${1:-.}")
rounds=${2:-3}
trap 'rm -rf "$directory"' EXIT
cargo build --release --locked --quiet
compile=target/release/dynabs-compile

seconds() { # runs a command, prints its wall time
  local start end
  start=$(date +%s.%N)
  "$@" >"$directory/log" 2>&1
  end=$(date +%s.%N)
  echo "$start $end" | awk '{ print $2 - $1 }'
}

for round in $(seq "$rounds"); do
  rm -rf "$directory/out" "$directory/dd"
  ours=$(seconds "$compile" models/double_integrator.json -o "$directory/out" --quiet --format prism \
    --set '/probabilities={"mode":"reference"}')
  bytes=$(stat -c %s "$directory/out/model.tra")
  dd=$(seconds dd if=/dev/zero of="$directory/dd" bs=1M count=$((bytes / 1048576)) conv=fdatasync)
  echo "$round $bytes $ours $dd" | awk '{ printf "round %d: %d bytes, dynabs-compile %.2f s, dd %.2f s: %.0f %% of dd\n", $1, $2, $3, $4, 100 * $4 / $3 }'
done
