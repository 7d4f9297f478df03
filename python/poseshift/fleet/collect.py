"""What is known of a fleet: tables, programs to load, one page, `JUnit` XML. Made of results alone, the same bytes of the same."""

from __future__ import annotations

import html
import shutil
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape, quoteattr

from poseshift.fleet.drift import Drift
from poseshift.fleet.store import Store, sha256, write_whole
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
# the worst first
ORDER = ("none", "crashed", "error", "refused", "changed", "done")


@dataclass(frozen=True)
class Summary:
    """How a fleet stands."""

    robots: int
    by_status: Mapping[str, int]
    status: int
    """0: every answer is yes; 1: some is no; 2: some robot has none."""


def collect(
    units: Sequence[Unit],
    store: Store,
    failed: Mapping[str, str],
    date: str | None = None,
    drifts: Mapping[str, Drift] | None = None,
) -> Summary:
    """Writes `tables`, `out`, `pages`, `fleet.html` and `junit.xml` into the store's folder, from its results."""
    store.sweep()
    found = {unit.key: store.result(unit.key) for unit in units}
    units = sorted(units, key=lambda unit: (unit.robot, unit.job))
    run_id = sha256("\n".join(unit.key for unit in units).encode())[:16]
    by_robot: dict[str, list[tuple[Unit, dict[str, Any] | None]]] = {}
    for unit in units:
        by_robot.setdefault(unit.robot, []).append((unit, found[unit.key]))
    rows: dict[str, list[dict[str, Any]]] = {name: [] for name in TABLES}
    for robot, of_robot in by_robot.items():
        row = _robot(robot, run_id, of_robot, failed)
        if drifts and robot in drifts:
            row |= drifts[robot].row()
        rows["robots"].append(row)
        for unit, result in of_robot:
            _rows(unit, result, rows)
    _write_tables(store.folder / "tables", rows, date)
    _place(by_robot, store, "out")
    _place(by_robot, store, "pages")
    write_whole(store.folder / "fleet.html", _page(rows["robots"], run_id, by_robot).encode())
    write_whole(store.folder / "junit.xml", _junit(by_robot, failed).encode())
    by_status = {status: sum(row["status"] == status for row in rows["robots"]) for status in ORDER}
    no_answer = by_status["none"] + by_status["crashed"] + by_status["error"]
    return Summary(len(by_robot), by_status, 2 if no_answer else 1 if by_status["refused"] + by_status["changed"] else 0)


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


def _write_tables(folder: Path, rows: Mapping[str, list[dict[str, Any]]], date: str | None) -> None:
    import pyarrow as pa  # noqa: PLC0415
    from pyarrow import parquet  # noqa: PLC0415

    def write(path: Path, name: str) -> None:
        fields = [pa.field(column, getattr(pa, kind)()) for column, kind in TABLES[name].items()]
        schema = pa.schema(fields, {"poseshift": "fleet-table/1"})
        columns = [pa.array([row.get(f.name) for row in rows[name]], f.type) for f in fields]
        sink = pa.BufferOutputStream()
        parquet.write_table(pa.Table.from_arrays(columns, schema=schema), sink, compression="zstd")
        data = sink.getvalue().to_pybytes()
        if not path.exists() or path.read_bytes() != data:
            write_whole(path, data)

    for name in TABLES:
        write(folder / f"{name}.parquet", name)
    if date is not None:
        write(folder / "history" / f"run_date={date}" / "robots.parquet", "robots")


def _place(by_robot: Mapping[str, Sequence[tuple[Unit, dict[str, Any] | None]]], store: Store, kind: str) -> None:
    """Each robot's files, the whole folder at once; where the answer is no, none stay from before."""
    top = store.folder / kind
    placed = store.notes(kind)
    wanted: dict[str, dict[str, str]] = {}
    for robot, of_robot in by_robot.items():
        for _, result in of_robot:
            for name, (digest, _) in (result or {"files": {}})["files"].items():
                if name.startswith(f"{kind}/"):
                    wanted.setdefault(robot, {})[name.removeprefix(f"{kind}/")] = digest
    for robot in sorted(placed.keys() - wanted.keys()):
        shutil.rmtree(top / robot, ignore_errors=True)
    for robot, files in wanted.items():
        if placed.get(robot) == files and (top / robot).is_dir():
            continue
        top.mkdir(parents=True, exist_ok=True)
        made = Path(tempfile.mkdtemp(dir=top, prefix=".new-"))
        try:
            for name, digest in files.items():
                (made / name).parent.mkdir(parents=True, exist_ok=True)
                (made / name).write_bytes(store.blob(digest))
            made.chmod(0o755)
            shutil.rmtree(top / robot, ignore_errors=True)
            made.rename(top / robot)
        finally:
            shutil.rmtree(made, ignore_errors=True)
    if placed != wanted:
        store.note(kind, wanted)


_STYLE = (
    ":root{color-scheme:light dark;--ink:#222;--ground:#fff;--rule:#ddd;--link:#0b62a8;--bad:#a00;--no:#a04000;--good:#060}"
    "@media(prefers-color-scheme:dark){"
    ":root{--ink:#e7ebf0;--ground:#14181e;--rule:#38424e;--link:#6cb6f5;--bad:#ff8a80;--no:#f0c05a;--good:#3fd0b4}}"
    "body{font:15px system-ui;margin:2em auto;padding:0 1em;max-width:90em;color:var(--ink);background:var(--ground)}"
    "table{border-collapse:collapse}.rows{overflow-x:auto}a{color:var(--link)}"
    "td,th{padding:.25em .7em;text-align:left;border-bottom:1px solid var(--rule)}"
    "td{overflow-wrap:break-word;max-width:40ch}td.number{text-align:right;font-variant-numeric:tabular-nums}"
    ".none,.crashed,.error{color:var(--bad)}.refused,.changed{color:var(--no)}.done{color:var(--good)}"
)


def _page(robots: Sequence[dict[str, Any]], run_id: str, by_robot: Mapping[str, Sequence[tuple[Unit, dict[str, Any] | None]]]) -> str:
    """The fleet on one page without a script: the robots that need somebody first."""

    def need(row: dict[str, Any]) -> tuple[Any, ...]:
        held, path = row.get("held_out_before_mm") or 0.0, row.get("max_path_error_mm") or 0.0
        return ORDER.index(row["status"]), -(row.get("collisions") or 0), -held, -path, row["robot_id"]

    columns = ("status", "max_path_error_mm", "collisions", "max_shift_mm", "verdict", "effect", "held_out_before_mm", "error_mm", "changed_since",
               "changed_before_mm", "changed_after_mm", "message")  # fmt: skip
    lines = []
    for row in sorted(robots, key=need):
        robot = row["robot_id"]
        pages = [n for _, r in by_robot[robot] for n in (r or {"files": {}})["files"] if n.startswith("pages/")]
        links = " ".join(
            f'<a href="pages/{html.escape(robot)}/{html.escape(n[6:])}">{html.escape(n[6:-5])}</a>' for n in sorted(pages)
        )
        cells = "".join(_cell(name, row.get(name)) for name in columns)
        lines.append(f'<tr><th scope="row">{html.escape(robot)}</th>{cells}<td>{links}</td></tr>')
    counts = ", ".join(f"{n} {s}" for s in ORDER if (n := sum(row["status"] == s for row in robots)))
    heads = "".join(f'<th scope="col">{name}</th>' for name in (n.replace("_", " ") for n in ("robot", *columns, "pages")))
    return (
        '<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Fleet</title>'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">"
        f"<style>{_STYLE}</style></head><body><main><h1>{len(robots)} robots</h1><p>{counts}; run {run_id}</p>"
        '<div class="rows" tabindex="0" role="region" aria-label="Robots">'
        f"<table><thead><tr>{heads}</tr></thead><tbody>\n" + "\n".join(lines) + "\n</tbody></table></div></main></body></html>\n"
    )


def _cell(name: str, value: Any) -> str:
    if isinstance(value, int | float):
        return f'<td class="number">{value:.3f}</td>' if isinstance(value, float) else f'<td class="number">{value}</td>'
    text = html.escape("" if value is None else str(value))
    return f'<td class="{text}">{text}</td>' if name == "status" else f"<td>{text}</td>"


def _junit(by_robot: Mapping[str, Sequence[tuple[Unit, dict[str, Any] | None]]], failed: Mapping[str, str]) -> str:
    cases, bad = [], 0
    for robot, of_robot in by_robot.items():
        for unit, result in of_robot:
            inner = ""
            if _status(result) != "done":
                bad += 1
                inner = f"<failure type={quoteattr(_status(result))}>{escape(_message(unit, result, failed))}</failure>"
            cases.append(f"<testcase classname={quoteattr(robot)} name={quoteattr(unit.job)}>{inner}</testcase>")
    body = "\n".join(cases)
    return (
        f'<?xml version="1.0" encoding="UTF-8"?>\n<testsuites><testsuite name="fleet" tests="{len(cases)}" failures="{bad}">\n'
        f"{body}\n</testsuite></testsuites>\n"
    )
