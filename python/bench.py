"""What a call costs, and arrays on one core: the least of many short runs, as docs/python.md has it. `python -P bench.py`"""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import poseshift as ps

RUNS = 200
TARGETS = 4096


def least_s(what: Callable[[], object], times: int) -> float:
    """Seconds of one call: the least mean of so many."""
    means = []
    for _ in range(RUNS):
        begun = time.perf_counter()
        for _ in range(times):
            what()
        means.append((time.perf_counter() - begun) / times)
    return min(means)


def main() -> None:
    """Prints the table."""
    ps.set_threads(1)
    arm = ps.Profile.load(Path(__file__).resolve().parents[1] / "robots/abb_irb120_thesis.yaml").arm()
    rng = np.random.default_rng(1)
    q = rng.uniform([-2, -1, -1, -2, 0.2, -3], [2, 1, 0.8, 2, 1.8, 3], (8 * TARGETS, 6))
    seen = arm.posture(q)
    q = np.ascontiguousarray(q[(np.abs(seen.wrist_rad) > 0.1) & (np.abs(seen.elbow_rad) > 0.1) & (np.abs(seen.shoulder_m) > 0.03)][:TARGETS])
    poses = arm.forward(q)
    found = arm.solve(poses, near_rad=q)
    one, empty = q[0], np.empty((0, 6))
    print(f"call without rows (0, 6)               {1e6 * least_s(lambda: arm.forward(empty), 200):.2f} us")
    print(f"forward, one posture (6,)              {1e6 * least_s(lambda: arm.forward(one), 200):.2f} us")
    print(f"forward, {len(q)} postures              {1e9 * least_s(lambda: arm.forward(q), 1) / len(q):.0f} ns a posture")
    print(f"inverse, {len(q)} targets, {found.converged.sum()} converged {1e9 * least_s(lambda: arm.solve(poses, near_rad=q), 1) / len(q):.0f} ns a target")


if __name__ == "__main__":
    main()
