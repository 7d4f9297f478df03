#!/usr/bin/env bash
# Feeds random and mutated files to every reader (languages, meshes, URDF, profiles, cells, measurements), SECONDS each
# (default 60), beginning with the samples.
# What makes one fail is in fuzz/artifacts: mend it, and keep a program in tests/data/fuzz/<language>, another file as a test.
# Needs: rustup toolchain install nightly; cargo install cargo-fuzz
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60}
for target in fuzz/fuzz_targets/*.rs; do
  reader=$(basename "$target" .rs)
  corpus=fuzz/corpus/$reader
  mkdir -p "$corpus"
  samples=("programs/$reader" "tests/data/fuzz/$reader" "fuzz/seeds/$reader")
  [ "$reader" = profile ] && samples+=(robots)
  find "${samples[@]}" -path '*/out/*' -prune -o -type f -size -32k -print 2>/dev/null |
    while read -r seed; do cp "$seed" "$corpus/$(sha256sum <"$seed" | cut -c1-16)"; done || true
  # the files of a VAL 3 project stand in one seed, a zero byte between them
  [ "$reader" = val3 ] && for case in programs/val3/*/in; do
    find "$case" -type f | sort | while read -r part; do cat "$part" && printf '\0'; done |
      head -c -1 >"$corpus/$(basename "$(dirname "$case")")"
  done
  cargo +nightly fuzz run --sanitizer none "$reader" "$corpus" -- -max_total_time="$seconds" -timeout=5 -rss_limit_mb=2048 -max_len=32768 -print_final_stats=1 2>&1 | tail -n 12
done
