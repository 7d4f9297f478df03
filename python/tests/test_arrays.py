"""Shapes, types, numbers that are none."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

import poseshift as ps

Floats = NDArray[np.float64]


@pytest.fixture(scope="module")
def arm(profile: ps.Profile) -> ps.Arm:
    return profile.arm("artifact")


def test_the_leading_dimension_comes_back(arm: ps.Arm, q_rad: Floats) -> None:
    assert arm.forward(q_rad).shape == (1000, 4, 4)
    assert arm.forward(q_rad[0]).shape == (4, 4)
    assert arm.forward(np.empty((0, 6))).shape == (0, 4, 4)
    one = arm.solve(arm.forward(q_rad[0]), near_rad=q_rad[0])
    assert one.q_rad.shape == (6,)
    assert one.status.shape == ()
    assert one.residual_m.shape == ()
    assert arm.solve(np.empty((0, 4, 4))).q_rad.shape == (0, 6)
    assert arm.posture(q_rad[:3]).branch.shape == (3,)


def test_strides_types_and_lists_change_nothing(arm: ps.Arm, q_rad: Floats) -> None:
    wanted = arm.forward(q_rad)
    assert np.array_equal(arm.forward(np.asfortranarray(q_rad)), wanted)
    assert np.array_equal(arm.forward(np.repeat(q_rad, 2, axis=0)[::2]), wanted)
    assert np.array_equal(arm.forward(q_rad.tolist()), wanted)
    single = q_rad.astype(np.float32)
    assert np.array_equal(arm.forward(single), arm.forward(single.astype(np.float64)))
    assert np.array_equal(arm.forward([0, 0, 0, 0, 1, 0]), arm.forward([0.0, 0, 0, 0, 1, 0]))


def test_forward_and_back(arm: ps.Arm, q_rad: Floats) -> None:
    back = arm.solve(arm.forward(q_rad), near_rad=q_rad)
    assert back.converged.mean() > 0.99
    there = back.converged
    assert np.abs(back.q_rad - q_rad)[there].max() < 1e-6
    assert back.residual_m[there].max() < 1e-9
    assert np.array_equal(back.branch, arm.posture(q_rad).branch)
    by_branch = arm.solve(arm.forward(q_rad), branch=back.branch, near_rad=q_rad)
    assert np.array_equal(by_branch.q_rad, back.q_rad)


def test_what_cannot_be_reached_says_so(arm: ps.Arm) -> None:
    far = np.eye(4)
    far[0, 3] = 100.0
    found = arm.solve(far, branch=0)
    assert ps.Status(int(found.status)) is ps.Status.OUT_OF_REACH
    assert not found.converged


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda q: np.full(6, np.nan), r"q_rad\[0\] is nan"),
        (lambda q: np.where(np.arange(6) == 3, np.inf, q[:18]), r"q_rad\[0, 3\] is inf"),
        (lambda q: q[:, :5], r"q_rad has shape \[1000, 5\]; it must be \(n, 6\) or \(6,\)"),
        (lambda q: q[None], r"q_rad has shape \[1, 1000, 6\]"),
    ],
)
def test_wrong_joints_name_their_place(arm: ps.Arm, q_rad: Floats, change: object, message: str) -> None:
    assert callable(change)
    with pytest.raises(ValueError, match=message):
        arm.forward(change(q_rad))


def test_wrong_poses_name_their_place(arm: ps.Arm, profile: ps.Profile, q_rad: Floats) -> None:
    poses = arm.forward(q_rad[:5])
    bent = poses.copy()
    bent[3, 0, 0] += 0.1
    with pytest.raises(ValueError, match=r"world_from_tool\[3\]: the upper left is no rotation"):
        arm.solve(bent)
    mirrored = poses.copy()
    mirrored[1, :3, 0] *= -1
    with pytest.raises(ValueError, match=r"world_from_tool\[1\]: the upper left is no rotation"):
        arm.solve(mirrored)
    last = poses.copy()
    last[2, 3, 3] = 2.0
    with pytest.raises(ValueError, match="the last row"):
        arm.solve(last)
    with pytest.raises(ValueError, match="3 rows of near_rad for 5 poses"):
        arm.solve(poses, near_rad=q_rad[:3])
    with pytest.raises(ValueError, match="branch 9 is not"):
        arm.solve(poses, branch=9)
    with pytest.raises((TypeError, ValueError)):
        arm.forward("six numbers")
    assert arm.solve(poses.astype(np.float32), near_rad=q_rad[:5]).converged.all()
    for wrong in (float("nan"), 1.5, -1, [256]):
        with pytest.raises(ValueError, match="is not a whole number from 0 to 7"):
            arm.solve(poses[0], branch=wrong)
    with pytest.raises(ValueError, match="direction 2 is none"):
        profile.arm(direction=[0, 0, 2, 0, 0, 0])
    with pytest.raises(ValueError, match="direction 0.5 is none"):
        ps.simulate(profile, np.zeros((1, 6)), direction=[[0.5, 0, 0, 0, 0, 0]])


def test_conditions_reach_the_model(profile: ps.Profile, q_rad: Floats) -> None:
    still, pushed = profile.arm(), profile.arm(force_n=[0, 0, -500])
    assert np.abs(still.forward(q_rad) - pushed.forward(q_rad)).max() > 1e-7
    controller = profile.arm(model="controller")
    apart = controller.forward(q_rad)[:, :3, 3] - still.forward(q_rad)[:, :3, 3]
    assert 1e-4 < np.linalg.norm(apart, axis=1).max() < 2e-2
    with pytest.raises(ValueError, match="model is"):
        profile.arm(model="ideal")
    with pytest.raises(ValueError, match="force_n"):
        profile.arm(force_n=[0, 0, np.nan])
