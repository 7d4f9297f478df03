"""A plant to try the fleet with: arms of the catalogue with effects drawn by a seed, programs, and a night of measurements."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

import poseshift as ps
from poseshift.fleet.config import FleetError

PROGRAMS = 4
TARGETS = 20
ROWS = 60
NOISE_M = 2e-5
# bows that are drawn, and how far joints turn along one
TRIES = 200
FAR_RAD = 0.6
# every so many arms has a gear that its profile does not know
HIDDEN_EVERY = 20

_FLEET = """poseshift: fleet/1
defaults: {diagnose: {quick: true}}
robots:
  - {folders: "robots/*", profile: profile.yaml, programs: "programs/*.mod", measurements: "measured/*.csv"}
"""


def write(folder: Path, robots: int, seed: int = 1) -> None:
    """Writes a plant into a new folder: `fleet.yaml` and a folder a robot."""
    if folder.exists():
        raise FleetError(f"{folder} is there already", "name a folder that is not")
    arms = [profile for profile in map(ps.Profile.shipped, ps.Profile.names()) if profile.manufacturer == "ABB"]
    plain = [profile for profile in arms if ps.effects(profile).rows == 0]
    kinds = [(profile, postures) for profile in plain if (postures := _postures(profile)) is not None]
    for number in range(robots):
        profile, postures = kinds[number % len(kinds)]
        _robot(folder / "robots" / f"r{number:05}", profile, postures, np.random.default_rng([seed, number]), number)
    (folder / "fleet.yaml").write_text(_FLEET, encoding="utf-8")


def _postures(profile: ps.Profile) -> np.ndarray | None:
    """Postures away from every singularity, with half of each joint's range; none where the arm has no inverse."""
    try:
        arm = profile.arm(model="controller")
    except ps.PoseshiftError:
        return None
    low, high = profile.limits_rad.T
    middle, half = (low + high) / 2, np.minimum((high - low) / 4, 1.2)
    q = middle + half * np.random.default_rng(1).uniform(-1, 1, (4000, 6))
    seen = arm.posture(q)
    clear = (np.abs(seen.wrist_rad) > 0.35) & (np.abs(seen.elbow_rad) > 0.35) & (np.abs(seen.shoulder_m) > 0.1)
    found: np.ndarray = q[clear]
    return found if len(found) >= ROWS else None


def _robot(folder: Path, nominal: ps.Profile, postures: np.ndarray, rng: np.random.Generator, number: int) -> None:
    effects = [
        f"{{effect: link_geometry, link: {link}, a_mm: {rng.normal(0, 0.2):.4f}, theta_deg: {rng.normal(0, 0.05):.5f}}}"
        for link in range(2, 7)
    ]
    text = _with(nominal.to_yaml(), effects)
    profile = ps.Profile.from_yaml(text)
    hidden = "{effect: joint_harmonic, joint: 3, order: 1, cos_deg: 0.03, sin_deg: 0}"
    real = ps.Profile.from_yaml(_with(nominal.to_yaml(), [*effects, hidden])) if number % HIDDEN_EVERY == HIDDEN_EVERY - 1 else profile
    for name in ("programs", "measured"):
        (folder / name).mkdir(parents=True)
    (folder / "profile.yaml").write_text(text, encoding="utf-8")
    for program in range(PROGRAMS):
        data = _module(f"M{program}", profile, postures, rng)
        (folder / "programs" / f"M{program}.mod").write_text(data, encoding="utf-8")
    q = postures[rng.choice(len(postures), ROWS, replace=False)]
    measured = ps.simulate(real, q, noise_m=NOISE_M, seed=int(rng.integers(2**31)))
    (folder / "measured" / "night.csv").write_bytes(measured.to_csv())


def _with(text: str, effects: list[str]) -> str:
    head, found, tail = text.partition("  effects: []")
    if not found:
        raise FleetError("a profile of the catalogue has effects")
    return head + "  effects:\n" + "\n".join(f"    - {effect}" for effect in effects) + tail


def _bow(arms: Sequence[ps.Arm], postures: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """A posture and poses along a bow from there, which every arm reaches without turning far."""
    angles = np.linspace(0, np.pi, TARGETS)
    bow = 0.03 * np.stack([np.cos(angles) - 1, np.sin(angles), 0.1 * rng.normal(size=TARGETS)], axis=1)
    bow[0] = 0
    for _ in range(TRIES):
        q: np.ndarray = postures[rng.integers(len(postures))]
        poses = np.repeat(arms[0].forward(q)[None], TARGETS, axis=0)
        poses[:, :3, 3] += bow
        found = [arm.solve(poses, near_rad=np.repeat(q[None], TARGETS, axis=0)) for arm in arms]
        if all(one.converged.all() and np.abs(one.q_rad - q).max() < FAR_RAD for one in found):
            return q, poses
    raise FleetError("no bow of a simulated program is within reach")


def _module(name: str, profile: ps.Profile, postures: np.ndarray, rng: np.random.Generator) -> str:
    """A RAPID module: joints, then straight lines along a bow."""
    q, poses = _bow([profile.arm(model=model) for model in ("controller", "real")], postures, rng)
    start = poses[0]
    turn = start[:3, :3]
    w = 0.5 * np.sqrt(max(0.0, 1 + turn.trace()))
    quaternion = np.array([w, *_axial(turn, w)])
    free = "[9E9,9E9,9E9,9E9,9E9,9E9]"
    lines = []
    for place in 1000 * poses[:, :3, 3]:
        xyz, wxyz = ",".join(f"{x:.3f}" for x in place), ",".join(f"{x:.8f}" for x in quaternion / np.linalg.norm(quaternion))
        lines.append(f"    MoveL [[{xyz}],[{wxyz}],[0,0,0,0],{free}],v100,z1,tool0;")
    joints = ",".join(f"{x:.4f}" for x in np.rad2deg(q))
    head = f"MODULE {name}\n  PROC main()\n    ConfJ \\Off;\n    ConfL \\Off;\n    MoveAbsJ [[{joints}],{free}],v200,fine,tool0;\n"
    return head + "\n".join(lines) + "\n  ENDPROC\nENDMODULE\n"


def _axial(turn: np.ndarray, w: float) -> np.ndarray:
    """x, y, z of the quaternion of a rotation whose w is known."""
    if w > 1e-3:
        return np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / (4 * w)
    squares = np.maximum(0, (np.diag(turn) + 1) / 2)
    largest = int(squares.argmax())
    found: np.ndarray = turn[largest] / 2 / np.sqrt(squares[largest])
    found[largest] = np.sqrt(squares[largest])
    return found
