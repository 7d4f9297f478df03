"""Whether an arm is as it was calibrated, and since when it is not: figures of docs/fleet.md, printed with -s."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import q_csv
from numpy.typing import NDArray

import poseshift as ps

Floats = NDArray[np.float64]
NOISE_M = 5e-5


@pytest.fixture(scope="module")
def calibrated(profile: ps.Profile, q_rad: Floats) -> ps.Profile:
    """Identified from 60 rows, from the arm as its maker describes it."""
    text = profile.to_yaml()
    nominal = ps.Profile.from_yaml(text[: text.index("\ncalibration:")] + "\n")
    return ps.calibrate(nominal, ps.simulate(profile, q_rad[:60], noise_m=NOISE_M, seed=3)).profile


def with_effect(profile: ps.Profile, effect: str) -> ps.Profile:
    text = profile.to_yaml().replace("effects:\n", f"effects:\n    - {effect}\n", 1)
    assert effect in text
    return ps.Profile.from_yaml(text)


def part_measured_again(real: ps.Profile, calibrated: ps.Profile, q_rad: Floats, sessions: int, off_rad: Floats) -> float:
    """Of sessions of ten poses each; the joints stand off by so much."""
    rng = np.random.default_rng(11)
    arm, count = real.arm(), 0
    for _ in range(sessions):
        q = q_rad[rng.choice(len(q_rad), 10, replace=False)]
        seen = arm.forward(q + off_rad)[:, :3, 3] + rng.normal(0, NOISE_M, (10, 3))
        measured = ps.Measurements.from_arrays(q, position_m=seen)
        found = ps.validate(calibrated, measured, as_calibrated=True).as_calibrated
        assert found is not None
        count += found["answer"] == "measure again"
    return count / sessions


def test_ten_poses_are_enough(profile: ps.Profile, calibrated: ps.Profile, q_rad: Floats) -> None:
    again = part_measured_again(profile, calibrated, q_rad, 400, np.zeros(6))
    print(f"as calibrated: {100 * again:.1f} % are measured again")
    assert again < 0.03
    measured = ps.simulate(profile, q_rad[900:910], noise_m=NOISE_M, seed=5)
    said = ps.validate(calibrated, measured, as_calibrated=True)
    found = said.as_calibrated
    assert found is not None
    assert found["answer"] == "as calibrated"
    assert found["rms_mm"] == pytest.approx(said.document["position"]["real"]["rms_mm"], rel=1e-12)
    # what is said to be seen is seen
    for joint in (2, 5):
        off = found["sees_joints_deg"][joint - 1]
        seen = part_measured_again(profile, calibrated, q_rad, 200, np.deg2rad(off) * np.eye(6)[joint - 1])
        print(f"joint {joint} off by {off:.4f} deg: {100 * seen:.0f} % are measured again")
        assert 0.75 < seen <= 1.0
    # a device that is set up anew: what its frame takes up is not seen
    anew = ps.validate(calibrated, measured, as_calibrated=True, refit_frames=True).as_calibrated
    assert anew is not None
    assert anew["answer"] == "as calibrated"
    assert anew["sees_joints_deg"][0] is None
    assert anew["sees_mm"] > found["sees_mm"]


def test_a_profile_that_does_not_know_its_errors(profile: ps.Profile, q_rad: Floats) -> None:
    with pytest.raises(ps.PoseshiftError, match="how well its arm was calibrated"):
        ps.validate(profile, ps.simulate(profile, q_rad[:10]), as_calibrated=True)


def test_changes_by_hand() -> None:
    (change,) = ps.changes([0.05, 0.051, 0.049, 0.05, 0.052, 0.05, 0.2, 0.21, 0.19])
    # one may be a bad night, two are a change
    assert (change.since, change.noticed) == (6, 7)
    assert change.before == pytest.approx(np.prod([0.05, 0.051, 0.049, 0.05, 0.052, 0.05]) ** (1 / 6), rel=1e-12)
    assert change.after == pytest.approx(np.prod([0.2, 0.21, 0.19]) ** (1 / 3), rel=1e-12)
    assert ps.changes([]) == []
    with pytest.raises(ValueError, match="below 0"):
        ps.changes([1.0, -1.0])


def test_runs_as_the_command(run: Callable[..., Any], profile: ps.Profile, q_rad: Floats, tmp_path: Path) -> None:
    (tmp_path / "robot.yaml").write_text(profile.to_yaml())
    robot = ps.Profile.load(tmp_path / "robot.yaml")
    worn = with_effect(profile, "{effect: joint_harmonic, joint: 3, order: 1, cos_deg: 0.05, sin_deg: 0}")
    (tmp_path / "joints.csv").write_text(q_csv(q_rad[:60]))
    names = []
    for night in range(8):
        real = worn if night >= 5 else profile
        measured = ps.simulate(real, q_rad[:60], noise_m=2e-5, seed=night)
        names.append(f"night-{night}.csv")
        (tmp_path / names[-1]).write_bytes(measured.to_csv())
    words = [word for name in names for word in ("--measurements", name)]
    by_command = run("diagnose", "--quick", "--runs", "--profile", "robot.yaml", *words)
    tables = ps.Measurements(tuple((name, (tmp_path / name).read_bytes()) for name in names))
    found = ps.diagnose(robot, tables, quick=True, runs=True)
    assert by_command == found.document
    assert found.drift is not None
    assert [row["file"] for row in found.drift["runs"]] == names
    (change,) = found.drift["changes"]
    assert (change["since"], change["run"]) == ("night-5.csv", 6)
    assert change["before_mm"] < 0.04 < change["after_mm"]
    # the rows since, and what came with them
    assert found.document["rows"] == 3 * 60
    assert "joint_harmonic" in found.effects["effect"]
    with pytest.raises(ps.IdentifyError, match="too few for a change"):
        ps.diagnose(robot, ps.Measurements(tables.files[:3]), runs=True)
