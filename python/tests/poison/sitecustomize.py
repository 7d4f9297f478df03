"""Ends the process that works on one robot: workers find it by PYTHONPATH."""

import os
import sys


class _Poison:
    """Ends the process when it changes into the folder of the robot `POISONED`."""

    def __init__(self) -> None:
        self._chdir = os.chdir

    def __call__(self, folder: object) -> None:
        if os.path.basename(str(folder)) == os.environ.get("POISONED"):
            os.kill(os.getpid(), 9)
        self._chdir(folder)  # type: ignore[arg-type]


if "POISONED" in os.environ and sys.platform != "win32":
    os.chdir = _Poison()
