"""Who makes the results: processes of this machine, or a Ray cluster that shares the folder of the store.

Both give a worker some units at a time, lose nothing when a worker dies, and hold keys only: results go through the store.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, field
from multiprocessing import get_context
from typing import Any, TypeAlias

from poseshift.fleet.store import Store
from poseshift.fleet.units import Unit
from poseshift.fleet.work import crashed, work

# what a worker is given at a time, seconds
PORTION_S = 2.0
# what a unit is thought to take where no run says, seconds
GUESS_S = {"programs": 0.3, "diagnose": 0.3, "since": 0.5}
# batches that wait for a worker
IN_FLIGHT = 4
# how often a unit may end its process, with nobody else in it, before it is to blame
ALONE = 2
# and on a cluster, where nodes die as well
LIVES = 3
# how often a file that cannot be read is tried
TRIES = 3

Batch: TypeAlias = list[Unit]
Heard: TypeAlias = Callable[[int, int], None]


@dataclass
class Ran:
    """What became of units that were missing."""

    made: int = 0
    failed: dict[str, str] = field(default_factory=dict)
    """Units without a result, by key, and why."""


def missing(units: Sequence[Unit], store: Store) -> list[Unit]:
    """Units without a result, each once."""
    first = {unit.key: unit for unit in units}
    return [unit for unit in first.values() if store.result(unit.key) is None]


def batches(units: Sequence[Unit], store: Store, workers: int) -> list[Batch]:
    """Units in portions of a few seconds by the last run's times, the longest first; as many as there are workers at least."""
    known = store.notes("seconds")
    took = {unit.key: float(known.get(f"{unit.robot} {unit.job}", GUESS_S[unit.job])) for unit in units}
    portion = min(PORTION_S, sum(took.values()) / max(workers, 1))
    made: list[Batch] = []
    filled = portion
    for unit in sorted(units, key=lambda unit: (-took[unit.key], unit.key)):
        if filled >= portion:
            made.append([])
            filled = 0.0
        made[-1].append(unit)
        filled += took[unit.key]
    return made


def run_local(units: Sequence[Unit], store: Store, workers: int | None = None, heard: Heard = lambda done, of: None) -> Ran:
    """Makes what is missing in processes of this machine."""
    wanted = missing(units, store)
    count = workers or os.cpu_count() or 1
    ran = _Keeper(store, len(wanted), heard)
    waiting = batches(wanted, store, count)
    suspects: Batch = []
    while waiting:
        waiting, broken = _through_pool(waiting, store, count, ran)
        suspects += broken
    for unit in suspects:
        # whatever ends its process ends nobody else's
        for _ in range(ALONE):
            _, broken = _through_pool([[unit]], store, 1, ran)
            if not broken:
                break
        else:
            ran.keep_crash(unit)
    return ran.end()


def _through_pool(waiting: list[Batch], store: Store, count: int, ran: _Keeper) -> tuple[list[Batch], Batch]:
    """Runs batches until all are done or a worker dies: what is left, and whose worker may have died."""
    waiting = list(waiting)
    broken: Batch = []
    with ProcessPoolExecutor(min(count, len(waiting)), get_context("spawn"), _alone) as pool:
        running: dict[Future[Any], Batch] = {}
        while waiting or running:
            while waiting and not broken and len(running) < 2 * count:
                try:
                    running[pool.submit(work, str(store.folder.absolute()), waiting[0])] = waiting[0]
                except BrokenProcessPool:
                    break
                waiting.pop(0)
            if not running:
                break
            for done in wait(running, return_when=FIRST_COMPLETED).done:
                batch = running.pop(done)
                try:
                    ran.hear(batch, done.result())
                except BrokenProcessPool:
                    broken += batch
                except OSError as error:
                    waiting += ran.again(batch, error)
    return waiting, broken


def _alone() -> None:
    from poseshift import set_threads  # noqa: PLC0415

    set_threads(1)


def run_ray(units: Sequence[Unit], store: Store, heard: Heard = lambda done, of: None) -> Ran:
    """Makes what is missing on the Ray cluster that `ray.init` has joined; every node sees the folder of the store."""
    import ray  # noqa: PLC0415
    from ray.exceptions import NodeDiedError, ObjectLostError, OutOfMemoryError, RayTaskError, WorkerCrashedError  # noqa: PLC0415

    died = (WorkerCrashedError, NodeDiedError, ObjectLostError, OutOfMemoryError)
    wanted = missing(units, store)
    cpus = max(1, int(ray.cluster_resources().get("CPU", 1)))
    ran = _Keeper(store, len(wanted), heard)
    waiting = batches(wanted, store, cpus)
    environment = {"env_vars": {"POSESHIFT_THREADS": "1"}}
    task = ray.remote(num_cpus=1, max_retries=0, runtime_env=environment)(work)
    folder = str(store.folder.absolute())
    running: dict[Any, Batch] = {}
    while waiting or running:
        while waiting and len(running) < IN_FLIGHT * cpus:
            batch = waiting.pop(0)
            running[task.remote(folder, batch)] = batch
        done, _ = ray.wait(list(running), num_returns=1)
        for reference in done:
            batch = running.pop(reference)
            try:
                ran.hear(batch, ray.get(reference))
            except died:
                # its worker or its node; whatever ends workers does so alone, too
                waiting[:0] = ran.after_death(batch, LIVES)
            except RayTaskError as error:
                if not isinstance(error.cause, OSError):
                    raise
                waiting += ran.again(batch, error.cause)
    return ran.end()


class _Keeper:
    """Counts what is done, and remembers how long it took."""

    def __init__(self, store: Store, of: int, heard: Heard) -> None:
        self._store, self._of, self._heard = store, of, heard
        self._seconds = store.notes("seconds")
        self._tries: dict[str, int] = {}
        self._deaths: dict[str, int] = {}
        self._ran = Ran()

    def hear(self, batch: Batch, done: list[tuple[str, float]]) -> None:
        for unit, (_, seconds) in zip(batch, done, strict=True):
            self._seconds[f"{unit.robot} {unit.job}"] = round(seconds, 3)
        self._made(len(batch))

    def keep_crash(self, unit: Unit) -> None:
        self._store.keep(unit.key, crashed(unit, "it ends the process that works on it"))
        self._made(1)

    def after_death(self, batch: Batch, lives: int) -> list[Batch]:
        """The units of a batch whose worker died, one by one, until one has died often enough alone."""
        if len(batch) > 1:
            left = [unit for unit in batch if self._store.result(unit.key) is None]
            self._made(len(batch) - len(left))
            return [[unit] for unit in left]
        (unit,) = batch
        self._deaths[unit.key] = self._deaths.get(unit.key, 0) + 1
        if self._deaths[unit.key] < lives:
            return [batch]
        self.keep_crash(unit)
        return []

    def again(self, batch: Batch, error: OSError) -> list[Batch]:
        """The units of a batch that failed one by one, until they have been tried often enough."""
        found: list[Batch] = []
        for unit in batch:
            if self._store.result(unit.key) is not None:
                self._made(1)
                continue
            self._tries[unit.key] = self._tries.get(unit.key, 0) + (len(batch) == 1)
            if self._tries[unit.key] < TRIES:
                found.append([unit])
            else:
                self._ran.failed[unit.key] = f"{type(error).__name__}: {error}"
        return found

    def _made(self, count: int) -> None:
        self._ran.made += count
        self._heard(self._ran.made, self._of)

    def end(self) -> Ran:
        if self._ran.made:
            self._store.note("seconds", self._seconds)
        return self._ran


