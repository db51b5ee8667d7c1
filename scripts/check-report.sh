#!/bin/sh
# Opens reports in headless Chromium: nothing on the console, and choosing dimensions, steps and cells works.
#
#   scripts/check-report.sh report.html...
#
# $CHROMIUM names another browser. Exit codes: 0 fine, 1 something is wrong, 3 no browser.
set -u

here=$(dirname "$0")
browser=${CHROMIUM:-}
for name in chromium chromium-browser google-chrome; do
    [ -n "$browser" ] || browser=$(command -v "$name" || true)
done
if [ -z "$browser" ]; then
    echo "no Chromium found; install chromium or set CHROMIUM" >&2
    exit 3
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0
for page in "$@"; do
    # The drive goes in before the last line of the body.
    { sed '/^<\/body>$/,$d' "$page"; echo '<script>'; cat "$here/report-selftest.js"; printf '</script>\n</body>\n</html>\n'; } \
        > "$work/page.html"
    timeout "${CHROMIUM_SECONDS:-120}" "$browser" --headless --no-sandbox --disable-gpu --user-data-dir="$work/profile" \
        --window-size=1280,1000 --enable-logging=stderr --v=0 --virtual-time-budget=5000 --dump-dom \
        "file://$work/page.html" > "$work/dom.html" 2> "$work/log"
    outcome=$(sed -n 's/.*<html[^>]* data-selftest="\([^"]*\)".*/\1/p' "$work/dom.html" | head -n 1)
    console=$(grep ':CONSOLE' "$work/log")
    if [ "$outcome" = passed ] && [ -z "$console" ]; then
        echo "$page: fine"
    else
        status=1
        echo "$page: ${outcome:-nothing came back from the browser}"
        [ -z "$console" ] || echo "$console"
    fi
done
exit $status
