"""What is known of a fleet: tables, programs to load, one page, `JUnit` XML. Made of results alone, the same bytes of the same."""

from __future__ import annotations

import contextlib
import shutil
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import IO, Any
from xml.sax.saxutils import escape, quoteattr

from poseshift.fleet.config import FleetError
from poseshift.fleet.drift import Part
from poseshift.fleet.notes import Notes
from poseshift.fleet.page import ORDER, Page
from poseshift.fleet.store import Store, write_whole, writing
from poseshift.fleet.units import Unit

# columns of the tables, with their types
_TEXT, _NUMBER, _COUNT = "string", "float64", "int64"
TABLES: Mapping[str, Mapping[str, str]] = {
    "robots": {
        "robot_id": _TEXT, "run_id": _TEXT, "profile_sha256": _TEXT, "status": _TEXT, "programs": _COUNT, "targets": _COUNT,
        "compensated": _COUNT, "mean_shift_mm": _NUMBER, "max_shift_mm": _NUMBER, "max_path_error_mm": _NUMBER,
        "collisions": _COUNT, "verdict": _TEXT, "effect": _TEXT, "held_out_before_mm": _NUMBER, "held_out_after_mm": _NUMBER,
        "noise_mm": _NUMBER, "message": _TEXT, "nights": _COUNT, "measured_key": _TEXT, "error_mm": _NUMBER,
        "changed_since": _TEXT, "changed_noticed": _TEXT, "changed_before_mm": _NUMBER, "changed_after_mm": _NUMBER,
        "changed_effect": _TEXT,
    },
    "programs": {
        "robot_id": _TEXT, "result_key": _TEXT, "program": _TEXT, "status": _TEXT, "targets": _COUNT, "mean_before_mm": _NUMBER,
        "max_shift_mm": _NUMBER, "max_path_error_mm": _NUMBER,
    },
    "findings": {
        "robot_id": _TEXT, "result_key": _TEXT, "job": _TEXT, "id": _TEXT, "severity": _TEXT, "file": _TEXT, "line": _COUNT,
        "message": _TEXT,
    },
    "effects": {
        "robot_id": _TEXT, "result_key": _TEXT, "effect": _TEXT, "sentence": _TEXT, "p_value": _NUMBER, "before_mm": _NUMBER,
        "after_mm": _NUMBER,
    },
}
# folders of files of each robot
KINDS = ("out", "pages")


@dataclass(frozen=True)
class Summary:
    """How a fleet stands."""

    robots: int
    by_status: Mapping[str, int]
    status: int
    """0: every answer is yes; 1: some is no; 2: some robot has none."""


def collect(parts: Iterable[Part], store: Store, failed: Mapping[str, str], run_id: str, date: str) -> Summary:
    """Writes `tables`, `out`, `pages`, `fleet.html` and `junit.xml` into the store's folder, from its results.

    One part of the fleet after another: what is held does not grow with the number of robots.
    """
    store.sweep()
    by_status = dict.fromkeys(ORDER, 0)
    page, before = Page(), ""
    with Notes(store) as notes, _Tables(store, date) as tables, _Junit(store.folder / "junit.xml") as junit:
        for part in parts:
            rows: dict[str, list[dict[str, Any]]] = {name: [] for name in TABLES}
            for robot, units in part.robots.items():
                of_robot = [(unit, part.results[unit.key]) for unit in units]
                row = _robot(robot, run_id, of_robot, failed)
                if robot in part.drifts:
                    row |= part.drifts[robot].row()
                rows["robots"].append(row)
                by_status[row["status"]] += 1
                page.add(row, list(_files(of_robot, "pages")))
                for unit, result in of_robot:
                    _rows(unit, result, rows)
                    junit.add(unit, _status(result), _message(unit, result, failed))
            tables.write(rows)
            last = next(reversed(part.robots))
            notes.forget_between(before, last, list(part.robots))
            before = last
            for kind in KINDS:
                _place(part, store, notes, kind)
            # the next part may have units made, whose notes others write
            notes.keep()
        notes.forget_between(before, None, [])
        for kind in KINDS:
            _remove_others(store, notes, kind)
    write_whole(store.folder / "fleet.html", page.text(by_status, run_id).encode())
    no_answer = by_status["none"] + by_status["crashed"] + by_status["error"]
    no = by_status["refused"] + by_status["changed"]
    return Summary(sum(by_status.values()), by_status, 2 if no_answer else 1 if no else 0)


def _files(of_robot: Iterable[tuple[Unit, dict[str, Any] | None]], kind: str) -> dict[str, str]:
    """The files of a kind in a robot's results, with their hashes."""
    files = (item for _, result in of_robot if result is not None for item in result["files"].items())
    return {name.removeprefix(f"{kind}/"): digest for name, (digest, _) in files if name.startswith(f"{kind}/")}


def _status(result: dict[str, Any] | None) -> str:
    return "none" if result is None else str(result["status"])


def _robot(robot: str, run_id: str, of_robot: Iterable[tuple[Unit, dict[str, Any] | None]], failed: Mapping[str, str]) -> dict[str, Any]:
    row: dict[str, Any] = {"robot_id": robot, "run_id": run_id, "status": "done", "message": ""}
    for unit, result in of_robot:
        row["profile_sha256"] = unit.digest("profile")
        row["status"] = min(row["status"], _status(result), key=ORDER.index)
        row["message"] = row["message"] or _message(unit, result, failed)
        row |= {} if result is None else result["rows"]["robot"]
    return row


def _message(unit: Unit, result: dict[str, Any] | None, failed: Mapping[str, str]) -> str:
    return failed.get(unit.key, "it has not been run") if result is None else str(result["rows"]["message"])


def _rows(unit: Unit, result: dict[str, Any] | None, rows: dict[str, list[dict[str, Any]]]) -> None:
    own = {"robot_id": unit.robot, "result_key": unit.key}
    for name in ("programs", "findings", "effects"):
        rows[name] += [own | row for row in (result or {"rows": {name: []}})["rows"][name]]


class _Tables:
    """The tables, written part by part."""

    def __init__(self, store: Store, date: str) -> None:
        self._folder = store.folder / "tables"
        self._history = self._folder / "history" / f"run_date={date}" / "robots.parquet"
        self._stack = contextlib.ExitStack()
        self._writers: dict[str, Any] = {}
        self._robots = Path()

    def __enter__(self) -> _Tables:
        import pyarrow as pa  # noqa: PLC0415
        from pyarrow import parquet  # noqa: PLC0415

        for name, columns in TABLES.items():
            schema = pa.schema([pa.field(column, getattr(pa, kind)()) for column, kind in columns.items()], {"poseshift": "fleet-table/1"})
            new = self._stack.enter_context(writing(self._folder / f"{name}.parquet"))
            self._robots = new if name == "robots" else self._robots
            self._writers[name] = parquet.ParquetWriter(new, schema, compression="zstd")
        return self

    def write(self, rows: Mapping[str, list[dict[str, Any]]]) -> None:
        """Appends rows to each table."""
        import pyarrow as pa  # noqa: PLC0415

        for name, writer in self._writers.items():
            if rows[name]:
                columns = [pa.array([row.get(f.name) for row in rows[name]], f.type) for f in writer.schema]
                writer.write_table(pa.Table.from_arrays(columns, schema=writer.schema))

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        for writer in self._writers.values():
            writer.close()
        if error is None:
            with writing(self._history) as new:
                shutil.copyfile(self._robots, new)
        self._stack.__exit__(kind, error, trace)


class _Junit:
    """A report for build servers, its cases on disk until their number is known."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._cases, self._bad = 0, 0
        self._body: IO[str] = tempfile.TemporaryFile("w+", encoding="utf-8", newline="")  # noqa: SIM115

    def __enter__(self) -> _Junit:
        return self

    def add(self, unit: Unit, status: str, message: str) -> None:
        """Appends the case of a unit."""
        inner = "" if status == "done" else f"<failure type={quoteattr(status)}>{escape(message)}</failure>"
        self._cases += 1
        self._bad += status != "done"
        self._body.write(f"<testcase classname={quoteattr(unit.robot)} name={quoteattr(unit.job)}>{inner}</testcase>\n")

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        with self._body as body:
            if kind is not None:
                return
            body.seek(0)
            with writing(self._path) as new, new.open("w", encoding="utf-8", newline="") as file:
                file.write('<?xml version="1.0" encoding="UTF-8"?>\n')
                file.write(f'<testsuites><testsuite name="fleet" tests="{self._cases}" failures="{self._bad}">\n')
                shutil.copyfileobj(body, file)
                file.write("</testsuite></testsuites>\n")


def _place(part: Part, store: Store, notes: Notes, kind: str) -> None:
    """Each robot's files, the whole folder at once; where the answer is no, none stay from before."""
    top = store.folder / kind
    wanted = {}
    for robot, units in part.robots.items():
        of_robot = [(unit, part.results[unit.key]) for unit in units]
        if kind == "out" and any(_status(result) != "done" for _, result in of_robot):
            # programs by a profile that does not hold are none to load
            of_robot = [(unit, result) for unit, result in of_robot if unit.job != "programs"]
        wanted[robot] = _files(of_robot, kind)
    stale = {robot for robot, files in wanted.items() if (notes.of(robot, kind) or {}) != files or not _is_whole(top / robot, files, store)}
    if not stale:
        return
    # whatever ends this process, a folder that is noted is whole
    for robot in stale:
        notes.drop(robot, kind)
    notes.keep()
    for robot in sorted(stale):
        if not wanted[robot]:
            shutil.rmtree(top / robot, ignore_errors=True)
            continue
        top.mkdir(parents=True, exist_ok=True)
        made = Path(tempfile.mkdtemp(dir=top, prefix=".new-"))
        try:
            for name, digest in wanted[robot].items():
                if ".." in Path(name).parts:
                    raise FleetError(f"robot {robot}: {name} would lie outside of {top / robot}")
                (made / name).parent.mkdir(parents=True, exist_ok=True)
                (made / name).write_bytes(store.blob(digest))
            made.chmod(0o755)
            shutil.rmtree(top / robot, ignore_errors=True)
            made.rename(top / robot)
        finally:
            shutil.rmtree(made, ignore_errors=True)
        notes.put(robot, kind, wanted[robot])
    notes.keep()


def _is_whole(folder: Path, files: Mapping[str, str], store: Store) -> bool:
    """Whether a folder has these files, by their sizes."""
    if not files:
        return not folder.is_dir()
    try:
        return all((folder / name).stat().st_size == store.blob_place(digest).stat().st_size for name, digest in files.items())
    except (FileNotFoundError, NotADirectoryError):
        return False


def _remove_others(store: Store, notes: Notes, kind: str) -> None:
    """Removes the folders of robots that are no longer of the fleet."""
    top = store.folder / kind
    for folder in top.iterdir() if top.is_dir() else ():
        if notes.of(folder.name, kind) is None:
            shutil.rmtree(folder, ignore_errors=True)
