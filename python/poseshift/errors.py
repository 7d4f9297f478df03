"""What goes wrong: a message, the way out, and the place in a text that is to blame."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

__all__ = [
    "ArmError",
    "CheckError",
    "IdentifyError",
    "InternalError",
    "MeasurementError",
    "PoseshiftError",
    "ProfileError",
    "ProgramError",
    "Refused",
    "RegisterError",
]


class PoseshiftError(Exception):
    """What could not be done. `line` and `column` count from 1; `excerpt` is the line."""

    def __init__(
        self,
        message: str,
        hint: str = "",
        file: str | None = None,
        line: int | None = None,
        column: int | None = None,
        excerpt: str | None = None,
    ) -> None:
        super().__init__(message, hint, file, line, column, excerpt)
        self.message = message
        self.hint = hint
        self.file = file
        self.line = line
        self.column = column
        self.excerpt = excerpt

    def __str__(self) -> str:
        place = "" if self.file is None else f"{self.file}:{self.line}:{self.column}: "
        hint = f"\n{self.hint}" if self.hint else ""
        return f"{place}{self.message}{hint}"


class ProfileError(PoseshiftError):
    """A profile that cannot be read, or lacks what is asked of it."""


class ProgramError(PoseshiftError):
    """A program that cannot be read, or whose tools and frames are not known."""


class ArmError(PoseshiftError):
    """An arm without a closed-form inverse."""


class MeasurementError(PoseshiftError):
    """A table of measurements that cannot be read."""


class IdentifyError(PoseshiftError):
    """Measurements that contradict the robot or themselves, or say too little."""


class CheckError(PoseshiftError):
    """A program or a cell that cannot be checked."""


class RegisterError(PoseshiftError):
    """Points or poses that determine no motion."""


class InternalError(PoseshiftError):
    """A fault of poseshift itself: please report it."""


class Refused(PoseshiftError):
    """The answer is no, and files were asked for: `findings` says why."""

    def __init__(self, message: str, findings: Sequence[Mapping[str, Any]] = ()) -> None:
        super().__init__(message)
        self.args = (message, list(findings))
        self.findings = list(findings)
