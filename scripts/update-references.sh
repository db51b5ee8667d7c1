#!/bin/sh
# Regenerates tests/references and prints what changed against the references kept so far.
#
#   scripts/update-references.sh [MODEL...]
#
# Without arguments: every model in models/. Exits with 1 if a reference changed.
set -eu
cd "$(dirname "$0")/.."

cargo build --release --bins
bin="${CARGO_TARGET_DIR:-target}/release"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

if [ $# -eq 0 ]; then
    for file in models/*.json; do
        case $file in *.schema.json) ;; *) set -- "$@" "$(basename "$file" .json)" ;; esac
    done
fi

mkdir -p tests/references
changed=0
for model in "$@"; do
    for mode in pac reference; do
        case $mode in
            pac) probabilities='{"mode":"pac","confidence":0.99}' ;;
            reference) probabilities='{"mode":"reference","beta_per_interval":0.01}' ;;
        esac
        reference="tests/references/$model.$mode.json"
        run="$scratch/$model.$mode"
        "$bin/dynabs-compile" "models/$model.json" -o "$run" --no-tra --quiet --set "/probabilities=$probabilities"
        if [ -e "$reference" ]; then
            echo "$model ($mode):"
            status=0
            "$bin/dynabs-check" diff "$reference" "$run" || status=$?
            # 1 is a difference; a reference that cannot be read is replaced, too.
            [ "$status" -eq 0 ] || changed=1
        else
            echo "$model ($mode): new"
            changed=1
        fi
        "$bin/dynabs-check" diff --write-reference "$reference" "$run"
    done
done
exit "$changed"
