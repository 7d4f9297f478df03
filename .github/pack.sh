#!/usr/bin/env bash
# Packs the binary for a target from a folder: with licences, profiles, man page and completions, and its checksum beside it.
set -euo pipefail
[ "$#" -eq 2 ] || { echo "usage: pack.sh TARGET FOLDER_OF_THE_BINARY" >&2; exit 2; }
target=$1
binary="$2/poseshift"
[ -e "$binary" ] || binary="$binary.exe"
name="poseshift-$target"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/$name/completions" packed
cp "$binary" LICENSE* README.md CHANGELOG.md "$folder/$name"
cp -rL robots "$folder/$name"
# a binary for another machine cannot say these
if "$binary" --version > /dev/null 2>&1; then
  "$binary" man > "$folder/$name/poseshift.1"
  for shell in bash zsh fish powershell; do "$binary" completions "$shell" > "$folder/$name/completions/poseshift.$shell"; done
fi
tar -C "$folder" -czf "packed/$name.tar.gz" "$name"
(cd packed && { sha256sum "$name.tar.gz" 2> /dev/null || shasum -a 256 "$name.tar.gz"; } > "$name.tar.gz.sha256")
