"""Files and measurements as callers give them."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from poseshift import _poseshift

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["Files", "Measurements"]

_Path: TypeAlias = "str | os.PathLike[str]"
Files: TypeAlias = "Mapping[str, bytes] | _Path | Sequence[_Path]"


def read_files(files: Files) -> list[tuple[str, bytes]]:
    """Names and bytes of files, in their order."""
    if isinstance(files, Mapping):
        return [(str(name), bytes(data)) for name, data in files.items()]
    return [(os.fspath(path), Path(path).read_bytes()) for path in paths_of(files)]


def paths_of(files: _Path | Sequence[_Path]) -> Sequence[_Path]:
    """One path, or several."""
    return [files] if isinstance(files, str | os.PathLike) else files


def read_one(file: bytes | _Path, name: str) -> tuple[str, bytes]:
    """The name and the bytes of a file; `name` is that of bytes."""
    if isinstance(file, bytes | bytearray | memoryview):
        return name, bytes(file)
    return os.fspath(file), Path(file).read_bytes()


@dataclass(frozen=True)
class Measurements:
    """Tables of measurements: kept as they are, read with the profile that they are used with, as the command reads them."""

    files: tuple[tuple[str, bytes], ...]
    """Name and bytes of each table; two are joints and points where `joined`."""
    columns: str | None = None
    """Names of columns: `x=X,q1=J1`."""
    units: str | None = None
    """Units of these: `m,rad`."""
    euler: str | None = None
    """How angles turn the tool: `xyz`, `zyx`, `zyz`, `rotation-vector`."""
    driven_in_order: bool = False
    """Rows are in the order in which the robot drove to them: directions follow."""
    joined: bool = False

    @classmethod
    def from_csv(
        cls,
        *data: bytes | _Path,
        columns: str | None = None,
        units: str | None = None,
        euler: str | None = None,
        driven_in_order: bool = False,
    ) -> Measurements:
        """Tables in files or in bytes, one after another."""
        # each table has a name of its own: runs are told apart by it
        names = ["measurements.csv"] if len(data) == 1 else [f"measurements{number + 1}.csv" for number in range(len(data))]
        files = tuple(read_one(one, name) for one, name in zip(data, names, strict=True))
        return cls(files, columns, units, euler, driven_in_order)

    @classmethod
    def from_joints_and_points(cls, joints: bytes | _Path, points: bytes | _Path, **said: Any) -> Measurements:
        """What the device saw at the joint angles of another table: joined by `id`, else by order."""
        files = (read_one(joints, "joints.csv"), read_one(points, "points.csv"))
        return cls(files, joined=True, **said)

    @classmethod
    def from_table(cls, table: Mapping[str, ArrayLike] | Any, /, name: str = "measurements.csv", **said: Any) -> Measurements:
        """Columns with the names of files (`q1_deg`, `x_mm`), or whatever speaks Arrow; `columns` names others."""
        if not isinstance(table, Mapping):
            import pyarrow  # noqa: PLC0415

            table = pyarrow.table(table).to_pydict()
        lists = {key: list(column) for key, column in table.items()}  # type: ignore[arg-type]
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(lists)
        writer.writerows([_cell(value) for value in row] for row in zip(*lists.values(), strict=True))
        return cls(((name, text.getvalue().encode()),), **said)

    @classmethod
    def from_arrays(
        cls,
        q_rad: ArrayLike,
        *,
        position_m: ArrayLike | None = None,
        pose: ArrayLike | None = None,
        sigma_m: ArrayLike | None = None,
        direction: ArrayLike | None = None,
        tool: Sequence[str] | None = None,
        point: Sequence[str] | None = None,
    ) -> Measurements:
        """Joint angles (n, 6) with positions (n, 3) or poses (n, 4, 4) in the device's frame."""
        text = _poseshift.measurements_of_arrays(
            q_rad, position_m=position_m, pose=pose, sigma_m=sigma_m, direction=direction, tool=tool, point=point
        )
        return cls((("measurements.csv", text.encode()),))

    def named(self, name: str) -> Measurements:
        """The same single table, as reports call it."""
        ((_, data),) = self.files
        return replace(self, files=((name, data),))

    def to_csv(self) -> bytes:
        """The single table."""
        ((_, data),) = self.files
        return data

    @property
    def _tables(
        self,
    ) -> tuple[Sequence[tuple[str, bytes]], str | None, str | None, str | None, bool, bool]:
        return list(self.files), self.columns, self.units, self.euler, self.driven_in_order, self.joined


def _cell(value: Any) -> Any:
    # a number as the shortest text that is read back as it is
    return repr(float(value)) if hasattr(value, "dtype") and value.dtype.kind == "f" else value
