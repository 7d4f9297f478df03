"""What is to be done: a unit is one robot's programs, or one robot's measurements, with all that the answer depends on."""

from __future__ import annotations

import hashlib
import json
import pickle
import re
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import poseshift
from poseshift.fleet.config import KeepOff, Robot, options_of
from poseshift.fleet.notes import Hashes, Notes
from poseshift.fleet.store import Store, sha256

SCHEMA = "fleet-unit/2"
# a line that is no comment and may name a mesh
_MESH = re.compile(rb"^(?!\s*#).*mesh", re.MULTILINE)
# the job of a robot that has no answer
FAULT = "fault"
# the tasks of a job
JOBS = {"programs": ("compensate", "check"), "diagnose": ("validate", "diagnose")}


@dataclass(frozen=True)
class Unit:
    """A job of a robot. `inputs` are role, name in the robot's folder, and hash."""

    robot: str
    job: str
    folder: str
    inputs: tuple[tuple[str, str, str], ...]
    options: str
    key: str
    version: str

    def named(self, role: str) -> list[str]:
        """The names of this role."""
        return [name for of, name, _ in self.inputs if of == role]

    def digest(self, role: str) -> str:
        """The hash of the first input of this role; empty where there is none."""
        return next((digest for of, _, digest in self.inputs if of == role), "")

    def of(self, task: str) -> dict[str, Any]:
        """The options of a task."""
        found: dict[str, Any] = json.loads(self.options)[task]
        return found


class FaultError(Exception):
    """Why a robot has no answer."""


class Plan:
    """The units of a fleet by robot and job, on disk: there may be many."""

    def __init__(self) -> None:
        self._file = tempfile.TemporaryFile()  # noqa: SIM115
        self._hash = hashlib.sha256()
        self._count = 0

    def __del__(self) -> None:
        self._file.close()

    def add(self, unit: Unit) -> None:
        """Appends a unit."""
        pickle.dump(unit, self._file)
        self._hash.update(unit.key.encode())
        self._count += 1

    def __len__(self) -> int:
        return self._count

    def __iter__(self) -> Iterator[Unit]:
        at = 0
        for _ in range(self._count):
            self._file.seek(at)
            unit: Unit = pickle.load(self._file)
            at = self._file.tell()
            yield unit

    @property
    def run_id(self) -> str:
        """A name of all that the answers depend on."""
        return self._hash.hexdigest()[:16]


def plan(robots: Iterable[Robot], store: Store, version: str = poseshift.__version__) -> Plan:
    """The units of robots, by robot and job; nothing is written before every robot has been looked at."""
    made, news = Plan(), tempfile.TemporaryFile()  # noqa: SIM115
    keep_off, options = KeepOff(store.folder), {task: options_of(task) for tasks in JOBS.values() for task in tasks}
    with news, Notes(store) as notes:
        hashes, count = Hashes(notes), 0
        for robot in robots:
            keep_off.judge(robot)
            folder = str(robot.folder.absolute())
            try:
                by_job = _named(robot)
                names = [name for named in by_job.values() for _, name in named]
                found, new = hashes.of(robot.id, [robot.folder / name for name in names])
            except FaultError as error:
                made.add(unit_of(robot.id, FAULT, folder, (), {FAULT: str(error)}, version))
                continue
            except FileNotFoundError as error:
                fault = f"there is no file {error.filename}"
                made.add(unit_of(robot.id, FAULT, folder, (), {FAULT: fault}, version))
                continue
            digests = dict(zip(names, found, strict=True))
            if new is not None:
                pickle.dump((robot.id, new), news)
                count += 1
            for job, named in by_job.items():
                inputs = tuple((role, name, digests[name]) for role, name in named)
                of_job = {task: {**options[task], **robot.options[task]} for task in JOBS[job]}
                made.add(unit_of(robot.id, job, folder, inputs, of_job, version))
        news.seek(0)
        for _ in range(count):
            name, new = pickle.load(news)
            notes.put(name, "files", new)
    return made


def _named(robot: Robot) -> dict[str, list[tuple[str, str]]]:
    """Role and name of the inputs of each job."""
    if robot.fault is not None:
        raise FaultError(robot.fault)
    for name in (*robot.programs, *robot.measurements):
        # bytes that are no UTF-8 are surrogates
        if any("\ud800" <= sign <= "\udfff" for sign in name):
            raise FaultError(f"the name {ascii(name)} is no UTF-8: rename the file")
    common = [("profile", robot.profile)]
    cell = [("cell", robot.cell)] if robot.cell else []
    wanted = {
        "programs": common + cell + [("program", name) for name in robot.programs],
        "diagnose": common + [("measurements", name) for name in robot.measurements],
    }
    meshes = {name: [("mesh", mesh) for mesh in _meshes(robot.folder, name)] for _, name in common + cell}
    by_job = {"diagnose": robot.measurements, "programs": robot.programs}
    return {
        job: wanted[job] + [mesh for _, name in wanted[job] for mesh in meshes.get(name, [])]
        for job, files in by_job.items()
        if files
    }


def unit_of(
    robot: str, job: str, folder: str, inputs: tuple[tuple[str, str, str], ...], options: Mapping[str, Any], version: str
) -> Unit:
    """A unit, its key from all that the answer depends on."""
    named = {"job": job, "schema": SCHEMA, "version": version, "options": options, "inputs": inputs}
    key = sha256(canonical(named).encode())
    return Unit(robot, job, folder, inputs, canonical(options), key, version)


def canonical(value: Any) -> str:
    """JSON text that is the same of the same."""
    return json.dumps(value, sort_keys=True, ensure_ascii=False, separators=(",", ":"), allow_nan=False)


def _meshes(folder: Path, name: str) -> Iterator[str]:
    """The meshes that a profile or a cell names, next to it."""
    data = (folder / name).read_bytes()
    if not _MESH.search(data):
        return
    import yaml  # noqa: PLC0415

    def below(value: object) -> Iterator[str]:
        if isinstance(value, dict):
            for key, inner in value.items():
                if key == "mesh" and isinstance(inner, str):
                    yield (Path(name).parent / inner).as_posix()
                else:
                    yield from below(inner)
        elif isinstance(value, list):
            for inner in value:
                yield from below(inner)

    try:
        yield from sorted(set(below(yaml.safe_load(data))))
    except yaml.YAMLError:
        # the task says what is wrong with it
        return
