"""`fleet.yaml`: which robots there are, and where their files lie."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import poseshift
from poseshift.errors import PoseshiftError

FORMAT = "fleet/1"
KEYS = ("id", "folders", "profile", "programs", "measurements", "cell", "options")
# what a task takes from the robot and not from its options
_OWN = {"files", "profile", "context", "nominal", "cell", "baseline", "measurements", "despite_errors", "tool", "frame", "steps"} | {
    "runs", "as_calibrated", "folds", "level", "priors",
}  # fmt: skip
TASKS: Mapping[str, Callable[..., Any]] = {
    "compensate": poseshift.compensate,
    "check": poseshift.check,
    "validate": poseshift.validate,
    "diagnose": poseshift.diagnose,
}


class FleetError(PoseshiftError):
    """A fleet that cannot be read, or files of it that are not there."""


@dataclass(frozen=True)
class Robot:
    """A robot and its files; names are relative to `folder`."""

    id: str
    folder: Path
    profile: str
    programs: tuple[str, ...]
    measurements: tuple[str, ...]
    cell: str | None
    options: Mapping[str, Mapping[str, Any]]

    def inputs(self) -> list[Path]:
        """Every file that is named."""
        names = [self.profile, *self.programs, *self.measurements, *([self.cell] if self.cell else [])]
        return [self.folder / name for name in names]


def keep_off(robots: Iterable[Robot], store: Path) -> None:
    """Nothing is ever written among the backups: the store lies in no folder of an input, and no input in the store."""
    own = store.resolve()
    for robot in robots:
        for file in robot.inputs():
            if own.is_relative_to(file.resolve().parent) or file.resolve().is_relative_to(own):
                raise FleetError(f"the store {store} lies among the files of robot {robot.id}", "choose a folder apart from the backups")


def options_of(task: str) -> dict[str, Any]:
    """The options of a task that a fleet may set, with their defaults."""
    parameters = inspect.signature(TASKS[task]).parameters.values()
    return {p.name: p.default for p in parameters if p.name not in _OWN}


def read(path: Path) -> list[Robot]:
    """The robots of a fleet file, by id."""
    import yaml  # noqa: PLC0415

    try:
        said = yaml.safe_load(path.read_text(encoding="utf-8"))
    except yaml.YAMLError as error:
        raise FleetError(f"{path}: {error}") from error
    top = _mapping(said, f"{path}", ("poseshift", "defaults", "robots"))
    if top.get("poseshift") != FORMAT:
        raise FleetError(f"{path}: poseshift is {top.get('poseshift')!r}; it must be {FORMAT}")
    defaults = _options(top.get("defaults") or {}, f"{path}: defaults")
    entries = top.get("robots")
    if not isinstance(entries, list) or not entries:
        raise FleetError(f"{path}: robots must be a list of at least one entry")
    robots: dict[str, Robot] = {}
    for number, entry in enumerate(entries):
        for robot in _robots(entry, f"{path}: robots[{number}]", path.parent, defaults):
            if robot.id in robots:
                raise FleetError(f"{path}: two robots are called {robot.id!r}")
            robots[robot.id] = robot
    return [robots[name] for name in sorted(robots)]


def _robots(entry: object, where: str, top: Path, defaults: Mapping[str, Mapping[str, Any]]) -> Iterator[Robot]:
    said = _mapping(entry, where, KEYS)
    own = _options(said.get("options") or {}, f"{where}: options")
    options = {task: {**defaults[task], **own[task]} for task in TASKS}
    if ("id" in said) == ("folders" in said):
        raise FleetError(f"{where}: give id, or folders where each folder is a robot")
    if "profile" not in said:
        raise FleetError(f"{where}: profile is missing")
    folders = [top] if "id" in said else sorted(p for p in top.glob(str(said["folders"])) if p.is_dir())
    if not folders:
        raise FleetError(f"{where}: no folder is called {said['folders']}")
    for folder in folders:
        name = str(said.get("id", folder.name))
        if not name or name.startswith(".") or not all(c.isalnum() or c in "-_. " for c in name):
            raise FleetError(f"{where}: the id {name!r} must be letters, digits, `-`, `_`, `.` and blanks", "it names a folder")
        robot = Robot(
            name,
            folder,
            str(said["profile"]),
            _files(said.get("programs"), folder),
            _files(said.get("measurements"), folder),
            said.get("cell"),
            options,
        )
        for file in robot.inputs():
            if not file.is_file():
                raise FleetError(f"{where}: robot {name}: there is no file {file}")
        if not robot.programs and not robot.measurements:
            raise FleetError(f"{where}: robot {name} has neither programs nor measurements in {folder}")
        yield robot


def _files(patterns: object, folder: Path) -> tuple[str, ...]:
    if patterns is None:
        return ()
    listed: Sequence[object] = patterns if isinstance(patterns, list) else [patterns]
    found = {file.relative_to(folder).as_posix() for p in listed for file in folder.glob(str(p)) if file.is_file()}
    return tuple(sorted(found))


def _options(said: object, where: str) -> dict[str, dict[str, Any]]:
    by_task = _mapping(said, where, tuple(TASKS))
    found = {}
    for task in TASKS:
        found[task] = _mapping(by_task.get(task) or {}, f"{where}: {task}", tuple(options_of(task)))
    return found


def _mapping(value: object, where: str, known: Sequence[str]) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise FleetError(f"{where} must be keys and values")
    for key in value:
        if key not in known:
            raise FleetError(f"{where}: no key is called {key!r}", f"keys are: {', '.join(known)}")
    return dict(value)
