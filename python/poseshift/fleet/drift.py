"""Since when a robot errs otherwise: its errors of the nights before and of this one, and a unit that says why.

The test is the library's (`poseshift.changes`). A night without new measurements says nothing new, and with another profile a
robot begins anew.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import poseshift
from poseshift.fleet.store import Store
from poseshift.fleet.units import Unit, unit_of

# nights that are looked back
NIGHTS = 400
# of the nights since a change, the rows of so many are diagnosed
MOST_SINCE = 10
_COLUMNS = ("robot_id", "profile_sha256", "measured_key", "error_mm")


@dataclass(frozen=True)
class Night:
    """A night in which a robot was measured."""

    date: str
    key: str
    """Of the unit that diagnosed the measurements."""
    error_mm: float


@dataclass(frozen=True)
class Drift:
    """The nights of a robot under its present profile."""

    nights: Sequence[Night]
    change: poseshift.Change | None
    """The last change of the error."""

    @property
    def is_worse(self) -> bool:
        """Whether somebody should look."""
        return self.change is not None and self.change.after > self.change.before

    def row(self) -> dict[str, Any]:
        """What the table of robots says of it."""
        found: dict[str, Any] = {"nights": len(self.nights), "measured_key": self.nights[-1].key, "error_mm": self.nights[-1].error_mm}
        if self.change is not None:
            since = {"changed_since": self.nights[self.change.since].date, "changed_noticed": self.nights[self.change.noticed].date}
            found |= since | {"changed_before_mm": self.change.before, "changed_after_mm": self.change.after}
        return found


def drifts(units: Sequence[Unit], store: Store, date: str) -> dict[str, Drift]:
    """Of each robot with a measured error this night."""
    before = _history(store, date)
    found = {}
    for unit in units:
        result = store.result(unit.key) if unit.job == "diagnose" else None
        if result is None or result.get("error_mm") is None:
            continue
        nights = list(before.get((unit.robot, unit.digest("profile")), {}).values())
        if not nights or nights[-1].key != unit.key:
            nights.append(Night(date, unit.key, result["error_mm"]))
        changes = poseshift.changes([night.error_mm for night in nights])
        found[unit.robot] = Drift(nights, changes[-1] if changes else None)
    return found


def _history(store: Store, date: str) -> Mapping[tuple[str, str], dict[str, Night]]:
    """Nights before a date with measurements that were not known before, by robot and profile, by key."""
    from pyarrow import parquet  # noqa: PLC0415

    found: dict[tuple[str, str], dict[str, Night]] = {}
    folder = store.folder / "tables" / "history"
    for path in sorted(folder.glob("run_date=*/robots.parquet"))[-NIGHTS:]:
        night = path.parent.name.removeprefix("run_date=")
        names = parquet.read_schema(path).names
        if night >= date or not set(_COLUMNS) <= set(names):
            continue
        columns = parquet.read_table(path, columns=list(_COLUMNS)).to_pydict()
        for robot, profile, key, error_mm in zip(*(columns[name] for name in _COLUMNS), strict=True):
            if key is not None:
                found.setdefault((robot, profile), {}).setdefault(key, Night(night, key, error_mm))
    return found


def since(units: Sequence[Unit], store: Store, found: Mapping[str, Drift]) -> list[Unit]:
    """A unit for each robot that has become worse: what the rows since say."""
    made = []
    for unit in units:
        drift = found.get(unit.robot)
        if unit.job != "diagnose" or drift is None or not drift.is_worse or drift.change is None:
            continue
        # a device that is set up anew each night has a frame of its own each night
        most = 1 if unit.of("validate")["refit_frames"] else MOST_SINCE
        inputs = [(role, name, digest) for role, name, digest in unit.inputs if role != "measurements"]
        for night in drift.nights[drift.change.since :][-most:]:
            files = (store.result(night.key) or {"files": {}})["files"]
            kept = ((name.removeprefix("measured/"), digest) for name, (digest, _) in files.items() if name.startswith("measured/"))
            inputs += [("kept", f"{night.date}/{name}", digest) for name, digest in sorted(kept)]
        made.append(unit_of(unit.robot, "since", unit.folder, tuple(inputs), {"diagnose": unit.of("diagnose")}, unit.version))
    return made
