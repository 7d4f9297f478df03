#!/usr/bin/env bash
# Opens every kind of report in a browser. Skips with a message where node, npm or a browser are missing.
# Usage: run.sh [PROGRAM]; without it the release build.
set -euo pipefail
here=$(realpath "$(dirname "$0")")
skip() { echo "browser tests skipped: $1"; exit 0; }
program=${1:-$here/../../target/release/poseshift}
[ -x "$program" ] || skip "$program is not built"
program=$(realpath "$program")
cd "$here"
command -v node > /dev/null && command -v npm > /dev/null || skip "node and npm are not installed"
if [ -z "${CHROMIUM:-}" ] && ! command -v chromium chromium-browser google-chrome > /dev/null; then
  skip "no chromium (apt-get install chromium, or CHROMIUM=path)"
fi
[ -d node_modules/axe-core ] || npm ci --no-audit --no-fund --silent || skip "npm cannot install playwright-core and axe-core"
# for the test that rebuilds the script; it skips itself without
[ -d ../../web/node_modules/esbuild ] || npm --prefix ../../web ci --no-audit --no-fund --silent || true
reports=$(mktemp -d)
trap 'rm -rf "$reports"' EXIT
./reports.sh "$program" "$reports" > /dev/null
REPORTS="$reports" node --test --test-reporter=spec reports.test.mjs layout.test.mjs external.test.mjs
