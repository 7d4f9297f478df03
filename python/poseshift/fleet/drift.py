"""Since when a robot errs otherwise: its errors of the nights before and of this one, and a unit that says why.

The test is the library's (`poseshift.changes`). A night without new measurements says nothing new, and with another profile a
robot begins anew.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby, islice
from typing import Any

import poseshift
from poseshift.fleet.config import FleetError
from poseshift.fleet.store import Store
from poseshift.fleet.units import Unit, unit_of

# robots that are collected at a time
PART = 500
# rows of the history that are turned into nights at a time
ROWS = 10_000
# nights that are looked back
NIGHTS = 400
# of the nights since a change, the rows of so many are diagnosed
MOST_SINCE = 10
_COLUMNS = ("robot_id", "profile_sha256", "measured_key", "error_mm")


@dataclass(frozen=True, slots=True)
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


@dataclass(frozen=True)
class Part:
    """Some robots of a fleet, with their units by robot and job, and the results of these."""

    robots: dict[str, list[Unit]]
    results: Mapping[str, dict[str, Any] | None]
    drifts: Mapping[str, Drift]


def parts(units: Iterable[Unit], store: Store, date: str, make: Callable[[Sequence[Unit]], object]) -> Iterator[Part]:
    """The robots of a fleet, some hundred at a time; what says why a robot has changed is made where it is missing."""
    history = _History(store, date)
    by_robot = ((robot, list(of_robot)) for robot, of_robot in groupby(units, lambda unit: unit.robot))
    while robots := dict(islice(by_robot, PART)):
        results = {unit.key: store.result(unit.key) for of_robot in robots.values() for unit in of_robot}
        found = _drifts(robots, results, history)
        later = _since(robots, store, found)
        if later:
            make(later)
        for unit in later:
            robots[unit.robot].append(unit)
            results[unit.key] = store.result(unit.key)
        yield Part(robots, results, found)


def _drifts(robots: dict[str, list[Unit]], results: Mapping[str, dict[str, Any] | None], history: _History) -> dict[str, Drift]:
    """Of each robot with a measured error this night."""
    before = history.of(next(iter(robots)), next(reversed(robots)))
    found = {}
    for unit in (unit for of_robot in robots.values() for unit in of_robot if unit.job == "diagnose"):
        result = results[unit.key]
        if result is None or result.get("error_mm") is None:
            continue
        nights = list(before.get((unit.robot, unit.digest("profile")), ()))
        if not nights or nights[-1].key != unit.key:
            nights.append(Night(history.date, unit.key, result["error_mm"]))
        changes = poseshift.changes([night.error_mm for night in nights])
        found[unit.robot] = Drift(nights, changes[-1] if changes else None)
    return found


class _History:
    """Nights before a date with measurements that were not known before."""

    def __init__(self, store: Store, date: str) -> None:
        import pyarrow as pa  # noqa: PLC0415
        from pyarrow import dataset  # noqa: PLC0415

        self.date = date
        folders = sorted((store.folder / "tables" / "history").glob("run_date=*/robots.parquet"))
        files = [str(path) for path in folders if path.parent.name.removeprefix("run_date=") < date][-NIGHTS:]
        columns = [(name, pa.float64() if name == "error_mm" else pa.string()) for name in (*_COLUMNS, "run_date")]
        parting = dataset.partitioning(pa.schema(columns[-1:]), flavor="hive")
        self._files = dataset.dataset(files, pa.schema(columns), format="parquet", partitioning=parting) if files else None

    def of(self, first: str, last: str) -> dict[tuple[str, str], list[Night]]:
        """The nights of robots from one name to another, by robot and profile."""
        from pyarrow import dataset  # noqa: PLC0415

        found: dict[tuple[str, str], list[Night]] = {}
        if self._files is None:
            return found
        robot, keys = dataset.field("robot_id"), [(name, "ascending") for name in ("robot_id", "profile_sha256", "run_date")]
        wanted = (robot >= first) & (robot <= last) & dataset.field("measured_key").is_valid()
        try:
            table = self._files.to_table(filter=wanted).sort_by(keys)
        except (ValueError, OSError) as error:
            # what pyarrow says of a damaged file is a ValueError
            raise FleetError(f"the history cannot be read: {error}", "remove the night's folder from tables/history: its errors are lost") from error
        known: set[str] = set()
        for batch in table.to_batches(ROWS):
            rows = zip(*(batch[name].to_pylist() for name in (*_COLUMNS, "run_date")), strict=True)
            for name, profile, key, error_mm, night in rows:
                nights = found.setdefault((name, profile), [])
                if not nights:
                    known.clear()
                # of nights with the same measurements the first
                if key not in known:
                    known.add(key)
                    nights.append(Night(night, key, error_mm))
        return found


def _since(robots: Mapping[str, Sequence[Unit]], store: Store, found: Mapping[str, Drift]) -> list[Unit]:
    """A unit for each robot that has become worse: what the rows since say."""
    made = []
    for unit in (unit for of_robot in robots.values() for unit in of_robot):
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
