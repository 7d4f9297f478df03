"""What is to be done: a unit is one robot's programs, or one robot's measurements, with all that the answer depends on."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import poseshift
from poseshift.fleet.config import FleetError, Robot, options_of
from poseshift.fleet.store import Hashes, Store, sha256

SCHEMA = "fleet-unit/2"
# a line that is no comment and may name a mesh
_MESH = re.compile(rb"^(?!\s*#).*mesh", re.MULTILINE)
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
        """The hash of the first input of this role."""
        return next(digest for of, _, digest in self.inputs if of == role)

    def of(self, task: str) -> dict[str, Any]:
        """The options of a task."""
        found: dict[str, Any] = json.loads(self.options)[task]
        return found


def plan(robots: Sequence[Robot], store: Store, version: str = poseshift.__version__) -> list[Unit]:
    """The units of robots, by robot and job."""
    hashes = Hashes(store)
    units = [unit for robot in robots for unit in _units(robot, hashes, version)]
    hashes.keep()
    return units


def _units(robot: Robot, hashes: Hashes, version: str) -> Iterator[Unit]:
    common = [("profile", robot.profile)]
    cell = [("cell", robot.cell)] if robot.cell else []
    wanted = {
        "programs": common + cell + [("program", name) for name in robot.programs],
        "diagnose": common + [("measurements", name) for name in robot.measurements],
    }
    for job, named in wanted.items():
        if not (robot.programs if job == "programs" else robot.measurements):
            continue
        meshes = [("mesh", mesh) for role, name in named if role in ("profile", "cell") for mesh in _meshes(robot.folder, name)]
        try:
            inputs = tuple((role, name, hashes.of(robot.folder / name)) for role, name in [*named, *meshes])
        except FileNotFoundError as error:
            raise FleetError(f"robot {robot.id}: there is no file {error.filename}") from error
        options = {task: {**options_of(task), **robot.options[task]} for task in JOBS[job]}
        yield unit_of(robot.id, job, str(robot.folder.absolute()), inputs, options, version)


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
