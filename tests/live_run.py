"""A made-up run that a process of its own computes as slowly as a test wants.

python live_run.py FOLDER: writes a third of the run, waits for a line on standard input, writes the
rest and completes it.
"""

import sys
from pathlib import Path

from synthetic_run import make_run, times

HALT = len(times()) // 3


def wait_for_the_test(run, step):
    """Bring all rows into the file, and wait at the halt."""
    if step == HALT:
        run.history.flush()
        print("waiting", flush=True)
        sys.stdin.readline()


if __name__ == "__main__":
    make_run(Path(sys.argv[1]), after_step=wait_for_the_test)
