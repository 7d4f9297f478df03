"""One unit's answer, made where its files are."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import poseshift as ps
from poseshift.fleet.rows import rows_of
from poseshift.fleet.store import Store, sha256
from poseshift.fleet.units import FAULT, SCHEMA, Unit, canonical


def work(store_folder: str, units: list[Unit]) -> list[tuple[str, float]]:
    """Makes the results of units and keeps them: keys and seconds."""
    store, done = Store(Path(store_folder)), []
    for unit in units:
        begun = time.perf_counter()
        if not store.has(unit.key):
            store.keep(unit.key, answer(unit, store))
        done.append((unit.key, time.perf_counter() - begun))
    return done


def crashed(unit: Unit, message: str) -> dict[str, Any]:
    """The result of a unit that ends its process."""
    return _reported(unit, "crashed", {"class": "Crash", "message": message, "hint": ""})


def answer(unit: Unit, store: Store) -> dict[str, Any]:
    """What the library says of a unit. A file that has changed since the plan, or cannot be read, is an `OSError`."""
    # names are relative, in the result as in the backup
    if unit.job != FAULT:
        os.chdir(unit.folder)
    data: dict[str, bytes] = {}
    for role, name, digest in unit.inputs:
        data[name] = store.blob(digest) if role == "kept" else Path(name).read_bytes()
        if sha256(data[name]) != digest:
            raise OSError(f"{unit.folder}/{name} has changed while the fleet was read: run again")
    options = json.loads(unit.options)
    if unit.job == FAULT:
        return _reported(unit, "error", {"class": "FleetError", "message": options[FAULT], "hint": ""})
    try:
        profile = ps.Profile.from_yaml(data[unit.named("profile")[0]].decode(), unit.named("profile")[0])
        return _JOBS[unit.job](unit, store, profile, data, options)
    except (ps.PoseshiftError, ValueError, TypeError) as error:
        reported = error if isinstance(error, ps.PoseshiftError) else ps.PoseshiftError(str(error))
        error_of = {"class": type(error).__name__, "message": reported.message, "hint": reported.hint, "file": reported.file, "line": reported.line}
        return _reported(unit, "error", error_of)
    except BaseException as error:
        # a panic of the library is no Exception
        if type(error).__name__ != "PanicException":
            raise
        return crashed(unit, str(error))


def _programs(unit: Unit, store: Store, profile: ps.Profile, data: dict[str, bytes], options: dict[str, Any]) -> dict[str, Any]:
    programs = {name: data[name] for name in unit.named("program")}
    done = ps.compensate(programs, profile, **options["compensate"])
    documents, pages = {"compensation": done.document}, {}
    files, refused = {}, done.refused
    if refused:
        pages["compensation.html"] = done.html()
    else:
        cell = unit.named("cell")
        checked = ps.check(done.files, profile, nominal=programs, cell=cell[0] if cell else None, **options["check"])
        documents["check"] = checked.document
        refused = checked.refused
        if refused:
            pages["check.html"] = checked.html()
        else:
            files = {f"out/{name}": store.keep_blob(content) for name, content in done.files.items()}
    files |= {f"pages/{name}": store.keep_blob(page.encode()) for name, page in pages.items()}
    return _result(unit, store, "refused" if refused else "done", documents, files)


def _diagnose(unit: Unit, store: Store, profile: ps.Profile, data: dict[str, bytes], options: dict[str, Any]) -> dict[str, Any]:
    tables = tuple((name, data[name]) for name in unit.named("measurements"))
    found = ps.diagnose(profile, ps.Measurements(tables), **options["diagnose"])
    # the nights to come look back on these rows
    files = {f"measured/{name}": store.keep_blob(data[name]) for name, _ in tables}
    if found.verdict != "nothing_missing":
        files["pages/diagnosis.html"] = store.keep_blob(found.html().encode())
    if found.profile is not None:
        files["out/better.yaml"] = store.keep_blob(found.profile.to_yaml().encode())
    status = "done" if found.is_sure else "refused"
    error_mm = _error_mm(profile, ps.Measurements(tables), options["validate"])
    return _result(unit, store, status, {"diagnosis": found.document}, files) | {"error_mm": error_mm}


def _error_mm(profile: ps.Profile, measured: ps.Measurements, options: dict[str, Any]) -> float | None:
    """What the profile misses of rows that it was not calibrated with; none where that cannot be said of them."""
    try:
        document = ps.validate(profile, measured, **options).document
    except ps.PoseshiftError:
        return None
    of: dict[str, float] = (document.get("position") or document.get("range") or {}).get("real", {})
    return of.get("rms_mm")


def _since(unit: Unit, store: Store, profile: ps.Profile, data: dict[str, bytes], options: dict[str, Any]) -> dict[str, Any]:
    """The effect that came with a change. The robot has changed whatever is found."""
    tables = tuple((name, data[name]) for name in unit.named("kept"))
    try:
        found = ps.diagnose(profile, ps.Measurements(tables), **options["diagnose"])
    except ps.PoseshiftError as error:
        return _reported(unit, "changed", {"class": type(error).__name__, "message": error.message, "hint": error.hint})
    files = {"pages/since.html": store.keep_blob(found.html().encode())}
    return _result(unit, store, "changed", {"diagnosis": found.document}, files)


def _result(
    unit: Unit, store: Store, status: str, documents: dict[str, Any], files: dict[str, tuple[str, int]]
) -> dict[str, Any]:
    """The documents themselves are files: whoever collects reads the rows of the tables."""
    kept = {f"documents/{name}.json": store.keep_blob(canonical(document).encode()) for name, document in documents.items()}
    return _head(unit, status) | {"rows": rows_of(unit, status, documents), "files": files | kept}


def _reported(unit: Unit, status: str, error: dict[str, Any]) -> dict[str, Any]:
    """A result without documents."""
    rows = rows_of(unit, status, {}) | {"message": str(error["message"])}
    return _head(unit, status) | {"rows": rows, "files": {}, "error": error}


def _head(unit: Unit, status: str) -> dict[str, Any]:
    return {"poseshift": SCHEMA, "key": unit.key, "job": unit.job, "status": status}


_JOBS: dict[str, Callable[..., dict[str, Any]]] = {"programs": _programs, "diagnose": _diagnose, "since": _since}
