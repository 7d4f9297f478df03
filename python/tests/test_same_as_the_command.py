"""Every function gives what the command gives, bit for bit, on the shipped samples.

`COMPARED` lists the functions and the tests that compare them. Where the command's JSON has degrees, millimetres or a quaternion and Python
radians, metres or a matrix, the same step from one to the other is done here, and then there is no tolerance either. With a tolerance stand, next
to the equal document of `calibrate`: its covariance, of which that has the roots, and the mean of its residuals, added up in another order. `Arm.solve` is equal pose by pose.
"""

from __future__ import annotations

import inspect
import itertools
import json
import math
import re
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import q_csv, q_of_csv
from numpy.typing import NDArray

import poseshift as ps

Run = Callable[..., Any]
DEG = math.pi / 180.0
# joints of answers that are both within 1e-6 mm and 1e-9 rad
NEAR_DEG = 1e-6

# what a function computes, and the test that compares it with the command
COMPARED = {
    "Arm.forward": "test_forward",
    "Arm.solve": "test_inverse_on_given_branches",
    "Arm.solve_all": "test_inverse_on_every_branch",
    "Profile.diff_json": "test_diff",
    "axes": "test_axes",
    "calibrate": "test_calibrate",
    "changes": "test_diagnose_runs",
    "check": "test_compensate_and_check",
    "compensate": "test_compensate_and_check",
    "diagnose": "test_validate_and_diagnose",
    "diff": "test_diff",
    "effects": "test_effects",
    "hand_eye": "test_hand_eye",
    "hexapod": "test_hexapod",
    "icp": "test_icp",
    "plan": "test_plan",
    "read_program": "test_read_program_as_compensate",
    "register": "test_register",
    "simulate": "test_simulate",
    "validate": "test_validate_and_diagnose",
}
# what no command prints
WITHOUT_A_COMMAND = {
    "Arm.posture": "the distances from singularities, which findings only name",
    "Problem": "residuals and Jacobian of a fit: compared with differences in test_objects.py",
    "set_threads": "computes nothing",
}


def test_every_function_is_compared() -> None:
    functions = {name for name in ps.__all__ if inspect.isroutine(getattr(ps, name))} | {"Problem", "Profile.diff_json"}
    functions |= {f"Arm.{name}" for name in vars(ps.Arm) if not name.startswith("_")}
    assert functions == COMPARED.keys() | WITHOUT_A_COMMAND.keys()
    assert set(COMPARED.values()) <= globals().keys()


def quaternion(matrix: NDArray[np.float64]) -> list[float]:
    """w, x, y, z by Shepperd's method, as documents have it."""
    m = matrix.tolist()
    squares = [
        1.0 + m[0][0] + m[1][1] + m[2][2],
        1.0 + m[0][0] - m[1][1] - m[2][2],
        1.0 - m[0][0] + m[1][1] - m[2][2],
        1.0 - m[0][0] - m[1][1] + m[2][2],
    ]
    x, y, z = m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]
    xy, xz, yz = m[1][0] + m[0][1], m[0][2] + m[2][0], m[2][1] + m[1][2]
    parts = [[squares[0], x, y, z], [x, squares[1], xy, xz], [y, xy, squares[2], yz], [z, xz, yz, squares[3]]]
    q = parts[squares.index(max(squares))]
    length = math.sqrt(((q[0] * q[0] + q[1] * q[1]) + q[2] * q[2]) + q[3] * q[3])
    sign = -1.0 if q[0] < 0.0 else 1.0
    return [sign * (part / length) for part in q]


def is_pose(matrix: NDArray[np.float64], row: dict[str, Any]) -> bool:
    """Whether a document's pose is this one, to the last bit."""
    place = [row[f"{axis}_mm"] for axis in "xyz"]
    return (matrix[:3, 3] * 1000.0).tolist() == place and quaternion(matrix) == row["quaternion"]


def matrix_of(row: dict[str, Any]) -> NDArray[np.float64]:
    """The pose that a document has."""
    matrix = np.eye(4)
    matrix[:3, :3] = _rotation(*row["quaternion"])
    matrix[:3, 3] = [row[f"{axis}_mm"] / 1000.0 for axis in "xyz"]
    return matrix
# the gear of joint 3 runs out
HIDDEN = "{effect: joint_harmonic, joint: 3, order: 1, cos_deg: 0.05, sin_deg: 0}"


@pytest.fixture
def joints(tmp_path: Path, q_rad: NDArray[np.float64]) -> Path:
    path = tmp_path / "joints.csv"
    path.write_text(q_csv(q_rad[:60]))
    return path


@pytest.fixture
def measured(run: Run, root: Path, joints: Path, tmp_path: Path) -> Path:
    profile = root / "robots/abb_irb120_thesis.yaml"
    text = profile.read_text().replace("effects:\n", f"effects:\n    - {HIDDEN}\n", 1)
    assert HIDDEN in text
    (tmp_path / "real.yaml").write_text(text)
    run("simulate", "--profile", "real.yaml", "--joints", joints, "--noise-mm", 0.02, "--seed", 7, "-o", "measured.csv")
    return tmp_path / "measured.csv"


@pytest.fixture
def nominal(root: Path, tmp_path: Path) -> ps.Profile:
    """The arm as its maker describes it: there is something to find."""
    text = (root / "robots/abb_irb120_thesis.yaml").read_text()
    path = tmp_path / "nominal.yaml"
    path.write_text(text[: text.index("\ncalibration:")] + "\n")
    return ps.Profile.load(path)


def test_forward(run: Run, root: Path, profile: ps.Profile, joints: Path) -> None:
    found = run("fk", "--profile", root / "robots/abb_irb120_thesis.yaml", "--joints", joints)["poses"]
    q = q_of_csv(joints.read_text())
    poses = profile.arm().forward(q)
    assert all(is_pose(one, row) for one, row in zip(poses, found, strict=True))
    one_by_one = np.array([profile.arm().forward(one) for one in q])
    assert np.array_equal(one_by_one, poses)


def test_inverse_on_every_branch(run: Run, root: Path, profile: ps.Profile) -> None:
    poses = root / "docs/measuring/robot.csv"
    found = run("ik", "--profile", root / "robots/abb_irb120_thesis.yaml", "--poses", poses, "--all")
    head, *lines = poses.read_text().splitlines()
    names = head.split(",")
    rows = [dict(zip(names, line.split(","), strict=True)) for line in lines if not line.startswith("#")]
    matrices = [_matrix(row) for row in rows]
    all_found = iter(found["solutions"])
    for matrix in matrices:
        of_pose = profile.arm().solve_all(matrix)
        for k in range(8):
            row = next(all_found)
            assert of_pose.branch[k] == row["solution"]
            assert_same_solution(of_pose, k, row)


def assert_same_solution(found: ps.Solutions, k: int, row: dict[str, Any]) -> None:
    """A row of `ik`, to the last bit."""
    assert ps.Status(found.status[k]).name.lower().replace("_", "-") == row["status"]
    assert (found.q_rad[k] / DEG).tolist() == row["joints_deg"]
    assert found.residual_m[k] * 1000.0 == row["residual_mm"]
    assert found.residual_rad[k] / DEG == row["residual_deg"]
    assert found.iterations[k] == row["iterations"]


def test_inverse_on_given_branches(run: Run, root: Path, profile: ps.Profile, joints: Path, tmp_path: Path) -> None:
    robot = root / "robots/abb_irb120_thesis.yaml"
    poses = run("fk", "--profile", robot, "--joints", joints)["poses"]
    q = q_of_csv(joints.read_text())
    branches = profile.arm().posture(q).branch
    names = ["x_mm", "y_mm", "z_mm", "qw", "qx", "qy", "qz"]
    lines = [[repr(row[f"{axis}_mm"]) for axis in "xyz"] + [repr(part) for part in row["quaternion"]] for row in poses]
    text = [",".join([*names, "branch", *(f"near{k}_deg" for k in range(1, 7))])]
    nears = joints.read_text().splitlines()[1:]
    text += [",".join([*line, str(branch), near]) for line, branch, near in zip(lines, branches, nears, strict=True)]
    (tmp_path / "wanted.csv").write_text("\n".join(text) + "\n")
    by_command = run("ik", "--profile", robot, "--poses", "wanted.csv")["solutions"]
    matrices = np.array([_matrix(dict(zip(names, line, strict=True))) for line in lines])
    arm = profile.arm()
    assert len(by_command) == len(q)
    for k, row in enumerate(by_command):
        assert row["solution"] == branches[k]
        one = arm.solve(matrices[k : k + 1], branch=branches[k : k + 1], near_rad=q[k : k + 1])
        assert_same_solution(one, 0, row)
    # four poses side by side go on until the last of them is there: they may take a step more
    found = arm.solve(matrices, branch=branches, near_rad=q)
    assert [ps.Status(status).name.lower().replace("_", "-") for status in found.status] == [row["status"] for row in by_command]
    assert np.allclose(found.q_rad / DEG, [row["joints_deg"] for row in by_command], rtol=0, atol=NEAR_DEG)


def _matrix(row: dict[str, str]) -> NDArray[np.float64]:
    w, x, y, z = (float(row[name]) for name in ("qw", "qx", "qy", "qz"))
    n = np.sqrt(w * w + x * x + y * y + z * z)
    matrix = np.eye(4)
    matrix[:3, :3] = _rotation(w / n, x / n, y / n, z / n)
    matrix[:3, 3] = [float(row[name]) / 1000.0 for name in ("x_mm", "y_mm", "z_mm")]
    return matrix


def _rotation(w: float, x: float, y: float, z: float) -> list[list[float]]:
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]


SAMPLES = sorted(path for path in (Path(__file__).resolve().parents[2] / "programs").glob("*/*/case.yaml"))
by_name = pytest.mark.parametrize("case", SAMPLES, ids=lambda path: f"{path.parts[-3]}-{path.parts[-2]}")


def _keywords(options: list[str]) -> dict[str, Any]:
    """The arguments of `compensate` that are these words of the command line."""
    found: dict[str, Any] = {}
    words = iter(options)
    for word in words:
        if word == "--keep-going":
            found["despite_errors"] = "all"
        elif word == "--with":
            top = Path(next(words))
            found["context"] = [top] if top.is_file() else sorted(p for p in top.rglob("*") if p.is_file())
        elif word == "--joint-targets":
            found["joint_targets"] = next(words)
        elif word == "--max-derived-error":
            found["max_derived_error_mm"] = float(next(words))
        elif word == "--tool":
            found["tool"] = next(words)
        elif word == "--frame":
            name, _, numbers = next(words).partition("=")
            found.setdefault("frames", {})[name] = _pose_of([float(number) for number in numbers.split(",")])
        else:
            raise AssertionError(f"what is {word} in Python?")
    return found


def _pose_of(numbers: list[float]) -> NDArray[np.float64]:
    """A pose of x, y, z, rx, ry, rz in mm and degrees."""
    (a, b, c) = (angle * DEG for angle in numbers[3:])
    x = np.array([[1, 0, 0], [0, math.cos(a), -math.sin(a)], [0, math.sin(a), math.cos(a)]])
    y = np.array([[math.cos(b), 0, math.sin(b)], [0, 1, 0], [-math.sin(b), 0, math.cos(b)]])
    z = np.array([[math.cos(c), -math.sin(c), 0], [math.sin(c), math.cos(c), 0], [0, 0, 1]])
    matrix = np.eye(4)
    matrix[:3, :3] = x @ y @ z
    matrix[:3, 3] = [number / 1000.0 for number in numbers[:3]]
    return matrix


@by_name
def test_compensate_and_check(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, case: Path) -> None:
    """Every sample of every language."""
    yaml = pytest.importorskip("yaml")
    said = yaml.safe_load(case.read_text())
    for name in ("in", "context"):
        if (case.parent / name).is_dir():
            shutil.copytree(case.parent / name, tmp_path / name)
    robot = (case.parent / said["profile"]).resolve()
    monkeypatch.chdir(tmp_path)
    files = sorted(path for path in Path("in").rglob("*") if path.is_file())
    given, profile = ["in", "--profile", robot], ps.Profile.load(robot)
    by_command = run("compensate", *given, *said["options"], "-o", "out", status=said.get("status", 0))
    keywords = _keywords(said["options"])
    done = ps.compensate(files, profile, **keywords)
    # where it is written is the only difference
    assert by_command | {"output": None} == done.document | {"output": None}
    written = {path.relative_to("out").as_posix(): path.read_bytes() for path in Path("out").rglob("*") if path.is_file()}
    assert {name.removeprefix("in/"): data for name, data in done.files.items()} == written
    # what was written, or the program itself where it is refused, against what it was made from
    keywords = {name: keywords[name] for name in ("context", "tool", "frame", "frames") if name in keywords}
    of = sorted(path for path in Path("out").rglob("*") if path.is_file()) if written else files
    options = ["--nominal", "in"] if written else []
    for word, value in itertools.pairwise(said["options"]):
        options += [word, value] if word in {"--with", "--tool", "--frame"} else []

    def check() -> ps.Check:
        return ps.check(of, profile, nominal=files if written else None, **keywords)

    try:
        by_command = run("check", of[0].parts[0], "--profile", robot, *options, "--junit", "junit.xml", status=None)
    except json.JSONDecodeError:
        # it cannot be checked: neither can it here
        with pytest.raises(ps.PoseshiftError):
            check()
        return
    checked = check()
    assert by_command == checked.document
    assert checked.junit() == Path("junit.xml").read_text()
    assert checked.moves.rows == checked.summary["moves"]


def test_calibrate(run: Run, nominal: ps.Profile, measured: Path, tmp_path: Path) -> None:
    by_command = run("calibrate", "--profile", nominal.name, "--measurements", measured, "-o", "calibrated.yaml")
    by_command.pop("output")
    found = ps.calibrate(nominal, ps.Measurements.from_csv(measured))
    assert by_command == found.document
    assert found.profile.to_yaml() == (tmp_path / "calibrated.yaml").read_text()
    assert found.covariance.shape == (len(found.names),) * 2
    sigma = {row["key"]: (row["sigma"], row["unit"]) for row in found.parameters.iter_rows()}
    unit = {"mm": 1e-3, "deg": np.pi / 180}
    for name, variance in zip(found.names, np.diag(found.covariance), strict=True):
        value, of = sigma[name]
        if of in unit:
            # the root of a square is off by a bit at most
            assert np.isclose(np.sqrt(variance), value * unit[of], rtol=1e-15)
    mean = np.linalg.norm(found.residuals_m, axis=1).mean() * 1000
    # a sum in another order
    assert np.isclose(mean, found.quality["after"]["position"]["mean_mm"], rtol=1e-12)


def test_validate_and_diagnose(run: Run, profile: ps.Profile, measured: Path, tmp_path: Path) -> None:
    rows = ps.Measurements.from_csv(measured)
    by_command = run("validate", "--profile", profile.name, "--measurements", measured)
    assert by_command == ps.validate(profile, rows).document
    words = ["diagnose", "--quick", "--profile", profile.name, "--measurements", measured]
    by_command = run(*words, "-o", "better.yaml")
    assert by_command.pop("output") == "better.yaml"
    found = ps.diagnose(profile, rows, quick=True)
    assert by_command == found.document
    assert found.profile is not None
    assert found.profile.to_yaml() == (tmp_path / "better.yaml").read_text()
    assert "joint_harmonic" in found.effects["effect"]


def test_diagnose_runs(run: Run, profile: ps.Profile, tmp_path: Path, q_rad: NDArray[np.float64]) -> None:
    """Nine runs; in the sixth the gear goes."""
    worn = ps.Profile.from_yaml(profile.to_yaml().replace("effects:\n", f"effects:\n    - {HIDDEN}\n", 1))
    names = [f"run{k}.csv" for k in range(9)]
    for k, name in enumerate(names):
        (tmp_path / name).write_bytes(ps.simulate(worn if k > 4 else profile, q_rad[:30], noise_m=2e-5, seed=k).to_csv())
    given = [word for name in names for word in ("--measurements", name)]
    by_command = run("diagnose", "--quick", "--runs", "--profile", profile.name, *given, status=None)
    tables = ps.Measurements(tuple((name, (tmp_path / name).read_bytes()) for name in names))
    found = ps.diagnose(profile, tables, quick=True, runs=True)
    assert by_command | {"output": None} == found.document | {"output": None}
    drift = by_command["drift"]
    changes = ps.changes([row["rms_mm"] for row in drift["runs"]])
    assert [(c.since + 1, c.noticed + 1, c.before, c.after) for c in changes] == [
        (row["run"], row["noticed"], row["before_mm"], row["after_mm"]) for row in drift["changes"]
    ]
    assert [change.since for change in changes] == [5]


def test_plan(run: Run, profile: ps.Profile, root: Path, tmp_path: Path) -> None:
    robot = root / "robots/abb_irb120_thesis.yaml"
    words = ["plan", "--profile", robot, "--count", 30, "--candidates", 300, "--starts", 1, "-o", "joints.csv"]
    by_command = run(*words)
    by_command.pop("output")
    found = ps.plan(profile, 30, candidates=300, starts=1)
    assert by_command == {key: value for key, value in found.document.items() if key != "output"}
    assert found.csv == (tmp_path / "joints.csv").read_text()
    assert np.array_equal(found.q_rad, np.array(found.document["joints_deg"]) * (np.pi / 180))


def test_simulate(joints: Path, measured: Path, tmp_path: Path) -> None:
    q = q_of_csv(joints.read_text())
    real = ps.Profile.load(tmp_path / "real.yaml")
    assert ps.simulate(real, q, noise_m=0.02 / 1000, seed=7).to_csv() == measured.read_bytes()


def test_register(run: Run, root: Path) -> None:
    nominal, probed = (root / f"docs/measuring/{name}.csv" for name in ("nominal", "probed"))
    by_command = run("register", nominal, probed)
    a, b = (_points(path) for path in (nominal, probed))
    ids = [name for name in a if name in b]
    fit = ps.register(np.array([a[i] for i in ids]), np.array([b[i] for i in ids]))
    assert fit.to_from_from[:3, :3].tolist() == by_command["rotation"]
    assert (fit.to_from_from[:3, 3] * 1000.0).tolist() == by_command["translation_mm"]
    assert fit.rmsd_m * 1000.0 == by_command["rmsd_mm"]


def _points(path: Path) -> dict[str, list[float]]:
    head, *lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    names = head.split(",")
    found = {}
    for number, line in enumerate(lines):
        row = dict(zip(names, line.split(","), strict=True))
        found[row.get("id", str(number))] = [float(row[name]) / 1000.0 for name in ("x_mm", "y_mm", "z_mm")]
    return found


def test_hand_eye(run: Run, root: Path) -> None:
    files = [root / f"docs/measuring/{name}.csv" for name in ("robot", "board")]
    by_command = run("handeye", *files, "--setup", "eye-in-hand")
    robot, board = (_poses(path) for path in files)
    found = ps.hand_eye(robot, board, setup="eye-in-hand")
    assert is_pose(found.camera, by_command["camera"])
    assert is_pose(found.board, by_command["board"])
    for name, pose in found.by_method.items():
        by = by_command["by_method"][name]
        assert by is None if pose is None else is_pose(pose, by)
    assert (found.residuals_m * 1000.0).tolist() == [row["residual_mm"] for row in by_command["poses"]]
    assert (found.residuals_rad / DEG).tolist() == [row["residual_deg"] for row in by_command["poses"]]


def _poses(path: Path) -> NDArray[np.float64]:
    head, *lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    names = head.split(",")
    return np.array([_matrix(dict(zip(names, line.split(","), strict=True))) for line in lines])


def test_diff(run: Run, nominal: ps.Profile, profile: ps.Profile) -> None:
    by_command = run("profile", "diff", nominal.name, profile.name, status=1)
    assert json.loads(nominal.diff_json(profile)) == by_command
    assert ps.diff(nominal, profile).rows == len(by_command["differences"])


def test_icp(run: Run, root: Path) -> None:
    drawing, scan = (root / f"docs/measuring/{name}.csv" for name in ("drawing", "scan"))
    by_command = run("register", drawing, scan, "--icp")
    a, b = (np.array(list(_points(path).values())) for path in (drawing, scan))
    fit = ps.icp(a, b, normals=_normals(scan))
    assert fit.to_from_from[:3, :3].tolist() == by_command["rotation"]
    assert (fit.to_from_from[:3, 3] * 1000.0).tolist() == by_command["translation_mm"]
    assert fit.rms_m * 1000.0 == by_command["rmsd_mm"]
    assert fit.overlap == by_command["overlap"]
    assert fit.concerns == [finding["message"] for finding in by_command["findings"]]


def _normals(path: Path) -> NDArray[np.float64] | None:
    head, *lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    names = head.split(",")
    if "nx" not in names:
        return None
    return np.array([[float(line.split(",")[names.index(name)]) for name in ("nx", "ny", "nz")] for line in lines])


def test_hexapod(run: Run, root: Path) -> None:
    lengths = root / "docs/measuring/lengths.csv"
    by_command = run("hexapod", lengths)
    found = ps.hexapod(lengths)
    assert by_command == found.document
    assert found.poses.rows == len(found.base_from_tool) > 0
    for pose, points, row in zip(found.base_from_tool, found.tool_points_m, by_command["poses"], strict=True):
        assert points.tolist() == (np.array(row["tool_points_mm"]) / 1000.0).tolist()
        assert np.array_equal(pose, matrix_of(row["pose"]))
    with pytest.raises(ps.RegisterError, match="columns are missing"):
        ps.hexapod(b"b12_mm\n1\n")


def test_axes(run: Run, root: Path, profile: ps.Profile) -> None:
    sweeps = root / "docs/measuring/sweeps.csv"
    by_command = run("axes", sweeps, "--profile", root / "robots/abb_irb120_thesis.yaml")
    found = ps.axes(profile, sweeps)
    assert by_command == found.document
    assert found.joints.rows == len(by_command["joints"])
    for frame, name in ((found.world_from_base, "base"), (found.flange_from_tool, "tool")):
        assert frame is not None
        assert np.array_equal(frame, matrix_of(by_command[name]))


@by_name
def test_read_program(case: Path) -> None:
    """The spans hold the numbers, and moves name their targets."""
    yaml = pytest.importorskip("yaml")
    said = yaml.safe_load(case.read_text())
    files, context = (sorted(p for p in (case.parent / name).rglob("*") if p.is_file()) for name in ("in", "context"))
    profile = ps.Profile.load(case.parent / said["profile"])
    language = case.parts[-3]
    read = ps.read_program(files, profile, context=context, language=language)
    assert read.language == language
    data = {str(path): path.read_bytes() for path in files + context}
    compared = 0
    for row in read.targets.iter_rows():
        assert (row["pose"] is None) or (row["joints_deg"] is None)
        for (start, length), value in zip(row["spans"], row["values"], strict=True):
            text = data[row["file"]][start : start + length].decode("ascii").strip() or "0"
            # words of configurations, and bits
            if text[0] not in "'\"" and not text.isalpha():
                assert float(text.lower().replace("d", "e")) == value
                compared += 1
    assert compared >= 6 * len(read.targets["pose"]) > 0
    targets = list(read.targets.iter_rows())
    for row in read.moves.iter_rows():
        assert row["target"] is None or row["target"] < len(targets)


def test_read_program_as_compensate(run: Run, root: Path, profile: ps.Profile) -> None:
    program = root / "programs/rapid/olp/in/Deburr.mod"
    by_command = run("compensate", program, "--profile", root / "robots/abb_irb120_thesis.yaml", "-o", "out.mod")
    read = ps.read_program(program, profile)
    by_line: dict[int, list[Any]] = {}
    for row in read.targets.iter_rows():
        by_line.setdefault(row["line"], []).append(row["pose"])
    wanted = [target for target in by_command["targets"] if target["wanted"] is not None]
    assert len(wanted) > 20
    assert all(target["wanted"] in by_line[target["line"]] for target in wanted)
    assert read.moves["kind"].count("linear") > 20
    assert ps.read_program(program).document["targets"] == read.document["targets"]


def test_validate_as_calibrated(run: Run, nominal: ps.Profile, measured: Path, joints: Path, tmp_path: Path) -> None:
    run("calibrate", "--profile", nominal.name, "--measurements", measured, "-o", "calibrated.yaml")
    calibrated = ps.Profile.load(tmp_path / "calibrated.yaml")
    real = ps.Profile.load(tmp_path / "real.yaml")
    ten = q_of_csv(joints.read_text())[:10] + 0.05
    (tmp_path / "ten.csv").write_bytes(ps.simulate(real, ten, noise_m=0.02 / 1000, seed=9).to_csv())
    words = ["validate", "--profile", "calibrated.yaml", "--measurements", "ten.csv", "--as-calibrated"]
    by_command = run(*words)
    ours = ps.Measurements.from_csv(tmp_path / "ten.csv").named("ten.csv")
    assert by_command == ps.validate(calibrated, ours, as_calibrated=True).document
    # another arm: the answer is no
    (tmp_path / "ten.csv").write_bytes(ps.simulate(nominal, ten, noise_m=0.02 / 1000, seed=9).to_csv())
    by_command = run(*words, status=1)
    assert by_command["as_calibrated"]["answer"] == "measure again"
    assert "not-as-calibrated" in [finding["id"] for finding in by_command["findings"]]


def test_effects(run: Run, root: Path, profile: ps.Profile) -> None:
    facts = run("profile", "show", root / "robots/abb_irb120_thesis.yaml")
    of_profile = {name.removeprefix("effect "): text for name, text in facts["facts"].items() if name.startswith("effect ")}
    reported: dict[str, list[str]] = {}
    for row in ps.effects(profile).iter_rows():
        reported.setdefault(row["effect"], []).append(f"{row['parameter']} {row['value']!r}".replace("e-05", "e-5"))
    assert reported["base_frame"] == re.findall(r"\S+ \S+", of_profile["base_frame"])
