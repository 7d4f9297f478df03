"""The command line of poseshift."""

from __future__ import annotations

import signal
import sys

from poseshift._poseshift import main as run


def main() -> int:
    """Runs the command with the arguments of this process; its exit status."""
    # Ctrl-C and a reader that has gone end the command as they end any other
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return run(["poseshift", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
