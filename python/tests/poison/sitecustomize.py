"""Ends the process that works on a robot: workers find it by PYTHONPATH.

In the folder `POISON` a file with the name of a robot ends each of them, one with `.once` behind it the first.
"""

import os
import signal
from pathlib import Path

_chdir = os.chdir


def _poisoned(folder: str) -> None:
    poison = Path(os.environ["POISON"]) / Path(folder).name
    once = poison.with_name(f"{poison.name}.once")
    if once.exists():
        once.unlink()
        os.kill(os.getpid(), signal.SIGKILL)
    if poison.exists():
        os.kill(os.getpid(), signal.SIGKILL)
    _chdir(folder)


if "POISON" in os.environ:
    os.chdir = _poisoned  # type: ignore[assignment]
