"""Errors, tables, pickles, threads, forks, signals."""

from __future__ import annotations

import multiprocessing
import os
import pickle
import re
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from conftest import q_csv
from numpy.typing import NDArray

import poseshift as ps

Floats = NDArray[np.float64]


def test_errors_say_where_and_what_to_do(root: Path, profile: ps.Profile) -> None:
    text = profile.to_yaml().replace("kinematics:", "kinematic:", 1)
    with pytest.raises(ps.ProfileError) as caught:
        ps.Profile.from_yaml(text, "mine.yaml")
    error = caught.value
    assert (error.file, error.column) == ("mine.yaml", 1)
    assert error.line == text.splitlines().index("kinematic:") + 1
    assert error.excerpt == "kinematic:"
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is ps.ProfileError
    assert str(again) == str(error)
    with pytest.raises(ps.MeasurementError, match="not_a_number"):
        csv = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm\n1,2,3,4,5,6,not_a_number,2,3\n"
        ps.calibrate(profile, ps.Measurements.from_csv(csv.encode()))
    with pytest.raises(FileNotFoundError) as missing:
        ps.Profile.load(root / "robots/none.yaml")
    assert Path(missing.value.filename) == root / "robots/none.yaml"
    with pytest.raises(KeyError):
        ps.Profile.shipped("none")
    assert len(ps.Profile.names()) > 20
    assert ps.Profile.shipped("abb_irb120_thesis").to_yaml() == profile.to_yaml()


def test_no_program_that_was_read_is_written_over(root: Path, profile: ps.Profile, tmp_path: Path) -> None:
    place = tmp_path / "Deburr.mod"
    place.write_bytes((root / "programs/rapid/olp/in/Deburr.mod").read_bytes())
    before = place.read_bytes()
    found = ps.compensate(place, profile, max_shift=[20, 2])
    with pytest.raises(ValueError, match="would be written over"):
        found.write(tmp_path)
    assert place.read_bytes() == before
    assert [path.name for path in found.write(tmp_path / "out")] == ["Deburr.mod"]
    for wrong in (-1.0, float("nan"), float("inf")):
        with pytest.raises(ValueError, match="max_derived_error_mm"):
            ps.compensate(place, profile, max_derived_error_mm=wrong)


def test_a_refused_program_has_findings_and_no_files(root: Path, profile: ps.Profile, tmp_path: Path) -> None:
    program = (root / "programs/rapid/olp/in/Deburr.mod").read_text()
    far, count = re.subn(r"(Move[LJ] \[\[)[-\d.]+", r"\g<1>99999", program, count=1)
    assert count == 1
    found = ps.compensate({"Deburr.mod": far.encode()}, profile)
    assert found.refused
    with pytest.raises(ps.Refused) as caught:
        found.write(tmp_path / "out")
    assert caught.value.findings
    assert not (tmp_path / "out").exists()
    kept = ps.compensate({"Deburr.mod": far.encode()}, profile, despite_errors="all")
    assert kept.refused
    assert kept.files.keys() == {"Deburr.mod"}


def test_options_reach_the_library(root: Path, profile: ps.Profile) -> None:
    program = root / "programs/rapid/olp/in/Deburr.mod"
    moved = np.eye(4)
    moved[0, 3] = 0.001
    plain, shifted = ps.compensate(program, profile), ps.compensate(program, profile, work_offset=moved)
    assert plain.files != shifted.files
    finer = ps.compensate(program, profile, decimals=6)
    assert finer.summary["max_rounding_mm"] < plain.summary["max_rounding_mm"]
    with pytest.raises(ValueError, match="joint_targets"):
        ps.compensate(program, profile, joint_targets="drop")
    with pytest.raises(ps.ProgramError):
        ps.compensate({"a.txt": b"no program"}, profile)
    strict = ps.check(program, profile, max_path_error_mm=0.001)
    assert strict.refused
    worse = ps.check(program, profile, baseline=ps.check(plain.files, profile, nominal=program))
    assert worse.baseline is not None


def test_the_page_is_the_one_of_the_command(root: Path, profile: ps.Profile) -> None:
    done = ps.compensate(root / "programs/rapid/olp/in/Deburr.mod", profile)
    page = done.html("made by a test")
    assert page.startswith("<!doctype html>") or page.lower().startswith("<!doctype html>")
    assert "made by a test" in page
    assert page == done.html("made by a test")
    assert "<table" in done._repr_html_() or "<pre>" in done._repr_html_()


def test_profiles_pickle_and_compare(profile: ps.Profile) -> None:
    again = pickle.loads(pickle.dumps(profile))
    assert again == profile
    assert hash(again) == hash(profile)
    assert again.name == profile.name
    assert profile.limits_rad.shape == (6, 2)
    assert profile.tools == ["artifact"]
    table = ps.effects(profile)
    assert set(table) == {"effect", "parameter", "value", "unit"}
    assert table.rows > 20


def test_tables_are_read_through_arrow(root: Path, profile: ps.Profile) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    targets = ps.compensate(root / "programs/rapid/olp/in/Deburr.mod", profile).targets
    table = pyarrow.table(targets)
    assert table.num_rows == targets.rows
    assert table.column("shift_mm").to_pylist() == targets["shift_mm"]
    assert targets.column("shift_mm").dtype == np.float64


def test_measurements_from_arrays_tables_and_files_are_the_same(profile: ps.Profile, q_rad: Floats) -> None:
    q = q_rad[:60]
    position = profile.arm().forward(q)[:, :3, 3]
    by_arrays = ps.Measurements.from_arrays(q, position_m=position)
    columns = {f"q{k + 1}_deg": np.rad2deg(q[:, k]) for k in range(6)}
    columns |= {name: position[:, k] * 1000 for k, name in enumerate(("x_mm", "y_mm", "z_mm"))}
    by_table = ps.Measurements.from_table(columns)
    renamed = {"J1" if name == "q1_deg" else name: column for name, column in columns.items()}
    named = ps.Measurements.from_table(renamed, columns="q1=J1", units="deg")
    a, b, c = (ps.validate(profile, rows).document for rows in (by_arrays, by_table, named))
    assert c["position"] == b["position"]
    assert a["rows"] == b["rows"] == 60
    assert a["position"]["real"]["max_mm"] < 1e-9
    assert b["position"]["real"]["max_mm"] < 1e-9
    pose = profile.arm().forward(q)
    oriented = ps.validate(profile, ps.Measurements.from_arrays(q, pose=pose, sigma_m=np.full(60, 1e-4)))
    assert oriented.document["orientation"]["real"]["max_deg"] < 1e-9
    with pytest.raises(ValueError, match="sigma_m has 3 rows"):
        ps.Measurements.from_arrays(q, position_m=position, sigma_m=[1, 2, 3])


def test_scipy_finds_what_calibrate_finds(profile: ps.Profile, q_rad: Floats) -> None:
    optimize = pytest.importorskip("scipy.optimize")
    measured = ps.simulate(profile, q_rad[:80], noise_m=2e-5, seed=3)
    text = profile.to_yaml()
    nominal = ps.Profile.from_yaml(text[: text.index("\ncalibration:")] + "\n")
    problem = ps.Problem(nominal, measured, level="geometry")
    assert problem.residuals(problem.x0).shape == (240,)
    # the derivatives are exact
    x, step = problem.x, 1e-7
    slopes = problem.jacobian(x)
    for k in range(len(x)):
        ahead, behind = x.copy(), x.copy()
        ahead[k] += step
        behind[k] -= step
        by_difference = (problem.residuals(ahead) - problem.residuals(behind)) / (2 * step)
        assert np.allclose(slopes[:, k], by_difference, rtol=1e-5, atol=1e-3 * np.abs(slopes).max())
    found = optimize.least_squares(problem.residuals, problem.x0, problem.jacobian, x_scale="jac")
    assert found.success
    assert np.isclose(2 * found.cost, (problem.residuals(problem.x) ** 2).sum(), rtol=1e-6)
    assert 2 * (problem.residuals(problem.x0) ** 2).sum() > 100 * found.cost


def test_two_threads_compute_at_once(profile: ps.Profile, q_rad: Floats) -> None:
    arm = profile.arm()
    many = np.repeat(q_rad, 20, axis=0)
    wanted, found = arm.forward(many), {}

    def work(key: int) -> None:
        found[key] = arm.forward(many)

    threads = [threading.Thread(target=work, args=(key,)) for key in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(found[key], wanted) for key in range(4))
    ps.set_threads(1)
    with pytest.raises(ValueError, match="at most 1024"):
        ps.set_threads(10**9)
    assert np.array_equal(arm.forward(many), wanted)
    ps.set_threads(None)


@pytest.mark.parametrize("said", ["many", "-1", "1000000"])
def test_threads_that_cannot_be_had_are_an_error(profile: ps.Profile, q_rad: Floats, monkeypatch: pytest.MonkeyPatch, said: str) -> None:
    ps.set_threads(None)
    monkeypatch.setenv("POSESHIFT_THREADS", said)
    with pytest.raises(ValueError, match="POSESHIFT_THREADS"):
        profile.arm().forward(np.repeat(q_rad, 600, axis=0))


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no fork")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_fork_after_use_does_not_hang(profile: ps.Profile, q_rad: Floats) -> None:
    arm = profile.arm()
    many = np.repeat(q_rad, 20, axis=0)
    wanted = float(arm.forward(many).sum())
    context = multiprocessing.get_context("fork")
    queue = context.Queue()
    child = context.Process(target=lambda: queue.put(float(arm.forward(many).sum())))
    child.start()
    try:
        assert queue.get(timeout=60) == wanted
    finally:
        child.kill()
        child.join()


LONG = {
    "plan": "ps.plan(profile, 100, candidates=100000, starts=1000)",
    "calibrate": "ps.calibrate(profile, measured)",
    "diagnose": "ps.diagnose(profile, measured)",
}


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent otherwise there")
@pytest.mark.parametrize("name", LONG)
def test_ctrl_c_stops_long_work(tmp_path: Path, root: Path, name: str) -> None:
    """It ends by an exception, long before it would have ended by itself."""
    robot = root / "robots/abb_irb120_thesis.yaml"
    script = tmp_path / "long.py"
    script.write_text(
        "import numpy as np, poseshift as ps\n"
        f"profile = ps.Profile.load({str(robot)!r})\n"
        "q = np.random.default_rng(1).uniform([-2, -1, -1, -2, 0.2, -3], [2, 1, 0.8, 2, 1.8, 3], (100000, 6))\n"
        "measured = ps.simulate(profile, q, noise_m=2e-5)\n"
        "print('begun', flush=True)\n"
        "try:\n"
        f"    {LONG[name]}\n"
        "except KeyboardInterrupt:\n"
        "    print('stopped', flush=True)\n"
    )
    child = subprocess.Popen([sys.executable, str(script)], stdout=subprocess.PIPE, text=True)
    assert child.stdout is not None
    assert child.stdout.readline() == "begun\n"
    time.sleep(1.0)
    sent = time.monotonic()
    child.send_signal(signal.SIGINT)
    try:
        out, _ = child.communicate(timeout=120)
    finally:
        child.kill()
    print(f"{name}: stopped after {time.monotonic() - sent:.2f} s")
    assert out == "stopped\n"


def test_the_command_of_the_wheel(tmp_path: Path, root: Path, q_rad: Floats) -> None:
    (tmp_path / "joints.csv").write_text(q_csv(q_rad[:2]))
    command = [sys.executable, "-m", "poseshift"]
    profile = str(root / "robots/abb_irb120_thesis.yaml")
    words = ["fk", "--profile", profile, "--joints", "joints.csv"]
    done = subprocess.run([*command, *words], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0
    assert done.stdout.startswith("id,x_mm")
    wrong = subprocess.run([*command, "fk", "--profile", "none.yaml", "--joints", "x"], cwd=tmp_path, check=False, capture_output=True)
    assert wrong.returncode == 2
