"""Makes an offline-programmed robot path land where the simulation wanted it.

Arrays are metres, radians and 4 x 4 matrices `a_from_b`. Tables, documents and options that the command has too keep their
names and units. What is computed is computed by the library that the command `poseshift` uses.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from poseshift import _poseshift
from poseshift._poseshift import Arm, Postures, Profile, Solutions, __version__, set_threads
from poseshift.errors import (
    ArmError,
    CheckError,
    IdentifyError,
    InternalError,
    MeasurementError,
    PoseshiftError,
    ProfileError,
    ProgramError,
    Refused,
    RegisterError,
)
from poseshift.inputs import Files, Measurements, paths_of, read_files, read_one
from poseshift.results import (
    Axes,
    Calibration,
    Change,
    Check,
    Compensation,
    Diagnosis,
    Fit,
    HandEye,
    Hexapod,
    Plan,
    Program,
    Result,
    Status,
    SurfaceFit,
    Validation,
)
from poseshift.table import Table

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = [
    "Arm",
    "ArmError",
    "Axes",
    "Calibration",
    "Change",
    "Check",
    "CheckError",
    "Compensation",
    "Diagnosis",
    "Fit",
    "HandEye",
    "Hexapod",
    "IdentifyError",
    "InternalError",
    "MeasurementError",
    "Measurements",
    "Plan",
    "PoseshiftError",
    "Postures",
    "Problem",
    "Profile",
    "ProfileError",
    "Program",
    "ProgramError",
    "Refused",
    "RegisterError",
    "Result",
    "Solutions",
    "Status",
    "SurfaceFit",
    "Table",
    "Validation",
    "__version__",
    "axes",
    "calibrate",
    "changes",
    "check",
    "compensate",
    "diagnose",
    "diff",
    "effects",
    "hand_eye",
    "hexapod",
    "icp",
    "plan",
    "read_program",
    "register",
    "set_threads",
    "simulate",
    "validate",
]

_Tool: TypeAlias = "str | ArrayLike"


def effects(profile: Profile) -> Table:
    """The effects of a profile: a row a number, in the unit of files."""
    rows = profile.effects()
    names = ("effect", "parameter", "value", "unit")
    return Table({name: [row[index] for row in rows] for index, name in enumerate(names)})


def diff(a: Profile, b: Profile) -> Table:
    """How two profiles differ."""
    return Table.of_rows(json.loads(a.diff_json(b))["differences"], ("key", "a", "b"))


def _shift(max_shift: Sequence[float]) -> tuple[float, float]:
    if len(max_shift) != 2:  # noqa: PLR2004
        raise ValueError("max_shift must be two numbers: mm and degrees")
    return max_shift[0], max_shift[1]


def compensate(
    files: Files,
    profile: Profile,
    *,
    context: Files = (),
    tool: _Tool | None = None,
    tools: Mapping[str, _Tool] | None = None,
    frame: ArrayLike | None = None,
    frames: Mapping[str, ArrayLike] | None = None,
    work_offset: ArrayLike | None = None,
    joint_targets: str = "keep",
    decimals: int | None = None,
    max_path_error_mm: float | None = None,
    max_derived_error_mm: float | None = None,
    max_shift: Sequence[float] | None = None,
    language: str | None = None,
    force: bool = False,
    accept: Sequence[str] = (),
    split_targets: bool = False,
    at_singularity: str = "refuse",
    method: str = "auto",
    start_joints_rad: ArrayLike | None = None,
    despite_errors: str = "nothing",
) -> Compensation:
    """Programs with fake targets, with which the real tool arrives where the simulation wanted it.

    `files` are programs that belong together: names and bytes, or paths. `tool` and `frame` are for names that the files do
    not tell, `tools` and `frames` for these names: a tool of the profile, or flange_from_tool and world_from_frame (4, 4).
    `context` is read for declarations only. `despite_errors` is `nothing`, `good` (`--write-good`) or `all` (`--keep-going`).
    """
    document, refused, made = _poseshift.compensate(
        read_files(files),
        read_files(context),
        profile,
        tools=_named(tool, tools),
        frames=_named(frame, frames),
        work_offset=work_offset,
        joint_targets=joint_targets,
        decimals=decimals,
        max_path_error_mm=max_path_error_mm,
        max_derived_error_mm=max_derived_error_mm,
        max_shift=None if max_shift is None else _shift(max_shift),
        language=language,
        force=force,
        accept=list(accept),
        split_targets=split_targets,
        at_singularity=at_singularity,
        method=method,
        start_joints_rad=start_joints_rad,
        despite_errors=despite_errors,
    )
    read = () if isinstance(files, Mapping) else tuple(Path(path).resolve() for path in paths_of(files))
    return Compensation(document, refused, dict(made), read)


def check(
    files: Files,
    profile: Profile,
    *,
    nominal: Files | None = None,
    cell: bytes | str | os.PathLike[str] | None = None,
    baseline: str | os.PathLike[str] | Check | None = None,
    tolerance: float = 0.0005,
    max_path_error_mm: float | None = None,
    orientation: str = "slerp",
    horizon_mm: float = 100.0,
    limit_margin_deg: float = 1.0,
    context: Files = (),
    tool: _Tool | None = None,
    tools: Mapping[str, _Tool] | None = None,
    frame: ArrayLike | None = None,
    frames: Mapping[str, ArrayLike] | None = None,
    accept: Sequence[str] = (),
    start_joints_rad: ArrayLike | None = None,
    language: str | None = None,
    force: bool = False,
) -> Check:
    """Where the real robot goes with programs as they are: accuracy along the path, limits, collisions.

    `nominal` is what they were made from, `cell` what stands around the robot, `baseline` a stored run (a file of its JSON, or
    another result). Meshes that profile or cell name are read from where these are.
    """
    stored: tuple[str, str] | None = None
    if isinstance(baseline, Check):
        stored = ("baseline", baseline.json())
    elif baseline is not None:
        stored = (os.fspath(baseline), Path(baseline).read_text(encoding="utf-8"))
    document, refused, junit = _poseshift.check(
        read_files(files),
        read_files(context),
        profile,
        nominal=None if nominal is None else read_files(nominal),
        cell=None if cell is None else read_one(cell, "cell.yaml"),
        baseline=stored,
        tolerance=tolerance,
        max_path_error_mm=max_path_error_mm,
        orientation=orientation,
        horizon_mm=horizon_mm,
        limit_margin_deg=limit_margin_deg,
        tools=_named(tool, tools),
        frames=_named(frame, frames),
        accept=list(accept),
        start_joints_rad=start_joints_rad,
        language=language,
        force=force,
    )
    return Check(document, refused, junit)


def read_program(
    files: Files, profile: Profile | None = None, *, context: Files = (), language: str | None = None
) -> Program:
    """What programs say: their targets with the bytes where the numbers stand, and their moves.

    A profile knows what programs do not: pulses of a degree, what external axes carry.
    """
    return Program(json.loads(_poseshift.read_program(read_files(files), read_files(context), profile, language=language)))


def calibrate(
    profile: Profile,
    measurements: Measurements,
    *,
    level: str = "compliance",
    identify: str = "",
    fix: str = "",
    priors: bool = False,
    loss: str = "huber",
    base: str = "controller",
    date: str | None = None,
) -> Calibration:
    """Identifies a robot's effects from measurements.

    `level` is `frames`, `joints`, `geometry` or `compliance`; `identify` and `fix` are lists as on the command line.
    """
    document, text, names, covariance, residuals = _poseshift.calibrate(
        profile,
        measurements._tables,
        level=level,
        identify=identify,
        fix=fix,
        priors=priors,
        loss=loss,
        base=base,
        date=date,
    )
    calibrated = Profile.from_yaml(text, "calibrated.yaml")
    return Calibration(document, calibrated, names, covariance, residuals)


def validate(
    profile: Profile,
    measurements: Measurements,
    *,
    refit_frames: bool = False,
    folds: int | None = None,
    level: str | None = None,
    priors: bool = False,
    all_sets: bool = False,
    as_calibrated: bool = False,
) -> Validation:
    """Errors of a profile's models on measurements that it has not seen. `level` and `priors` are of the `folds`.

    `as_calibrated` says whether the arm errs as it did when it was calibrated, and what would have been seen: ten poses are
    enough.
    """
    document = _poseshift.validate(
        profile,
        measurements._tables,
        refit_frames=refit_frames,
        folds=folds,
        level=level,
        priors=priors,
        all_sets=all_sets,
        as_calibrated=as_calibrated,
    )
    return Validation(document)


def diagnose(
    profile: Profile,
    measurements: Measurements,
    *,
    accept: Sequence[str] = (),
    reject: Sequence[str] = (),
    quick: bool = False,
    steps: bool = False,
    runs: bool = False,
) -> Diagnosis:
    """Names the effects that a profile lacks. `steps` has the page show the way there.

    With `runs` the tables are runs, the oldest first: `drift` says since which the arm errs otherwise, and the rows since are
    diagnosed.
    """
    document, is_sure, text, poses = _poseshift.diagnose(
        profile, measurements._tables, accept=",".join(accept), reject=",".join(reject), quick=quick, steps=steps, runs=runs
    )
    better = None if text is None else Profile.from_yaml(text, "better.yaml")
    return Diagnosis(document, is_sure, better, poses)


def changes(errors: ArrayLike) -> list[Change]:
    """Since which run an error (n,) is another one, by a change-point test; the oldest change first."""
    return [Change(*found) for found in _poseshift.changes(errors)]


def plan(profile: Profile, count: int, **options: Any) -> Plan:
    """Chooses configurations to measure by observability.

    Options, with lengths in metres and angles in radians: `tool`, `level`, `identify`, `fix`, `candidates`, `starts`, `seed`,
    `sigma_m`, `poses`, `given_rad`, `margin_rad`, `approach_rad`, `inside_m`, `keep_out_m`, `device_m`, `cone_rad`, and for a
    program that drives there its name `program` and its `language`.
    """
    document, q_rad, csv, program = _poseshift.plan(profile, count, **options)
    return Plan(document, q_rad, csv, program)


def simulate(
    profile: Profile,
    q_rad: ArrayLike,
    *,
    tool: str | None = None,
    kind: str = "position",
    noise_m: float = 0.0,
    noise_rad: float = 0.0,
    seed: int = 1,
    from_m: ArrayLike | None = None,
    outliers: float = 0.0,
    outlier_m: float = 0.01,
    temperature_c: tuple[float, float] | None = None,
    interval_s: float | None = None,
    direction: ArrayLike | None = None,
    force_n: ArrayLike | None = None,
) -> Measurements:
    """Measurements of the robot that a profile describes, at joint angles (n, 6)."""
    text = _poseshift.simulate(
        profile,
        q_rad,
        tool=tool,
        kind=kind,
        noise_m=noise_m,
        noise_rad=noise_rad,
        seed=seed,
        from_m=from_m,
        outliers=outliers,
        outlier_m=outlier_m,
        temperature_c=temperature_c,
        interval_s=interval_s,
        direction=direction,
        force_n=force_n,
    )
    return Measurements((("measurements.csv", text.encode()),))


def register(from_m: ArrayLike, to_m: ArrayLike, weights: ArrayLike | None = None) -> Fit:
    """The rigid motion that maps points (n, 3) onto others."""
    return Fit(*_poseshift.register(from_m, to_m, weights))


def hand_eye(robot: ArrayLike, board: ArrayLike, *, setup: str) -> HandEye:
    """Where a camera is: `robot` are base_from_flange and `board` camera_from_board, (n, 4, 4).

    `setup` is `eye-to-hand` or `eye-in-hand`.
    """
    camera, of_board, by_method, metres, radians = _poseshift.hand_eye(robot, board, setup=setup)
    return HandEye(camera, of_board, dict(by_method), metres, radians)


def icp(
    from_m: ArrayLike,
    to_m: ArrayLike,
    *,
    normals: ArrayLike | None = None,
    metric: str = "plane",
    start: ArrayLike | None = None,
    keep: float = 0.9,
    min_overlap: float = 0.6,
    sigma_m: float | None = None,
) -> SurfaceFit:
    """The rigid motion that lays points (n, 3) of a surface on others (m, 3): which belongs to which is not known.

    `normals` (m, 3) are those of the second surface, where they are known; `metric` is `plane` or `point`; `start` is
    to_from_from (4, 4).
    """
    found = _poseshift.icp(
        from_m, to_m, normals=normals, metric=metric, start=start, keep=keep, min_overlap=min_overlap, sigma_m=sigma_m
    )
    return SurfaceFit(*found)


def hexapod(lengths: bytes | str | os.PathLike[str], *, sigma_m: float = 1e-6) -> Hexapod:
    """Tool poses from the lengths of a ballbar hexapod: a table as the command reads it. `sigma_m` is that of a length."""
    return Hexapod(*_poseshift.hexapod(read_one(lengths, "lengths.csv"), sigma_m=sigma_m))


def axes(profile: Profile, sweeps: bytes | str | os.PathLike[str], *, point: str | None = None) -> Axes:
    """Frames from sweeps of single joints: a table as the command reads it. `point` names the rows that count."""
    return Axes(*_poseshift.axes(profile, read_one(sweeps, "sweeps.csv"), point=point))


class Problem:
    """An identification as a function, for solvers from elsewhere.

    `scipy.optimize.least_squares(p.residuals, p.x0, p.jacobian)` finds what `calibrate` with `loss="squares"` finds.
    """

    def __init__(
        self,
        profile: Profile,
        measurements: Measurements,
        *,
        level: str = "compliance",
        identify: str = "",
        fix: str = "",
    ) -> None:
        self._problem = _poseshift.Problem(profile, measurements._tables, level=level, identify=identify, fix=fix)
        self.names = self._problem.names
        """The parameters."""
        self.x0 = self._problem.x0
        """(p,) the profile's values; frames, tools and points as `calibrate` finds them."""
        self.x = self._problem.x
        """(p,) what `calibrate` finds."""
        self.residuals = self._problem.residuals
        """(p,) -> (m,): measured minus expected, in standard deviations."""
        self.jacobian = self._problem.jacobian
        """(p,) -> (m, p)."""


def _named(default: Any, named: Mapping[str, Any] | None) -> list[tuple[str | None, Any]]:
    given: list[tuple[str | None, Any]] = [] if default is None else [(None, default)]
    return given + list((named or {}).items())
