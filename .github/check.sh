#!/usr/bin/env bash
# What action.yml runs: `check` on programs, findings as annotations of their lines. Inputs come as INPUT_… variables.
set -uo pipefail
: "${INPUT_PROGRAMS:?name at least one program}" "${INPUT_PROFILE:?name the profile of the robot}"
words=()
# a line a program: names may hold blanks
while IFS= read -r program; do [ -n "$program" ] && words+=("$program"); done <<< "$INPUT_PROGRAMS"
words+=(--profile "$INPUT_PROFILE")
[ -n "${INPUT_CELL:-}" ] && words+=(--cell "$INPUT_CELL")
[ -n "${INPUT_BASELINE:-}" ] && words+=(--baseline "$INPUT_BASELINE")
[ -n "${INPUT_MAX_PATH_ERROR:-}" ] && words+=(--max-path-error "$INPUT_MAX_PATH_ERROR")
folder=${INPUT_RESULTS:-poseshift}
mkdir -p "$folder"
"${POSESHIFT:-poseshift}" check "${words[@]}" --json --junit "$folder/junit.xml" --report "$folder/check.html" > "$folder/check.json"
status=$?
[ -s "$folder/check.json" ] && python3 "$(dirname "$0")/annotate.py" "$folder/check.json"
exit "$status"
