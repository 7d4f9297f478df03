#!/usr/bin/env bash
# Builds the wheel, installs it into an empty environment, and runs the tests of Python, of the notebooks, of the fleet and of a cluster with it.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

skip() {
  printf '\n*** NOT TESTED: the Python package. %s\n\n' "$1" >&2
  exit 0
}
command -v python3 > /dev/null || skip "there is no python3 here"
python3 -c 'import sys; sys.exit(sys.version_info < (3, 11))' || skip "python3 is older than 3.11"
python3 -m venv "$folder/tools" || skip "python3 -m venv does not work here"
"$folder/tools/bin/pip" install -q "maturin>=1.9,<2" || skip "pip cannot install maturin"

cd "$here"
"$folder/tools/bin/maturin" build --release --compression-level 9 --out "$folder/dist" --interpreter python3
wheel=("$folder"/dist/*.whl)
size=$(stat -c %s "${wheel[0]}" 2> /dev/null || stat -f %z "${wheel[0]}")
echo "${wheel[0]##*/}: $size bytes"
# 10 MiB
[ "$size" -le 10485760 ]

# what a newcomer does: the wheel and its dependencies, nothing else; then the example of the README
python3 -m venv "$folder/empty"
"$folder/empty/bin/pip" install -q "${wheel[0]}" || skip "pip cannot install numpy"
sed -n '/^```python$/,/^```$/{/^```/d;p}' README.md > "$folder/example.py"
[ -s "$folder/example.py" ]
mkdir "$folder/example"
ln -s "$here/../robots" "$here/../programs" "$folder/example"
(cd "$folder/example" && "$folder/empty/bin/python" -P ../example.py && [ -s out/check.html ] && [ -s out/Deburr.mod ])
"$folder/empty/bin/poseshift" --version

python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q "${wheel[0]}[test]" || skip "pip cannot install what the tests need"
"$folder/venv/bin/pip" install -q "${wheel[0]}[test,fleet]" ||
  printf '\n*** SKIPPED: the fleet on a cluster of three nodes. pip cannot install ray.\n\n' >&2
# -P: the wheel is tested, not the sources
"$folder/venv/bin/python" -P -m pytest -q -rs -p no:cacheprovider tests
