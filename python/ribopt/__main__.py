"""The command line: ``python -m ribopt``, and ``ribopt`` where the wheel is installed."""

from __future__ import annotations

import signal
import sys

from . import _native


def main() -> None:
    """Runs the command line and ends the process with its exit code."""
    # The command line has a handler of its own, which ends the process or the run.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.stdout.flush()
    sys.exit(_native.main(["ribopt", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
