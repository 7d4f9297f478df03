"""The command `poseshift-fleet`."""

from __future__ import annotations

import argparse
import datetime
import json
import sqlite3
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path

from poseshift.errors import PoseshiftError
from poseshift.fleet import demo
from poseshift.fleet.collect import collect
from poseshift.fleet.config import read
from poseshift.fleet.drift import parts
from poseshift.fleet.executors import Ran, missing, run_local, run_ray
from poseshift.fleet.store import Store
from poseshift.fleet.units import Unit, plan


def _at_least_one(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text} is not at least 1")
    return int(text)


def _day(text: str) -> str:
    try:
        return datetime.date.fromisoformat(text).isoformat()
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"{text!r} is no day, such as 2026-03-31") from error


def main(words: Sequence[str] | None = None) -> int:
    """Runs the command; 0: every answer is yes, 1: some is no, 2: some robot has no answer."""
    parser = argparse.ArgumentParser(prog="poseshift-fleet", description="Compensates, checks and diagnoses many robots")
    steps = "list what is missing; make it and collect; collect alone; write a plant of simulated robots into a new folder"
    parser.add_argument("step", choices=("plan", "run", "collect", "demo"), help=steps)
    parser.add_argument("fleet", type=Path, help="fleet.yaml; of demo the new folder")
    parser.add_argument("--store", type=Path, help="folder of results, tables and pages")
    parser.add_argument("--robots", type=_at_least_one, default=200, help="of demo (default: 200)")
    parser.add_argument("--seed", type=int, default=1, help="of demo")
    parser.add_argument("--executor", choices=("local", "ray"), default="local")
    parser.add_argument("--address", help="of the Ray cluster; without it, one of this machine")
    parser.add_argument("--workers", type=_at_least_one, help="processes of this machine (default: one a core)")
    parser.add_argument("--date", type=_day, help="day of the history, YYYY-MM-DD (default: today)")
    given = parser.parse_args(words)
    if given.store is None and given.step != "demo":
        parser.error("--store is missing")
    try:
        return _run(given)
    except (PoseshiftError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except ImportError as error:
        print(f"error: {error}\n  the fleet needs more than poseshift alone: pip install 'poseshift[fleet]'", file=sys.stderr)
        return 2
    except sqlite3.Error as error:
        hint = "let the other run in this store end; where there is none, remove the file: it only saves time"
        print(f"error: {given.store / 'notes.db'}: {error}\n  {hint}", file=sys.stderr)
        return 2


def _run(given: argparse.Namespace) -> int:
    if given.step == "demo":
        demo.write(given.fleet, given.robots, given.seed)
        print(f"{given.robots} robots: {given.fleet / 'fleet.yaml'}")
        return 0
    store = Store(given.store)
    date = given.date or datetime.date.today().isoformat()
    units = plan(read(given.fleet), store)
    if given.step == "plan":
        listed = [{"robot": unit.robot, "job": unit.job, "key": unit.key} for unit in missing(units, store)]
        print(json.dumps({"poseshift": "fleet-plan/1", "units": len(units), "missing": listed}, indent=2))
        return 0
    ran, later = _make(units, store, given), Ran()

    def make(since: Iterable[Unit]) -> None:
        later.also(_make(since, store, given))
        ran.failed.update(later.failed)

    summary = collect(parts(units, store, date, make), store, ran.failed, units.run_id, date)
    counts = ", ".join(f"{count} {status}" for status, count in summary.by_status.items() if count)
    print(f"{summary.robots} robots: {counts}; {ran.made} of {len(units)} units made, {len(units) - ran.asked} kept")
    print(f"{given.store / 'fleet.html'}")
    return summary.status


def _make(units: Iterable[Unit], store: Store, given: argparse.Namespace) -> Ran:
    """Makes what is missing of units, where that is asked for."""
    if given.step != "run":
        return Ran(asked=sum(1 for _ in missing(units, store)))
    if given.executor == "local":
        return run_local(units, store, given.workers)
    import ray  # noqa: PLC0415

    ray.init(address=given.address, log_to_driver=False, logging_level="ERROR", ignore_reinit_error=True)
    return run_ray(units, store)


if __name__ == "__main__":
    sys.exit(main())
