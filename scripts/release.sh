#!/usr/bin/env bash
# Sets the version everywhere: manifests, Cargo.lock, CITATION.cff, and the heading of CHANGELOG.md.
#
#   scripts/release.sh VERSION
#
# What is to do before and after stands in CONTRIBUTING.md.
set -euo pipefail
cd "$(dirname "$0")/.."

version=${1:-}
if [[ ! $version =~ ^[0-9]+\.[0-9]+\.[0-9]+(-[0-9A-Za-z.-]+)?$ ]]; then
    echo "error: found \"$version\"; expected a version such as 0.2.0" >&2
    exit 2
fi
if [ -n "$(git status --porcelain)" ]; then
    echo "error: found changes that are not committed; expected none, so that the commit of a release has nothing else" >&2
    exit 2
fi
old=$(sed -n '/^\[workspace\.package\]/,/^\[/s/^version = "\(.*\)"/\1/p' Cargo.toml)
if [ "$old" != "$version" ] && [ "$(printf '%s\n%s\n' "$old" "$version" | sort -V | tail -1)" = "$old" ]; then
    echo "error: found $version; expected a later version than $old" >&2
    exit 2
fi
if ! grep -qx '## Unreleased' CHANGELOG.md || grep -q "^## $version\b" CHANGELOG.md; then
    echo "error: CHANGELOG.md: expected a heading \"## Unreleased\" with what is new, and none for $version" >&2
    exit 2
fi

date=$(date -u +%Y-%m-%d)
sed -i -e "/^\[workspace\.package\]/,/^\[/s/^version = .*/version = \"$version\"/" \
    -e "s/^\(imdp\|dynabs\) = { version = \"[^\"]*\"/\1 = { version = \"$version\"/" Cargo.toml
sed -i "s/^## Unreleased\$/## Unreleased\n\n## $version ($date)/" CHANGELOG.md
sed -i -e "s/^version: .*/version: $version/" -e '/^date-released:/d' -e "/^version: /a date-released: $date" CITATION.cff
cargo update --workspace --quiet
# The fuzz targets have a lock file of their own.
(cd tests/fuzz && if [ -e Cargo.lock ]; then cargo update --workspace --quiet; fi)

echo "$old is now $version:"
git --no-pager diff --stat
