"""What tests start ends with them, also where they are ended by Ctrl-C, SIGTERM or SIGKILL.

Every process below the tests inherits a variable of the environment with the name of their folder.
A process in a session of its own waits until who started it is gone, kills whatever still has that
variable, and removes the folder. It needs /proc, as Linux has it.

python process_watch.py FOLDER PROCESS: watches the process of that number.
"""

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

MARK = "LASERSPH_TESTS"
PROC = Path("/proc")
POLL = 0.1
"""Seconds between two looks at processes."""


def watch(folder: Path) -> None:
    """Mark what this process starts from now on, and let it end with this process."""
    environment = dict(os.environ)
    os.environ[MARK] = str(folder)
    if PROC.joinpath("self", "environ").exists():
        subprocess.Popen(
            [sys.executable, __file__, str(folder), str(os.getpid())], env=environment,
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            start_new_session=True,
        )  # fmt: skip


def processes_with(variable: str, value: str) -> list[int]:
    """Numbers of the processes that were started with this value of an environment variable."""
    wanted, found = f"{variable}={value}".encode(), []
    for path in PROC.glob("[0-9]*/environ"):
        try:
            content = path.read_bytes()
        except OSError:  # of another user, or ended meanwhile
            continue
        if wanted in content.split(b"\0"):
            found.append(int(path.parent.name))
    return found


def kill_all(folder: Path) -> None:
    """Kill every process with the mark of a folder; what they start meanwhile, too."""
    while left := processes_with(MARK, str(folder)):
        for number in left:
            try:
                os.kill(number, signal.SIGKILL)
            except ProcessLookupError:
                continue
        time.sleep(POLL)


def main(folder: Path, parent: int) -> None:
    """Wait for the end of the parent, then leave no process and no file."""
    while os.getppid() == parent:
        time.sleep(POLL)
    kill_all(folder)
    shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]))
