"""Runs `poseshift profile from-urdf` on every URDF below a folder, such as the ones in the PyPI package example-robot-data, and prints
what became of each. Ends with 1 where the program did anything but write a profile or refuse with a reason.

Usage: python packages.py POSESHIFT FOLDER [LINK:LINK ...]     (base:tip pairs tried given the defaults)
"""
import pathlib, subprocess, sys

program, folder, *ends = sys.argv[1:]
pairs = [[]] + [["--base", e.split(":")[0], "--tip", e.split(":")[1]] for e in ends]
bad = made = refused = 0
for path in sorted(pathlib.Path(folder).rglob("*.urdf")):
    for pair in pairs:
        run = subprocess.run([program, "profile", "from-urdf", str(path), "--no-shapes", *pair], capture_output=True, text=True, timeout=60)
        first = (run.stderr.strip().splitlines() or [""])[0]
        if run.returncode == 0 and "poseshift: profile/1" in run.stdout:
            made += 1
            print("made    ", path.name, *pair)
        elif run.returncode == 2 and "error" in first and "panicked" not in run.stderr:
            refused += 1
            if not pair:
                print("refused ", path.name, first.split(":")[-1].strip()[:90])
        else:
            bad += 1
            print("BAD     ", path, run.returncode, run.stderr[:300])
print(f"{made} made, {refused} refused, {bad} bad")
sys.exit(bad > 0)
