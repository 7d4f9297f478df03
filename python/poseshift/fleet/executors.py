"""Who makes the results: processes of this machine, or a Ray cluster that shares the folder of the store.

Both give a worker some units at a time, lose nothing when a worker dies, and hold keys only: results go through the store.
"""

from __future__ import annotations

import os
import threading
import time
from collections import deque
from collections.abc import Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, field
from itertools import islice
from multiprocessing import get_context
from typing import Any, TypeAlias

from poseshift.fleet.notes import Notes
from poseshift.fleet.store import Store
from poseshift.fleet.units import Unit
from poseshift.fleet.work import crashed, work

# what a worker is given at a time, seconds
PORTION_S = 2.0
# what a unit is thought to take where no run says, seconds
GUESS_S = {"programs": 0.3, "diagnose": 0.3, "since": 0.5}
# units that are sorted into batches at a time
WINDOW = 2048
# batches that wait for a worker
IN_FLIGHT = 4
# how often a unit may end its process, with nobody else in it, before it is to blame
ALONE = 2
# and on a cluster, where nodes die as well
LIVES = 3
# how often a file that cannot be read is tried
TRIES = 3

Batch: TypeAlias = list[Unit]


@dataclass
class Ran:
    """What became of units that were missing."""

    asked: int = 0
    made: int = 0
    failed: dict[str, str] = field(default_factory=dict)
    """Units without a result, by key, and why."""

    def also(self, other: Ran) -> None:
        """Adds what became of others."""
        self.asked += other.asked
        self.made += other.made
        self.failed |= other.failed


def missing(units: Iterable[Unit], store: Store) -> Iterator[Unit]:
    """Units without a result."""
    return (unit for unit in units if not store.has(unit.key))


class Waiting:
    """Units in portions of a few seconds by the last run's times, the longest of some thousand first.

    As many portions as there are workers at least; units are taken when their turn comes.
    """

    def __init__(self, units: Iterable[Unit], ran: Keeper, workers: int) -> None:
        self._units = iter(units)
        self._ran = ran
        self._workers = workers
        self._batches: deque[Batch] = deque()

    def __bool__(self) -> bool:
        if not self._batches:
            self._batches.extend(self._portions(list(islice(self._units, WINDOW))))
        return bool(self._batches)

    def _portions(self, units: list[Unit]) -> list[Batch]:
        # the same unit of several robots is made once
        units = list({unit.key: unit for unit in units}.values())
        self._ran.ask(len(units))
        took = {unit.key: self._ran.seconds(unit) for unit in units}
        portion = min(PORTION_S, sum(took.values()) / max(self._workers, 1))
        made: list[Batch] = []
        filled = portion
        for unit in sorted(units, key=lambda unit: (-took[unit.key], unit.key)):
            if filled >= portion:
                made.append([])
                filled = 0.0
            made[-1].append(unit)
            filled += took[unit.key]
        return made

    def __len__(self) -> int:
        return len(self._batches) if self else 0

    def take(self) -> Batch:
        """The next portion."""
        return self._batches.popleft()

    def first(self, batches: Iterable[Batch]) -> None:
        """Puts portions before all others."""
        self._batches.extendleft(batches)

    def last(self, batches: Iterable[Batch]) -> None:
        """Puts portions behind those that are made up."""
        self._batches.extend(batches)


def run_local(units: Iterable[Unit], store: Store, workers: int | None = None) -> Ran:
    """Makes what is missing in processes of this machine."""
    count = workers or os.cpu_count() or 1
    with Notes(store) as notes:
        ran = Keeper(store, notes)
        waiting = Waiting(missing(units, store), ran, count)
        suspects: Batch = []
        while waiting:
            suspects += _through_pool(waiting, store, count, ran)
        for unit in suspects:
            # whatever ends its process ends nobody else's
            for _ in range(ALONE):
                alone = Waiting((), ran, 1)
                alone.last([[unit]])
                if not _through_pool(alone, store, 1, ran):
                    break
            else:
                ran.keep_crash(unit)
        return ran.ran


def _through_pool(waiting: Waiting, store: Store, count: int, ran: Keeper) -> Batch:
    """Runs batches until all are done or a worker dies: whose worker may have died."""
    broken: Batch = []
    with ProcessPoolExecutor(min(count, len(waiting)), get_context("spawn"), _alone, (os.getpid(),)) as pool:
        running: dict[Future[Any], Batch] = {}
        while waiting or running:
            while waiting and not broken and len(running) < 2 * count:
                batch = waiting.take()
                try:
                    running[pool.submit(work, str(store.folder.absolute()), batch)] = batch
                except BrokenProcessPool:
                    waiting.first([batch])
                    break
            if not running:
                break
            for done in wait(running, return_when=FIRST_COMPLETED).done:
                batch = running.pop(done)
                try:
                    ran.hear(batch, done.result())
                except BrokenProcessPool:
                    broken += batch
                except OSError as error:
                    waiting.last(ran.again(batch, error))
    return broken


def _alone(driver: int) -> None:
    """A worker uses one thread, and ends with the process that started it, however that ends."""
    from poseshift import set_threads  # noqa: PLC0415

    set_threads(1)

    def watch() -> None:
        while os.getppid() == driver:
            time.sleep(1.0)
        os._exit(1)

    if os.name == "posix":
        threading.Thread(target=watch, daemon=True).start()


def run_ray(units: Iterable[Unit], store: Store) -> Ran:
    """Makes what is missing on the Ray cluster that `ray.init` has joined; every node sees the folder of the store."""
    import ray  # noqa: PLC0415
    from ray.exceptions import NodeDiedError, ObjectLostError, OutOfMemoryError, RayTaskError, WorkerCrashedError  # noqa: PLC0415

    died = (WorkerCrashedError, NodeDiedError, ObjectLostError, OutOfMemoryError)
    cpus = max(1, int(ray.cluster_resources().get("CPU", 1)))
    environment = {"env_vars": {"POSESHIFT_THREADS": "1"}}
    task = ray.remote(num_cpus=1, max_retries=0, runtime_env=environment)(work)
    folder = str(store.folder.absolute())
    running: dict[Any, Batch] = {}
    with Notes(store) as notes:
        ran = Keeper(store, notes)
        waiting = Waiting(missing(units, store), ran, cpus)
        while waiting or running:
            while waiting and len(running) < IN_FLIGHT * cpus:
                batch = waiting.take()
                running[task.remote(folder, batch)] = batch
            done, _ = ray.wait(list(running), num_returns=1)
            for reference in done:
                batch = running.pop(reference)
                try:
                    ran.hear(batch, ray.get(reference))
                except died:
                    # its worker or its node; whatever ends workers does so alone, too
                    waiting.first(ran.after_death(batch, LIVES))
                except RayTaskError as error:
                    if not isinstance(error.cause, OSError):
                        raise
                    waiting.last(ran.again(batch, error.cause))
        return ran.ran


class Keeper:
    """Counts what is done, and remembers how long it took."""

    def __init__(self, store: Store, notes: Notes) -> None:
        self._store, self._notes = store, notes
        self._tries: dict[str, int] = {}
        self._deaths: dict[str, int] = {}
        self.ran = Ran()

    def ask(self, count: int) -> None:
        """Counts what is to be made."""
        self.ran.asked += count

    def seconds(self, unit: Unit) -> float:
        """How long a unit is thought to take."""
        known = self._notes.of(unit.robot, f"seconds {unit.job}")
        return GUESS_S.get(unit.job, 0.0) if known is None else float(known)

    def hear(self, batch: Batch, done: list[tuple[str, float]]) -> None:
        """Counts what a worker has made."""
        for unit, (_, seconds) in zip(batch, done, strict=True):
            self._notes.put(unit.robot, f"seconds {unit.job}", round(seconds, 3))
        self._notes.keep()
        self.ran.made += len(batch)

    def keep_crash(self, unit: Unit) -> None:
        """Keeps that a unit ends its process."""
        self._store.keep(unit.key, crashed(unit, "it ends the process that works on it"))
        self.ran.made += 1

    def after_death(self, batch: Batch, lives: int) -> list[Batch]:
        """The units of a batch whose worker died, one by one, until one has died often enough alone."""
        if len(batch) > 1:
            left = list(missing(batch, self._store))
            self.ran.made += len(batch) - len(left)
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
            if self._store.has(unit.key):
                self.ran.made += 1
                continue
            self._tries[unit.key] = self._tries.get(unit.key, 0) + (len(batch) == 1)
            if self._tries[unit.key] < TRIES:
                found.append([unit])
            else:
                self.ran.failed[unit.key] = f"{type(error).__name__}: {error}"
        return found
