"""What the tests share: the shipped samples, and the command to compare with."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import poseshift as ps

REPOSITORY = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def root() -> Path:
    return REPOSITORY


@pytest.fixture(scope="session")
def profile() -> ps.Profile:
    return ps.Profile.load(REPOSITORY / "robots/abb_irb120_thesis.yaml")


@pytest.fixture(scope="session")
def q_rad() -> NDArray[np.float64]:
    """Postures within the limits of the arm."""
    rng = np.random.default_rng(1)
    return rng.uniform([-2, -1, -1, -2, 0.2, -3], [2, 1, 0.8, 2, 1.8, 3], (1000, 6))


@pytest.fixture
def run(tmp_path: Path) -> Callable[..., Any]:
    """The command of the wheel in a folder of its own: its JSON."""

    def run(*words: object, status: int | None = 0) -> Any:
        command = [sys.executable, "-m", "poseshift", *map(str, words), "--json"]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False)
        assert status is None or done.returncode == status, done.stderr.decode()
        return json.loads(done.stdout)

    return run


def q_csv(q_rad: NDArray[np.float64]) -> str:
    """Joint angles as a table that is read back as it is."""
    rows = [",".join(repr(float(q)) for q in row) for row in np.rad2deg(q_rad)]
    return "\n".join(["q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg", *rows]) + "\n"


def q_of_csv(text: str) -> NDArray[np.float64]:
    """The radians that the library makes of a table's degrees."""
    names = [f"q{k}_deg" for k in range(1, 7)]
    head, *lines = text.splitlines()
    at = [head.split(",").index(name) for name in names]
    degrees = np.array([[float(line.split(",")[k]) for k in at] for line in lines])
    return degrees * (np.pi / 180.0)
