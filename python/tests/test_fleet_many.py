"""Many robots: the driver takes them part by part, and that changes nothing."""

from __future__ import annotations

import re
import shutil
import sqlite3
import tracemalloc
from pathlib import Path
from typing import Any

import pytest

import poseshift as ps

pyarrow = pytest.importorskip("pyarrow")
pytest.importorskip("yaml")

from pyarrow import parquet  # noqa: E402
from test_fleet import ROBOTS, fleet_of, run, shipped, tables  # noqa: E402

from poseshift.fleet import Plan, Store, collect, drift, executors, page, parts  # noqa: E402
from poseshift.fleet.units import unit_of  # noqa: E402

ROWS = 200


@pytest.fixture
def backups(root: Path, profile: ps.Profile, tmp_path: Path) -> Path:
    return fleet_of(ROBOTS, tmp_path, shipped(root, profile))


def rows_of(store: Path) -> dict[str, Any]:
    return {path.stem: parquet.read_table(path).to_pylist() for path in (store / "tables").glob("*.parquet")}


def test_parts_change_no_row_and_no_file(backups: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    status, whole = run(backups, store="whole")
    monkeypatch.setattr(drift, "PART", 1)
    monkeypatch.setattr(executors, "WINDOW", 3)
    assert run(backups, store="parts")[0] == status == 0
    in_parts = backups.parent / "parts"
    assert parquet.ParquetFile(in_parts / "tables/robots.parquet").num_row_groups == ROBOTS
    assert rows_of(in_parts) == rows_of(whole)
    first, second = (tables(store) for store in (whole, in_parts))
    assert {name: data for name, data in first.items() if "tables/" not in name} == {
        name: data for name, data in second.items() if "tables/" not in name
    }
    # a robot that is gone takes its files with it, wherever it stood
    for gone in ("r0", "r2", "r3"):
        shutil.rmtree(backups / gone)
        run(backups, store="parts")
        assert not (in_parts / "out" / gone).exists()
    assert [path.name for path in (in_parts / "out").iterdir()] == ["r1"]


def test_notes_that_are_damaged_begin_anew(backups: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _, store = run(backups)
    first = tables(store)
    for damage in (b"not a database", b""):
        (store / "notes.db").write_bytes(damage)
        capsys.readouterr()
        assert run(backups)[0] == 0
        assert f"0 of {2 * ROBOTS} units made" in capsys.readouterr().out
        assert tables(store) == first


def test_another_run_in_the_store_is_waited_for_and_named(backups: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _, store = run(backups)
    first = tables(store)
    other = sqlite3.connect(store / "notes.db", isolation_level=None)
    try:
        other.execute("BEGIN EXCLUSIVE")
        assert run(backups)[0] == 2
        assert re.search(r"error: .*notes\.db: .*locked\n.*let the other run", capsys.readouterr().err)
    finally:
        other.close()
    assert run(backups)[0] == 0
    assert tables(store) == first


def test_the_page_has_those_that_need_somebody_most(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(page, "MOST", 2)
    made = page.Page()
    for number in range(9):
        made.add({"robot_id": f"r{number}", "status": "refused" if number in (3, 8) else "done"}, [])
    text = made.text({"refused": 2, "done": 7}, "run")
    assert [f"r{number}" for number in range(9) if f">r{number}<" in text] == ["r3", "r8"]
    assert "9 robots" in text
    assert "7 more" in text


def peak(tmp_path: Path, robots: int) -> int:
    """Most bytes that Python holds while results of so many robots are collected."""
    store, units = Store(tmp_path / f"store{robots}"), Plan()
    finding = {"job": "programs", "id": "x", "severity": "warning", "file": "a.mod", "line": 1, "message": "something to look at"}
    for number in range(robots):
        unit = unit_of(f"r{number:04}", "programs", "folder", (("profile", "p.yaml", f"{number}"),), {}, "1")
        rows = {"robot": {}, "programs": [], "findings": [finding] * ROWS, "effects": [], "message": ""}
        store.keep(unit.key, {"status": "done", "rows": rows, "files": {}})
        units.add(unit)
    tracemalloc.start()
    try:
        summary = collect(parts(units, store, "2026-01-31", lambda _: None), store, {}, units.run_id, "2026-01-31")
        found = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert summary.by_status["done"] == robots
    assert parquet.read_metadata(tmp_path / f"store{robots}/tables/findings.parquet").num_rows == robots * ROWS
    return found


def test_the_driver_holds_no_more_of_more_robots(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(drift, "PART", 20)
    monkeypatch.setattr(page, "MOST", 20)
    peak(tmp_path, 20)
    few, many = peak(tmp_path, 60), peak(tmp_path, 300)
    assert many < 1.1 * few, (few, many)
