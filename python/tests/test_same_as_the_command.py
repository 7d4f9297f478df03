"""Every function gives what the command gives, bit for bit, on the shipped samples."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import q_csv, q_of_csv
from numpy.typing import NDArray

import poseshift as ps

Run = Callable[..., Any]
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
    for one, row in zip(poses, found, strict=True):
        assert [*(one[:3, 3] * 1000.0)] == [row["x_mm"], row["y_mm"], row["z_mm"]]
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
            assert ps.Status(of_pose.status[k]).name.lower().replace("_", "-") == row["status"]
            if row["status"] == "converged":
                assert np.allclose(of_pose.q_rad[k] * (180 / np.pi), row["joints_deg"], rtol=0, atol=1e-9)


def _matrix(row: dict[str, str]) -> NDArray[np.float64]:
    w, x, y, z = (float(row[name]) for name in ("qw", "qx", "qy", "qz"))
    n = np.sqrt(w * w + x * x + y * y + z * z)
    w, x, y, z = w / n, x / n, y / n, z / n
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    matrix[:3, 3] = [float(row[name]) / 1000.0 for name in ("x_mm", "y_mm", "z_mm")]
    return matrix


CASES = [
    "programs/rapid/olp/in/Deburr.mod",
]


@pytest.mark.parametrize("name", CASES)
def test_compensate_and_check(run: Run, root: Path, profile: ps.Profile, tmp_path: Path, name: str) -> None:
    program, robot = root / name, root / "robots/abb_irb120_thesis.yaml"
    by_command = run("compensate", program, "--profile", robot, "-o", "out.mod")
    done = ps.compensate(program, profile)
    # where it is written is the only difference
    assert by_command | {"output": None} == done.document | {"output": None}
    ((_, data),) = done.files.items()
    assert data == (tmp_path / "out.mod").read_bytes()
    out = tmp_path / "out.mod"
    by_command = run("check", out, "--profile", robot, "--nominal", program, "--junit", "junit.xml")
    checked = ps.check(out, profile, nominal=program)
    assert by_command == checked.document
    assert checked.junit() == (tmp_path / "junit.xml").read_text()
    assert checked.refused is False
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
            assert np.isclose(np.sqrt(variance), value * unit[of], rtol=1e-12)
    mean = np.linalg.norm(found.residuals_m, axis=1).mean() * 1000
    assert np.isclose(mean, found.quality["after"]["position"]["mean_mm"], rtol=1e-9)


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
    camera = by_command["camera"]
    # the matrix is made of the quaternion by another hand here
    place = [camera["x_mm"], camera["y_mm"], camera["z_mm"]]
    assert np.allclose(found.camera[:3, 3] * 1000.0, place, rtol=0, atol=1e-9)
    rms = np.sqrt((found.residuals_m**2).mean()) * 1000
    assert np.isclose(rms, by_command["residual_mm"], rtol=1e-9)


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
    for points, row in zip(found.tool_points_m, by_command["poses"], strict=True):
        assert np.allclose(points * 1000.0, row["tool_points_mm"], rtol=0, atol=1e-9)
    for pose, row in zip(found.base_from_tool, by_command["poses"], strict=True):
        assert np.allclose(pose[:3, 3] * 1000.0, [row["pose"][f"{axis}_mm"] for axis in "xyz"], rtol=0, atol=1e-9)
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
        assert np.allclose(frame[:3, 3] * 1000.0, [by_command[name][f"{axis}_mm"] for axis in "xyz"], rtol=0, atol=1e-9)


SAMPLES = sorted(path for path in (Path(__file__).resolve().parents[2] / "programs").glob("*/*/case.yaml"))


@pytest.mark.parametrize("case", SAMPLES, ids=lambda path: f"{path.parts[-3]}-{path.parts[-2]}")
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
