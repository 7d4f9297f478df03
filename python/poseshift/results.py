"""What functions find: documents with the names and units of the command's JSON, tables, arrays, pages."""

from __future__ import annotations

import enum
import html
import json
import os
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from poseshift import _poseshift
from poseshift.errors import Refused
from poseshift.table import Table

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from poseshift._poseshift import Document, Profile

__all__ = [
    "Axes",
    "Calibration",
    "Change",
    "Check",
    "Compensation",
    "Diagnosis",
    "Fit",
    "HandEye",
    "Hexapod",
    "Plan",
    "Program",
    "Result",
    "Status",
    "SurfaceFit",
    "Validation",
]


class Status(enum.IntEnum):
    """How the search for a pose ended."""

    CONVERGED = 0
    OUT_OF_REACH = 1
    JOINT_LIMIT = 2
    BRANCH_LOST = 3
    NOT_CONVERGED = 4


@dataclass(frozen=True, eq=False, repr=False)
class Result:
    """A document of the command, read when it is asked for."""

    _document: Document = field(repr=False)

    def json(self) -> str:
        """What the command prints with `--json`."""
        return self._document.json()

    @cached_property
    def document(self) -> dict[str, Any]:
        """The same as a dictionary."""
        read: dict[str, Any] = json.loads(self.json())
        return read

    @property
    def findings(self) -> Table:
        """What a person should look at."""
        return self._table("findings")

    def html(self, made: str | None = None) -> str:
        """The page that the command writes with `--report`; `made` stands at its foot."""
        page = self._document.html(made or f"poseshift {_poseshift.__version__}")
        if page is None:
            raise ValueError("there is nothing to look at of this result")
        return page

    def show(self, height: int = 800) -> Any:
        """The page in a notebook, in a document of its own."""
        from IPython.display import HTML  # noqa: PLC0415

        page = html.escape(self.html(), quote=True)
        return HTML(f'<iframe srcdoc="{page}" width="100%" height="{height}" style="border:0"></iframe>')

    def __str__(self) -> str:
        return self._document.words()

    def __repr__(self) -> str:
        return f"<{type(self).__name__}>\n{self}"

    def _repr_html_(self) -> str:
        findings = self.findings
        table = findings._repr_html_() if findings.rows else ""
        return f"<pre>{html.escape(str(self))}</pre>{table}"

    def _table(self, key: str) -> Table:
        return Table.of_rows(self.document.get(key, []))


@dataclass(frozen=True, eq=False, repr=False)
class Compensation(Result):
    """Programs with fake targets."""

    refused: bool
    _files: dict[str, bytes] = field(repr=False)
    _read: tuple[Path, ...] = field(default=(), repr=False)

    @property
    def summary(self) -> dict[str, Any]:
        """The numbers of all targets together."""
        found: dict[str, Any] = self.document["summary"]
        return found

    @property
    def targets(self) -> Table:
        """What became of each target."""
        return self._table("targets")

    @property
    def files(self) -> dict[str, bytes]:
        """The rewritten programs by name. Raises `Refused` where nothing may be written."""
        if self.refused and not self._files:
            errors = [row for row in self.findings.iter_rows() if row["severity"] == "error"]
            first = f"{errors[0]['file']}:{errors[0]['line']}: {errors[0]['message']}" if errors else ""
            raise Refused(f"nothing is written: {len(errors)} errors, the first: {first}", errors)
        return dict(self._files)

    def write(self, folder: str | os.PathLike[str]) -> list[Path]:
        """Writes the files into a folder, all or none: into one next to it first, then each into its place.

        No file takes the place of one that was read.
        """
        files = self.files
        for name in files:
            place = Path(folder) / Path(name).name
            if place.exists() and any(read.exists() and place.samefile(read) for read in self._read):
                raise ValueError(f"{place} was read and would be written over: choose another folder")
        return write_all(files, Path(folder))


@dataclass(frozen=True, eq=False, repr=False)
class Check(Result):
    """Where the real robot goes with programs. `refused`: the answer is no."""

    refused: bool
    _junit: str = field(repr=False)

    @property
    def summary(self) -> dict[str, Any]:
        """The numbers of all moves together."""
        found: dict[str, Any] = self.document["summary"]
        return found

    @property
    def moves(self) -> Table:
        """What the real robot does on each move."""
        return self._table("moves")

    @property
    def baseline(self) -> dict[str, Any] | None:
        """What is worse, better and the same as in a stored run."""
        return self.document.get("baseline")

    def junit(self) -> str:
        """`JUnit` XML for a build server."""
        return self._junit


@dataclass(frozen=True, eq=False, repr=False)
class Calibration(Result):
    """What measurements say of a robot."""

    profile: Profile
    """The profile with it."""
    names: list[str]
    """(p,) the parameters that were identified."""
    covariance: NDArray[np.float64]
    """(p, p) of them, in SI units."""
    residuals_m: NDArray[np.float64]
    """(m, 3) measured minus expected of each row; of a distance the first number."""

    @property
    def parameters(self) -> Table:
        """Every parameter, identified or not."""
        return self._table("parameters")

    @property
    def outliers(self) -> Table:
        """Rows that do not fit the others."""
        return self._table("outliers")

    @property
    def quality(self) -> dict[str, Any]:
        """Errors before, with frames alone, and after."""
        keys = ("before", "frames_only", "after", "held_out", "observability", "expected_error_mm")
        return {key: self.document[key] for key in keys if key in self.document}


@dataclass(frozen=True, eq=False, repr=False)
class Validation(Result):
    """Errors of a profile's models on measurements."""

    @property
    def as_calibrated(self) -> dict[str, Any] | None:
        """Whether the arm errs as it did when it was calibrated, and what would have been seen, where that was asked."""
        return self.document.get("as_calibrated")


@dataclass(frozen=True, eq=False, repr=False)
class Diagnosis(Result):
    """What a profile lacks."""

    is_sure: bool
    """Whether the answer is sure enough to be written."""
    profile: Profile | None
    """The better profile; `None` where the answer is not sure."""
    poses_csv: str | None
    """Joint angles that would tell alternatives apart."""

    @property
    def verdict(self) -> str:
        """The answer in a word."""
        return str(self.document["verdict"])

    @property
    def effects(self) -> Table:
        """The effects that were found."""
        return self._table("effects")

    @property
    def drift(self) -> dict[str, Any] | None:
        """The errors run by run and their changes, where the tables are runs."""
        return self.document.get("drift")

    @property
    def alternatives(self) -> Table:
        """Effects that explain the data nearly as well."""
        return self._table("alternatives")


@dataclass(frozen=True, eq=False, repr=False)
class Plan(Result):
    """Configurations to measure."""

    q_rad: NDArray[np.float64]
    """(n, 6) the controller's joint angles."""
    csv: str
    """They as a table of joints."""
    program: str | None
    """A program that drives there."""


@dataclass(frozen=True)
class Fit:
    """The rigid motion between matched points."""

    to_from_from: NDArray[np.float64]
    """(4, 4)"""
    residuals_m: NDArray[np.float64]
    """(n, 3) measured minus mapped."""
    rmsd_m: float
    noise_m: float
    """Standard deviation of a coordinate, both sets together."""
    covariance: NDArray[np.float64]
    """(6, 6) of a small rotation and displacement about the centre of the second set: rad², rad·m, m²."""


@dataclass(frozen=True)
class HandEye:
    """Where a camera and a board are."""

    camera: NDArray[np.float64]
    """(4, 4) base_from_camera, or flange_from_camera of an eye in hand."""
    board: NDArray[np.float64]
    """(4, 4) flange_from_board, or base_from_board of an eye in hand."""
    by_method: dict[str, NDArray[np.float64] | None]
    residuals_m: NDArray[np.float64]
    """(n,)"""
    residuals_rad: NDArray[np.float64]
    """(n,)"""


@dataclass(frozen=True)
class SurfaceFit:
    """The rigid motion that lays one surface on another."""

    to_from_from: NDArray[np.float64]
    """(4, 4)"""
    rms_m: float
    """Of the pairs that are kept, in the metric."""
    expected_m: float
    """What the roughness of both explains."""
    overlap: float
    """Share of the first that lies on the second."""
    covariance: NDArray[np.float64] | None
    """(6, 6) as that of `Fit`."""
    concerns: list[str]
    """Why it is no success; none where it is."""


@dataclass(frozen=True, eq=False, repr=False)
class Hexapod(Result):
    """Poses of the tool in the frame of the base balls: one a row and assembly mode."""

    base_from_tool: NDArray[np.float64]
    """(n, 4, 4)"""
    tool_points_m: NDArray[np.float64]
    """(n, 3, 3) the balls T1, T2, T3."""

    @property
    def poses(self) -> Table:
        """They with their uncertainty."""
        return self._table("poses")


@dataclass(frozen=True, eq=False, repr=False)
class Axes(Result):
    """Frames from sweeps of single joints."""

    world_from_base: NDArray[np.float64] | None
    """(4, 4); of sweeps of joints 1 and 2."""
    flange_from_tool: NDArray[np.float64] | None
    """(4, 4); of sweeps of joints 5 and 6."""

    @property
    def joints(self) -> Table:
        """The joints that were swept."""
        return self._table("joints")


@dataclass(frozen=True, repr=False)
class Program:
    """What programs say; `document` has the names and units of the command's JSON."""

    document: dict[str, Any]

    def __repr__(self) -> str:
        return f"<Program {self.language}: {self.targets.rows} targets, {self.moves.rows} moves>"

    @property
    def language(self) -> str:
        """Which language they are in."""
        return str(self.document["language"])

    @property
    def targets(self) -> Table:
        """Targets: name, place, pose or joints, `spans` with first byte and length of each number."""
        return Table.of_rows(self.document["targets"])

    @property
    def moves(self) -> Table:
        """Moves to them: kind, tool, frame, speed, corner; `target` is the row in `targets`."""
        return Table.of_rows(self.document["moves"])

    @property
    def findings(self) -> Table:
        """What a person should look at."""
        return Table.of_rows(self.document["findings"])


@dataclass(frozen=True)
class Change:
    """A change of an error from run to run."""

    since: int
    """The first run with it, from 0."""
    noticed: int
    """The run in which it was noticed."""
    before: float
    """Geometric mean of the error before, back to the change before that."""
    after: float
    """And since, up to the next."""


def write_all(files: Mapping[str, bytes], folder: Path) -> list[Path]:
    """Files into a folder, by their last names: each is whole before any takes its place."""
    places = {folder / Path(name).name: data for name, data in files.items()}
    if len(places) < len(files):
        raise ValueError("two files have the same name: write them yourself, each into its own folder")
    folder.mkdir(parents=True, exist_ok=True)
    waiting: list[tuple[Path, Path]] = []
    try:
        for place, data in places.items():
            handle, name = tempfile.mkstemp(dir=folder, prefix=".poseshift-")
            waiting.append((Path(name), place))
            with os.fdopen(handle, "wb") as file:
                file.write(data)
                file.flush()
                os.fsync(file.fileno())
            Path(name).chmod(0o644)
        for temporary, place in waiting:
            temporary.replace(place)
    finally:
        for temporary, _ in waiting:
            temporary.unlink(missing_ok=True)
    return list(places)
