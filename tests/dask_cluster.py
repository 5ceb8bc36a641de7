"""A Dask scheduler and workers on this machine, to be killed."""

import subprocess
import sys
from pathlib import Path

from reliability_runs import LONGEST_WAIT, wait_until

COMMON = ("--no-dashboard", "--host", "127.0.0.1")


class DaskCluster:
    """A scheduler, found by its file, and workers of one thread under a nanny each.

    Attributes:
        file: that says where the scheduler is.
    """

    def __init__(self, folder: Path, workers: int, options: tuple[str, ...] = ()) -> None:
        self.folder, self.workers, self.options = folder, workers, options
        self.file = folder / "scheduler.json"
        self._started: list[subprocess.Popen] = []
        self.start_scheduler()
        self.start_workers()

    def start_scheduler(self) -> None:
        """Start a scheduler; it writes its address into the file."""
        self.file.unlink(missing_ok=True)
        self.scheduler = self._start("scheduler", "--port", "0")
        wait_until(self.scheduler, self.has_address)

    def has_address(self) -> bool:
        """Whether the scheduler has written its file whole: it makes an empty one first."""
        return self.file.exists() and self.file.read_text().rstrip().endswith("}")

    def start_workers(self) -> None:
        """Start as many workers as there should be; those that lost their nanny are gone."""
        living = [process for process in self._started if process.poll() is None]
        for _ in range(self.workers - (len(living) - 1)):
            self._start(
                *("worker", "--nthreads", "1", "--memory-limit", "0", "--death-timeout", "300"),
                *("--local-directory", str(self.folder / "space")),
            )

    def kill_scheduler(self) -> None:
        """Kill the scheduler; its workers end by themselves."""
        self.scheduler.kill()
        for process in self._started:
            process.wait(timeout=LONGEST_WAIT)

    def close(self) -> None:
        """End everything."""
        for process in self._started:
            process.kill()
            process.wait(timeout=LONGEST_WAIT)

    def _start(self, kind: str, *options: str) -> subprocess.Popen:
        with open(self.folder / f"{kind}-{len(self._started)}.log", "w") as log:
            process = subprocess.Popen(
                [
                    *(sys.executable, "-m", f"distributed.cli.dask_{kind}"),
                    *("--scheduler-file", str(self.file), *COMMON, *self.options, *options),
                ],
                stdout=log,
                stderr=log,
            )
        self._started.append(process)
        return process
