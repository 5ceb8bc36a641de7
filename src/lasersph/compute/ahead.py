"""Known loops of a kind of run, compiled by other processes while the run begins.

A run asks for its loops one after the other, and compiles what the cache folder lacks. At the first
that is missing, a process for each further processor goes through a list of known loops and puts
them into the folder; a loop that one of them compiles is waited for (`compute.compile_lock`). Where
all are found, nothing is started. A list that is out of date costs time, and changes no result.

    python -m lasersph.compute.ahead FILE NAME PROCESS

compiles the list of that name in a file, while its parent is the process of that number.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import Self

from lasersph.compute import cache
from lasersph.compute.compile_lock import compiling_alone
from lasersph.compute.generate import Loop, LoopText
from lasersph.compute.loop_record import loop_of, record_of
from lasersph.compute.threads import available
from lasersph.compute.values import LoopSourceError

MOST_HELPERS = 7
"""More wait for each other: the loops of a run are some 150, and its first steps ask for them in
order."""
_ONE_STARTER = "0"
"""Name of the lock of the one process that may start others for a folder."""


class CompilingAhead:
    """Lets other processes compile known loops inside a `with` block, once one is missing.

    Args:
        file, name: the list of loops, see `write_lists`.

    Attributes:
        helpers: the processes, as far as they were started.
    """

    def __init__(self, file: Path, name: str) -> None:
        self._file, self._name = file, name
        self.helpers: list[subprocess.Popen[bytes]] = []
        self._held, self._forget = ExitStack(), (lambda: None)

    def __enter__(self) -> Self:
        """Wait for the first loop that is missing."""
        self._forget: Callable[[], None] = cache.at_first_miss(self._begin)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """End the processes: what is compiled stays."""
        self._forget()
        for helper in self.helpers:
            helper.terminate()
        for helper in self.helpers:
            helper.wait()
        self._held.close()

    def _begin(self) -> None:
        """Start a process for each further processor, unless another process has done so, or
        nothing is known."""
        # only where loops are known, and by one process for a folder
        if self._name not in places_of(self._file):
            return
        folder = cache.location()
        if not self._held.enter_context(compiling_alone(folder, _ONE_STARTER, waits=False)):
            return
        # processes that compile the list into the same folder, and end with this one
        silent = subprocess.DEVNULL
        environment = os.environ | {"LASERSPH_CACHE": str(folder)}
        command = [sys.executable, "-m", __name__, str(self._file), self._name, str(os.getpid())]
        for _ in range(min(available() - 1, MOST_HELPERS)):
            helper = subprocess.Popen(
                command, stdin=silent, stdout=silent, stderr=silent, env=environment
            )
            self.helpers.append(helper)


def write_lists(file: Path, lists: dict[str, list[Loop]]) -> None:
    """Write lists of loops by name, each loop once, one a line.

    Raises:
        ValueError: a loop that has no record. OSError: the file cannot be written.
    """
    # each loop once, and lists of its places
    lines: dict[str, int] = {}
    places = {
        name: [lines.setdefault(json.dumps(record_of(loop)), len(lines)) for loop in loops]
        for name, loops in lists.items()
    }
    file.write_text("\n".join([json.dumps(places), *lines, ""]), encoding="utf-8")


def places_of(file: Path) -> dict[str, list[int]]:
    """Places of the loops of each list in its file; nothing where there is no file.

    Raises OSError where the file cannot be read.
    """
    if not file.is_file():
        return {}
    with file.open(encoding="utf-8") as lines:
        return json.loads(next(lines))


def read_lists(file: Path) -> dict[str, list[Loop]]:
    """Loops by list, but those that are gone since; nothing where there is no file.

    Raises OSError where the file cannot be read.
    """
    if not (places := places_of(file)):
        return {}
    loops = [_known(line) for line in file.read_text(encoding="utf-8").splitlines()[1:]]
    return {
        name: [loop for place in chosen if (loop := loops[place]) is not None]
        for name, chosen in places.items()
    }


def _known(line: str) -> Loop | None:
    """The loop of a line; None where it was renamed since, and is compiled when it is called."""
    try:
        return loop_of(json.loads(line))
    except (AttributeError, ImportError, TypeError):
        return None


def compile_list(file: Path, name: str, parent: int | None = None) -> None:
    """Compile a list until all of it is in the folder, or the process that asked for it is gone.

    Args:
        parent: number of that process, if it is another.
    """
    for loop in read_lists(file).get(name, ()):
        # nobody waits for the rest once the process that asked for it is gone
        if parent not in (None, os.getppid()):
            return
        try:
            cache.compile_ahead(LoopText(loop).written())
        except LoopSourceError:
            continue  # its function takes other arguments now


if __name__ == "__main__":
    compile_list(Path(sys.argv[1]), sys.argv[2], int(sys.argv[3]))
