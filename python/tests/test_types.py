"""Types: the stubs are those of the module, and the package is whole in them."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("mypy")

PACKAGE = Path(__file__).resolve().parents[1]


def mypy(tmp_path: Path, *words: str) -> str:
    command = [sys.executable, "-m", *words]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    return "" if done.returncode == 0 else done.stdout + done.stderr


def test_the_stubs_are_those_of_the_module(tmp_path: Path) -> None:
    allowed = tmp_path / "allowed"
    # what runs the program when it is imported, and what needs more than the wheel
    allowed.write_text("poseshift\\.fleet.*\n")
    assert mypy(tmp_path, "mypy.stubtest", "poseshift._poseshift", "--allowlist", str(allowed), "--ignore-unused-allowlist") == ""


def test_the_package_is_typed(tmp_path: Path) -> None:
    config = str(PACKAGE / "pyproject.toml")
    assert mypy(tmp_path, "mypy", "--config-file", config, "-p", "poseshift") == ""
