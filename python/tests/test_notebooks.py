"""The notebooks run, and say what they say in the repository."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("scipy")
pytest.importorskip("pyarrow")

FOLDER = Path(__file__).resolve().parents[1] / "notebooks"
NAMES = ["calibrate", "compensate", "diagnose", "fleet", "own_fit"]


def said(notebook: Any) -> list[str]:
    """What the cells print and show as text."""
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    return [output.get("text") or output.get("data", {}).get("text/plain", "") for output in outputs]


def test_there_are_these_and_they_are_small() -> None:
    assert sorted(path.stem for path in FOLDER.glob("*.ipynb")) == NAMES
    assert all(path.stat().st_size < 40_000 for path in FOLDER.glob("*.ipynb"))


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("name", NAMES)
def test_a_notebook_says_what_it_says_here(name: str) -> None:
    kept = nbformat.read(FOLDER / f"{name}.ipynb", as_version=4)
    wanted = said(kept)
    assert len(wanted) >= 4
    client = nbclient.NotebookClient(kept, timeout=600, kernel_name="python3", resources={"metadata": {"path": str(FOLDER)}})
    assert said(client.execute()) == wanted
