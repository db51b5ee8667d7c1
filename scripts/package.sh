#!/usr/bin/env bash
# Builds the archive of a release: static programs for Linux with manual pages, completions, the licence and what they are made of.
#
#   scripts/package.sh [DIRECTORY]
#
# DIRECTORY, target/archive by default, gets dynabs-VERSION-x86_64-linux.tar.gz and its SHA-256. It takes Debian's package musl-tools
# (a few functions are compiled from C). The same commit and compiler give the same bytes.
set -euo pipefail
cd "$(dirname "$0")/.."

triple=x86_64-unknown-linux-musl
target=${CARGO_TARGET_DIR:-target}
out=${1:-$target/archive}
version=$(sed -n '/^\[workspace\.package\]/,/^\[/s/^version = "\(.*\)"/\1/p' Cargo.toml)
name=dynabs-$version-x86_64-linux

if ! command -v musl-gcc >/dev/null; then
    echo "error: found no musl-gcc; expected a C compiler for musl: install Debian's package musl-tools" >&2
    exit 1
fi
rustup target add $triple 2>/dev/null || true # there already where the toolchain came with it

echo "== licences"
PATH="$PATH:$target/cargo-deny/bin" cargo deny --all-features check licenses

echo "== programs"
# The C compiler is for what is written in C; Rust links with what it brings along.
CC_x86_64_unknown_linux_musl=musl-gcc cargo build --release --locked --target $triple -p dynabs-cli --bins

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
root=$scratch/$name
mkdir -p "$root/bin" "$root/share/man/man1" "$root/share/bash-completion/completions" \
    "$root/share/zsh/site-functions" "$root/share/fish/vendor_completions.d"
for program in dynabs dynabs-compile dynabs-check; do
    strip -o "$root/bin/$program" "$target/$triple/release/$program"
    if ldd "$root/bin/$program" 2>&1 | grep -q '=>'; then
        echo "error: found a $program that needs libraries; expected a static one" >&2
        exit 1
    fi
done

echo "== a run of what is packed"
dynabs=$root/bin/dynabs
[ "$("$dynabs" --version)" = "dynabs $version" ]
"$dynabs" compile models/room_temperature.json --solve -o "$scratch/room"
"$dynabs" solve "$scratch/room" -q -p 'Pmaxmin=? [ F "reached" ]' --certificate "$scratch/room.cert"
"$dynabs" verify "$scratch/room.cert" "$scratch/room"

echo "== archive"
"$dynabs" man "$root/share/man/man1"
"$dynabs" completions bash >"$root/share/bash-completion/completions/dynabs"
"$dynabs" completions zsh >"$root/share/zsh/site-functions/_dynabs"
"$dynabs" completions fish >"$root/share/fish/vendor_completions.d/dynabs.fish"
cp LICENSE README.md CHANGELOG.md CITATION.cff "$root"
scripts/sbom.py --platform $triple >"$root/sbom.cdx.json"
mkdir -p "$out"
tar --create --directory "$scratch" --sort=name --owner=0 --group=0 --numeric-owner --mode=go+rX,go-w \
    --mtime="@$(git log -1 --format=%ct)" "$name" | gzip -9n >"$out/$name.tar.gz"
(cd "$out" && sha256sum "$name.tar.gz" | tee "$name.tar.gz.sha256")
ls -l "$out/$name.tar.gz"
