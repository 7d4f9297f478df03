#!/usr/bin/env bash
# Makes docs/images/*.png of reports of what the repository ships. Usage: screenshots.sh [PROGRAM]; without it the release build.
set -euo pipefail
here=$(realpath "$(dirname "$0")")
program=$(realpath "${1:-$here/../../target/release/poseshift}")
cd "$here"
[ -d node_modules/playwright-core ] || npm ci --no-audit --no-fund --silent
reports=$(mktemp -d)
trap 'rm -rf "$reports"' EXIT
./reports.sh "$program" "$reports" > /dev/null
mkdir -p ../../docs/images
REPORTS="$reports" node screenshots.mjs ../../docs/images
