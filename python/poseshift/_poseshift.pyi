"""The library: see `poseshift` for what callers use. Shapes in brackets; metres and radians."""

from collections.abc import Sequence
from os import PathLike
from typing import Any, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = [
    "Arm",
    "Document",
    "Postures",
    "Problem",
    "Profile",
    "Solutions",
    "__version__",
    "axes",
    "calibrate",
    "changes",
    "check",
    "compensate",
    "diagnose",
    "hand_eye",
    "hexapod",
    "icp",
    "main",
    "measurements_of_arrays",
    "plan",
    "read_program",
    "register",
    "set_threads",
    "simulate",
    "validate",
]

__version__: str

_Files = Sequence[tuple[str, bytes]]
_Tables = tuple[_Files, str | None, str | None, str | None, bool, bool]
_Named = Sequence[tuple[str | None, str | ArrayLike]]
_Floats = NDArray[np.float64]

@final
class Arm:
    def forward(self, q_rad: ArrayLike) -> _Floats:
        """(n, 6) -> (n, 4, 4)"""
    def solve(self, world_from_tool: ArrayLike, *, branch: ArrayLike | None = None, near_rad: ArrayLike | None = None) -> Solutions: ...
    def solve_all(self, world_from_tool: ArrayLike) -> Solutions: ...
    def posture(self, q_rad: ArrayLike) -> Postures: ...

@final
class Solutions:
    @property
    def q_rad(self) -> _Floats: ...
    @property
    def status(self) -> NDArray[np.uint8]: ...
    @property
    def joint(self) -> NDArray[np.int8]: ...
    @property
    def converged(self) -> NDArray[np.bool_]: ...
    @property
    def branch(self) -> NDArray[np.uint8]: ...
    @property
    def residual_m(self) -> _Floats: ...
    @property
    def residual_rad(self) -> _Floats: ...
    @property
    def iterations(self) -> NDArray[np.uint32]: ...

@final
class Postures:
    @property
    def branch(self) -> NDArray[np.uint8]: ...
    @property
    def wrist_rad(self) -> _Floats: ...
    @property
    def elbow_rad(self) -> _Floats: ...
    @property
    def shoulder_m(self) -> _Floats: ...

@final
class Profile:
    @staticmethod
    def from_yaml(text: str, name: str = "profile.yaml") -> Profile: ...
    @staticmethod
    def load(path: str | PathLike[str]) -> Profile: ...
    @staticmethod
    def shipped(name: str) -> Profile: ...
    @staticmethod
    def names() -> list[str]: ...
    @property
    def name(self) -> str: ...
    @property
    def manufacturer(self) -> str: ...
    @property
    def model(self) -> str: ...
    @property
    def serial(self) -> str | None: ...
    @property
    def language(self) -> str | None: ...
    @property
    def sha256(self) -> str: ...
    @property
    def tools(self) -> list[str]: ...
    @property
    def limits_rad(self) -> _Floats: ...
    def effects(self) -> list[tuple[str, str, float, str]]: ...
    def to_yaml(self) -> str: ...
    def diff_json(self, other: Profile) -> str: ...
    def arm(
        self,
        tool: str | None = None,
        *,
        model: str = "real",
        direction: ArrayLike | None = None,
        force_n: ArrayLike | None = None,
        temperature_c: float | None = None,
        time_s: float | None = None,
    ) -> Arm: ...
    def __reduce__(self) -> Any: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...

@final
class Document:
    def json(self) -> str: ...
    def words(self) -> str: ...
    def html(self, made: str) -> str | None: ...

@final
class Problem:
    def __new__(cls, profile: Profile, tables: _Tables, *, level: str = "compliance", identify: str = "", fix: str = "") -> Problem: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def x0(self) -> _Floats: ...
    @property
    def x(self) -> _Floats: ...
    def residuals(self, x: ArrayLike) -> _Floats:
        """(p,) -> (m,)"""
    def jacobian(self, x: ArrayLike) -> _Floats:
        """(p,) -> (m, p)"""

def compensate(
    files: _Files,
    context: _Files,
    profile: Profile,
    *,
    tools: _Named,
    frames: _Named,
    work_offset: ArrayLike | None = None,
    joint_targets: str = "keep",
    decimals: int | None = None,
    max_path_error_mm: float | None = None,
    max_derived_error_mm: float | None = None,
    max_shift: tuple[float, float] | None = None,
    language: str | None = None,
    force: bool = False,
    accept: Sequence[str] = ...,
    split_targets: bool = False,
    at_singularity: str = "refuse",
    method: str = "auto",
    start_joints_rad: ArrayLike | None = None,
    despite_errors: str = "nothing",
) -> tuple[Document, bool, list[tuple[str, bytes]]]: ...
def check(
    files: _Files,
    context: _Files,
    profile: Profile,
    *,
    nominal: _Files | None = None,
    cell: tuple[str, bytes] | None = None,
    baseline: tuple[str, str] | None = None,
    tolerance: float = 0.0005,
    max_path_error_mm: float | None = None,
    orientation: str = "slerp",
    horizon_mm: float = 100.0,
    limit_margin_deg: float = 1.0,
    tools: _Named,
    frames: _Named,
    accept: Sequence[str] = ...,
    start_joints_rad: ArrayLike | None = None,
    language: str | None = None,
    force: bool = False,
) -> tuple[Document, bool, str]: ...
def calibrate(
    profile: Profile,
    tables: _Tables,
    *,
    level: str = "compliance",
    identify: str = "",
    fix: str = "",
    priors: bool = False,
    loss: str = "huber",
    base: str = "controller",
    date: str | None = None,
) -> tuple[Document, str, list[str], _Floats, _Floats]: ...
def validate(
    profile: Profile,
    tables: _Tables,
    *,
    refit_frames: bool = False,
    folds: int | None = None,
    level: str | None = None,
    priors: bool = False,
    all_sets: bool = False,
    as_calibrated: bool = False,
) -> Document: ...
def changes(errors: ArrayLike) -> list[tuple[int, int, float, float]]: ...
def read_program(files: _Files, context: _Files, profile: Profile | None, *, language: str | None = None) -> str: ...
def diagnose(
    profile: Profile,
    tables: _Tables,
    *,
    accept: str = "",
    reject: str = "",
    quick: bool = False,
    steps: bool = False,
    runs: bool = False,
) -> tuple[Document, bool, str | None, str | None]: ...
def plan(
    profile: Profile,
    count: int,
    *,
    tool: str | None = None,
    level: str = "compliance",
    identify: str = "",
    fix: str = "",
    candidates: int = 5000,
    starts: int = 4,
    seed: int = 1,
    sigma_m: float = ...,
    poses: bool = False,
    given_rad: ArrayLike | None = None,
    margin_rad: float = ...,
    approach_rad: float = ...,
    inside_m: ArrayLike | None = None,
    keep_out_m: Sequence[ArrayLike] = ...,
    device_m: Sequence[float] | None = None,
    cone_rad: float = ...,
    program: str | None = None,
    language: str | None = None,
) -> tuple[Document, _Floats, str, str | None]: ...
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
    temperature_c: Sequence[float] | None = None,
    interval_s: float | None = None,
    direction: ArrayLike | None = None,
    force_n: ArrayLike | None = None,
) -> str: ...
def measurements_of_arrays(
    q_rad: ArrayLike,
    *,
    position_m: ArrayLike | None = None,
    pose: ArrayLike | None = None,
    sigma_m: ArrayLike | None = None,
    direction: ArrayLike | None = None,
    tool: Sequence[str] | None = None,
    point: Sequence[str] | None = None,
) -> str: ...
def register(
    from_m: ArrayLike, to_m: ArrayLike, weights: ArrayLike | None = None
) -> tuple[_Floats, _Floats, float, float, _Floats]: ...
def hand_eye(
    robot: ArrayLike, board: ArrayLike, *, setup: str
) -> tuple[_Floats, _Floats, list[tuple[str, _Floats | None]], _Floats, _Floats]: ...
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
) -> tuple[_Floats, float, float, float, _Floats | None, list[str]]: ...
def hexapod(lengths: tuple[str, bytes], *, sigma_m: float = ...) -> tuple[Document, _Floats, _Floats]: ...
def axes(profile: Profile, sweeps: tuple[str, bytes], *, point: str | None = None) -> tuple[Document, _Floats | None, _Floats | None]: ...
def main(arguments: Sequence[str]) -> int: ...
def set_threads(count: int | None = None) -> None: ...
