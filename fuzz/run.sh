#!/usr/bin/env bash
# Feeds random and mutated files to every reader, SECONDS each (default 60), beginning with the samples: languages, meshes, URDF,
# profiles, cells, frames, stored checks, the tables of each command, what controllers have, journals of runs that were stopped.
# What makes one fail is in fuzz/artifacts: mend it, and keep a program in tests/data/fuzz/<language>, another file as a test.
# Needs: rustup toolchain install nightly; cargo install cargo-fuzz
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60}
largest=32768
for target in fuzz/fuzz_targets/*.rs; do
  reader=$(basename "$target" .rs)
  corpus=fuzz/corpus/$reader
  mkdir -p "$corpus"
  samples=("programs/$reader" "tests/data/fuzz/$reader" "fuzz/seeds/$reader")
  [ "$reader" = profile ] && samples+=(robots)
  find "${samples[@]}" -path '*/out/*' -prune -o -type f -size -32k -print 2>/dev/null |
    while read -r seed; do cp "$seed" "$corpus/$(sha256sum <"$seed" | cut -c1-16)"; done || true
  # files that are read together stand in one seed: before each a byte 1, its name and a line feed, between them a zero byte
  for case in "programs/$reader"/*/ "fuzz/seeds/$reader"/*/; do
    seed=$corpus/of_$(basename "$case")
    find "$case" -path '*/out/*' -prune -o -type f ! -name case.yaml ! -name '*.py' -print 2>/dev/null | sort |
      while read -r part; do
        name=${part#"$case"} && name=${name#in/} && name=${name#context/}
        printf '\001%s\n' "$name" && cat "$part" && printf '\0'
      done | head -c -1 >"$seed" || true
    if [ ! -s "$seed" ] || [ "$(stat -c %s "$seed")" -gt "$largest" ]; then rm "$seed"; fi
  done
  cargo +nightly fuzz run --sanitizer none "$reader" "$corpus" -- -max_total_time="$seconds" -timeout=5 -rss_limit_mb=2048 -max_len="$largest" -print_final_stats=1 2>&1 | tail -n 12
done
