"""The files that run on other hosts: they are read here, and the scripts that they call are run."""

from __future__ import annotations

import hashlib
import os
import re
import subprocess
import sys
import tarfile
from pathlib import Path
from typing import Any

import pytest

import poseshift as ps

yaml = pytest.importorskip("yaml")
pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="the scripts are run by bash")


def steps(root: Path) -> list[tuple[str, dict[str, Any]]]:
    """The steps of every workflow and of the action, with where they stand."""
    found = []
    for path in sorted((root / ".github/workflows").glob("*.yml")):
        jobs = yaml.safe_load(path.read_text())["jobs"]
        for name, job in jobs.items():
            needs = job.get("needs", [])
            assert set([needs] if isinstance(needs, str) else needs) <= set(jobs), f"{path}: {name}"
            assert job["runs-on"]
            found += [(f"{path.name}: {name}", step) for step in job["steps"]]
    action = yaml.safe_load((root / "action.yml").read_text())
    found += [("action.yml", step) for step in action["runs"]["steps"]]
    return found


def test_every_step_says_what_it_runs(root: Path) -> None:
    all_steps = steps(root)
    assert len(all_steps) > 20
    for where, step in all_steps:
        assert ("uses" in step) != ("run" in step), where
        if "uses" in step:
            assert re.fullmatch(r"[\w.-]+/[\w./-]+@(v\d[\w.]*|release/v\d)", step["uses"]), f"{where}: {step['uses']}"
        else:
            # what a workflow fills in is a word to the shell
            script = re.sub(r"\$\{\{.*?\}\}", "filled", step["run"])
            checked = subprocess.run(["bash", "-n"], input=script, capture_output=True, text=True, check=False)
            assert checked.returncode == 0, f"{where}: {checked.stderr}"
        for script_name in re.findall(r"\.github/\w+\.sh|\.ci/run", step.get("run", "")):
            assert os.access(root / script_name, os.X_OK), f"{where}: {script_name}"


def test_inputs_of_the_action_reach_its_script(root: Path) -> None:
    action = yaml.safe_load((root / "action.yml").read_text())
    script = (root / ".github/check.sh").read_text()
    given = {key for step in action["runs"]["steps"] for key in step.get("env", {})}
    assert {f"INPUT_{name.upper().replace('-', '_')}" for name in action["inputs"]} - {"INPUT_VERSION"} == given - {"VERSION"}
    assert set(re.findall(r"INPUT_\w+", script)) - {"INPUT_"} == given - {"VERSION"}


@pytest.fixture
def poseshift(tmp_path: Path) -> str:
    path = tmp_path / "poseshift"
    path.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m poseshift "$@"\n')
    path.chmod(0o755)
    return str(path)


def check(root: Path, tmp_path: Path, poseshift: str, **inputs: str) -> tuple[int, str]:
    environment = {**os.environ, "POSESHIFT": poseshift, **{f"INPUT_{key}": value for key, value in inputs.items()}}
    command = [str(root / ".github/check.sh")]
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout


def test_the_script_of_the_action_annotates_lines(root: Path, tmp_path: Path, poseshift: str) -> None:
    program, robot = "my program.mod", str(root / "robots/abb_irb120_thesis.yaml")
    (tmp_path / program).write_bytes((root / "programs/rapid/olp/in/Deburr.mod").read_bytes())
    status, out = check(root, tmp_path, poseshift, PROGRAMS=program + "\n", PROFILE=robot, MAX_PATH_ERROR="0.01", RESULTS="results")
    assert status == 1
    errors = re.findall(r"^::error file=my program\.mod,line=(\d+),title=([\w-]+)::", out, re.MULTILINE)
    wanted = ps.check({program: (tmp_path / program).read_bytes()}, ps.Profile.load(robot), max_path_error_mm=0.01)
    rows = [row for row in wanted.findings.iter_rows() if row["severity"] == "error"]
    assert rows
    assert errors == [(str(row["line"]), row["id"]) for row in rows]


def test_the_script_of_the_action_passes_on_what_is_good(root: Path, tmp_path: Path, poseshift: str) -> None:
    robot = str(root / "robots/abb_irb120_thesis.yaml")
    program = str(root / "programs/rapid/olp/in/Deburr.mod")
    status, _ = check(root, tmp_path, poseshift, PROGRAMS=program, PROFILE=robot, RESULTS="results")
    assert status == 0
    assert {path.name for path in (tmp_path / "results").iterdir()} == {"check.json", "check.html", "junit.xml"}
    status, out = check(root, tmp_path, poseshift, PROGRAMS="none.mod", PROFILE=robot, RESULTS="results")
    assert (status, out) == (2, "")


def test_texts_of_findings_are_no_commands() -> None:
    spec = Path(__file__).resolve().parents[2] / ".github/annotate.py"
    code = compile(spec.read_text(), str(spec), "exec")
    names: dict[str, Any] = {"__name__": "annotate"}
    exec(code, names)
    finding = {"id": "x", "severity": "warning", "file": "a,b:c", "line": 0, "message": "50 %\n::error::no", "hint": ""}
    assert names["annotation"](finding) == "::warning file=a%2Cb%3Ac,line=1,title=x::50 %25%0A::error::no"


def test_an_archive_holds_the_binary_and_its_checksum(root: Path, tmp_path: Path, poseshift: str) -> None:
    for name in ("LICENSE", "LICENSE-MIT", "LICENSE-APACHE", "README.md", "CHANGELOG.md", "robots"):
        (tmp_path / name).symlink_to(root / name)
    command = [str(root / ".github/pack.sh"), "test-target", str(tmp_path)]
    subprocess.run(command, cwd=tmp_path, check=True)
    archive = tmp_path / "packed/poseshift-test-target.tar.gz"
    digest, name = archive.with_name(f"{archive.name}.sha256").read_text().split()
    assert (digest, name) == (hashlib.sha256(archive.read_bytes()).hexdigest(), archive.name)
    names = tarfile.open(archive).getnames()
    for wanted in ("poseshift", "poseshift.1", "completions/poseshift.bash", "LICENSE-MIT", "robots/abb_irb120.yaml"):
        assert f"poseshift-test-target/{wanted}" in names


def test_stages_of_the_image_are_not_root(root: Path) -> None:
    stages = re.split(r"^FROM ", (root / "Dockerfile").read_text(), flags=re.MULTILINE)[1:]
    made = {re.search(r" AS (\w+)", stage)[1]: stage for stage in stages}  # type: ignore[index]
    for name in ("cli", "fleet"):
        assert re.search(r"^USER (?!root)", made[name], re.MULTILINE), name
