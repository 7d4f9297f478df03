"""`fleet.yaml`: which robots there are, and where their files lie."""

from __future__ import annotations

import inspect
import json
import os
import stat
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import poseshift
from poseshift.errors import PoseshiftError

FORMAT = "fleet/1"
KEYS = ("id", "folders", "profile", "programs", "measurements", "cell", "options")
# keys that name files by patterns
FILES = ("programs", "measurements")
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
    fault: str | None = None
    """Why there can be no answer: files that are not there."""

    def inputs(self) -> list[Path]:
        """Every file that is named."""
        names = [self.profile, *self.programs, *self.measurements, *([self.cell] if self.cell else [])]
        return [self.folder / name for name in names]


class Fleet:
    """The robots of a fleet file by id, each read when its turn comes: there may be many."""

    def __init__(self, places: dict[str, tuple[str, int]], entries: list[Entry]) -> None:
        self._places = places
        self._entries = entries
        self._names = sorted(places)

    def __len__(self) -> int:
        return len(self._names)

    def __iter__(self) -> Iterator[Robot]:
        for name in self._names:
            folder, number = self._places[name]
            yield self._entries[number].robot(name, folder)


@dataclass(frozen=True)
class Entry:
    """What robots of an entry have in common."""

    where: str
    said: Mapping[str, Any]
    options: Mapping[str, Mapping[str, Any]]

    def robot(self, name: str, place: str) -> Robot:
        """The robot with its files; what is not there is its fault, and no other robot's."""
        said, folder = self.said, Path(place)
        is_alone = "id" in said
        (programs, no_program), (measurements, no_measurement) = (_files(said.get(key), folder, is_alone) for key in FILES)
        robot = Robot(name, folder, str(said["profile"]), programs, measurements, said.get("cell"), self.options)
        faults = [f"there is no file {file}" for file in robot.inputs() if not file.is_file()]
        faults += [f"no file is called {pattern} in {folder}" for pattern in (*no_program, *no_measurement)]
        if not robot.programs and not robot.measurements:
            faults.append(f"there are neither programs nor measurements in {folder}")
        return replace(robot, fault=faults[0]) if faults else robot


class KeepOff:
    """Nothing is ever written among the backups: the store lies in no folder of an input, and no input in the store."""

    def __init__(self, store: Path) -> None:
        self._store = store
        self._own = os.path.realpath(store)
        self._folder = ("", "")

    def judge(self, robot: Robot) -> None:
        """Refuses a robot whose files the store lies among."""
        for file in robot.inputs():
            if not os.path.lexists(file):
                continue
            folder = self._real(file)
            if _is_below(self._own, folder) or _is_below(folder, self._own):
                raise FleetError(f"the store {self._store} lies among the files of robot {robot.id}", "choose a folder apart from the backups")

    def _real(self, file: Path) -> str:
        """The folder that a file is in, in the end."""
        if stat.S_ISLNK(os.lstat(file).st_mode):
            return os.path.dirname(os.path.realpath(file))
        folder = os.path.dirname(file)
        if self._folder[0] != folder:
            self._folder = (folder, os.path.realpath(folder))
        return self._folder[1]


def _is_below(path: str, top: str) -> bool:
    return path == top or path.startswith(top.rstrip(os.sep) + os.sep)


def options_of(task: str) -> dict[str, Any]:
    """The options of a task that a fleet may set, with their defaults."""
    parameters = inspect.signature(TASKS[task]).parameters.values()
    return {p.name: p.default for p in parameters if p.name not in _OWN}


def read(path: Path) -> Fleet:
    """The robots of a fleet file."""
    import yaml  # noqa: PLC0415

    try:
        said = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise FleetError(f"{path}: {error}") from error
    top = _mapping(said, f"{path}", ("poseshift", "defaults", "robots"))
    if top.get("poseshift") != FORMAT:
        raise FleetError(f"{path}: poseshift is {top.get('poseshift')!r}; it must be {FORMAT}")
    defaults = _options(top.get("defaults") or {}, f"{path}: defaults")
    entries = top.get("robots")
    if not isinstance(entries, list) or not entries:
        raise FleetError(f"{path}: robots must be a list of at least one entry")
    places: dict[str, tuple[str, int]] = {}
    known = []
    for number, said_of in enumerate(entries):
        where = f"{path}: robots[{number}]"
        entry = _entry(said_of, where, defaults)
        known.append(entry)
        for name, folder in _places(entry, path.parent):
            if name in places:
                raise FleetError(f"{path}: two robots are called {name!r}")
            places[name] = (folder, number)
    return Fleet(places, known)


def _entry(entry: object, where: str, defaults: Mapping[str, Mapping[str, Any]]) -> Entry:
    said = _mapping(entry, where, KEYS)
    own = _options(said.get("options") or {}, f"{where}: options")
    options = {task: {**defaults[task], **own[task]} for task in TASKS}
    if ("id" in said) == ("folders" in said):
        raise FleetError(f"{where}: give id, or folders where each folder is a robot")
    if "profile" not in said:
        raise FleetError(f"{where}: profile is missing")
    for key in (*FILES, "folders"):
        for pattern in _listed(said.get(key)):
            _judge_pattern(pattern, f"{where}: {key}", is_output=key == "programs")
    return Entry(where, said, options)


def _places(entry: Entry, top: Path) -> Iterator[tuple[str, str]]:
    """The robots of an entry and their folders."""
    said, where, count = entry.said, entry.where, 0
    for folder in [top] if "id" in said else top.glob(str(said["folders"])):
        if not folder.is_dir():
            continue
        name = str(said.get("id", folder.name))
        if not name or name.startswith(".") or not all(c.isalnum() or c in "-_. " for c in name):
            raise FleetError(f"{where}: the id {name!r} must be letters, digits, `-`, `_`, `.` and blanks", "it names a folder")
        yield name, os.fspath(folder)
        count += 1
    if not count:
        raise FleetError(f"{where}: no folder is called {said['folders']}")


def _listed(patterns: object) -> list[str]:
    if patterns is None:
        return []
    return [str(pattern) for pattern in (patterns if isinstance(patterns, list) else [patterns])]


def _judge_pattern(pattern: str, where: str, *, is_output: bool) -> None:
    """Refuses what names no file below the folder."""
    if not pattern.strip():
        raise FleetError(f"{where} is empty", "leave the key out, or name files")
    if Path(pattern).is_absolute():
        raise FleetError(f"{where}: {pattern!r} is absolute", "names are relative to the folder of the fleet file, or of the robot")
    if is_output and ".." in Path(pattern).parts:
        hint = "new programs lie in the store as these do in the folder: give the robot's own folder with `folders`, or put the fleet file above"
        raise FleetError(f"{where}: {pattern!r} leaves the folder", hint)


def _files(patterns: object, folder: Path, is_alone: bool) -> tuple[tuple[str, ...], list[str]]:
    """The files that are named, and patterns that one robot alone has and that name nothing."""
    found: set[str] = set()
    empty = []
    for pattern in _listed(patterns):
        if not any(sign in pattern for sign in "*?["):
            found.add(Path(pattern).as_posix())
            continue
        named = {file.relative_to(folder).as_posix() for file in folder.glob(pattern) if file.is_file()}
        # in a name such a sign is one of the name
        named |= {Path(pattern).as_posix()} if (folder / pattern).is_file() else set()
        if is_alone and not named:
            empty.append(pattern)
        found |= named
    return tuple(sorted(found)), empty


def _options(said: object, where: str) -> dict[str, dict[str, Any]]:
    by_task = _mapping(said, where, tuple(TASKS))
    found = {}
    for task in TASKS:
        found[task] = _mapping(by_task.get(task) or {}, f"{where}: {task}", tuple(options_of(task)))
        for key, value in found[task].items():
            _check_kind(value, _kinds_of(task, key), f"{where}: {task}: {key}")
    return found


# what the file may have where a task says so
_KINDS: Mapping[str, tuple[type, ...]] = {"bool": (bool,), "int": (int,), "float": (int, float), "str": (str,), "None": (type(None),)}


def _kinds_of(task: str, key: str) -> tuple[type, ...] | None:
    """The types that an option of a task may have; None where they are not of a file's own kinds."""
    annotation = str(inspect.signature(TASKS[task]).parameters[key].annotation)
    words = [word.strip() for word in annotation.split("|")]
    if not all(word in _KINDS for word in words):
        return None
    return tuple(kind for word in words for kind in _KINDS[word])


def _check_kind(value: object, kinds: tuple[type, ...] | None, where: str) -> None:
    try:
        json.dumps(value, allow_nan=False)
    except (TypeError, ValueError) as error:
        raise FleetError(f"{where} is {value}; it must be a finite number, a text, true or false, null, or a list of these") from error
    if kinds is None or (isinstance(value, kinds) and (bool in kinds or not isinstance(value, bool))):
        return
    names = {bool: "true or false", int: "a number", float: "a number", str: "a text", type(None): "null"}
    wanted = " or ".join(dict.fromkeys(names[kind] for kind in kinds))
    raise FleetError(f"{where} is {value!r}; it must be {wanted}")


def _mapping(value: object, where: str, known: Sequence[str]) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise FleetError(f"{where} must be keys and values")
    for key in value:
        if key not in known:
            raise FleetError(f"{where}: no key is called {key!r}", f"keys are: {', '.join(known)}")
    return dict(value)
