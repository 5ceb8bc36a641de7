"""Processes that draw pictures of a run beside this one, where processors are free.

Each loads what figures need as it starts, so that those that begin before a run ends draw at once.
A picture that one of them fails to draw is drawn here: what is wrong with it is met as without
them. They end with this process, however that ends, since then their standard input closes
(`drawing_child`).
"""

from __future__ import annotations

import json
import subprocess
import sys
import threading
from collections import deque
from collections.abc import Callable, Sequence
from pathlib import Path
from types import TracebackType
from typing import NamedTuple, Self

MOST_PROCESSES = 4
"""More than four, this one among them, wait for the one that draws the animation."""
CHILD = "lasersph.plots.drawing_child"


class Picture(NamedTuple):
    """A figure or the animation of a run: its folder, name, and the kind of its file."""

    folder: str
    name: str
    kind: str


Draw = Callable[[Picture], Path | None]
"""Draws a picture here; its file, None where the run has nothing of what it shows."""


class DrawingProcesses:
    """Draws pictures in several processes inside a `with` block, at whose end the others end.

    Args:
        processors: that may be busy at a time. say: called with a line where a process failed.

    Attributes:
        started: the other processes, as far as they were started.
    """

    def __init__(self, processors: int, say: Callable[[str], None]) -> None:
        self._count, self._say = min(processors, MOST_PROCESSES) - 1, say
        self.started: list[subprocess.Popen[str]] = []

    def __enter__(self) -> Self:
        """No other process is there before `begin`."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """End them, whatever they do."""
        for process in self.started:
            process.kill()
        for process in self.started:
            process.communicate()

    def begin(self) -> None:
        """Start them, unless that was done."""
        while len(self.started) < self._count:
            process = subprocess.Popen(
                # -P: a file of the user's in this folder must not hide a library
                [sys.executable, "-P", "-m", CHILD],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                text=True,
                encoding="utf-8",
            )
            self.started.append(process)

    def draw(self, pictures: Sequence[Picture], draw: Draw) -> dict[Picture, Path | None]:
        """Draw all pictures, here by `draw` and in what `begin` has started.

        Returns:
            The file of each; None where a run has nothing of what it shows.
        """
        waiting, files = deque(pictures), {}
        failures: list[str] = []
        hands = [
            threading.Thread(target=hand_on, args=(one, waiting, files, failures), daemon=True)
            for one in self.started
        ]
        for hand in hands:
            hand.start()
        # What another process failed to draw waits again when its thread has ended.
        draw_waiting(waiting, files, draw)
        for hand in hands:
            hand.join()
        draw_waiting(waiting, files, draw)
        for text in failures:
            self._say(f"a process that drew figures failed ({text}); its figures were drawn anew")
        return files


def draw_waiting(waiting: deque[Picture], files: dict[Picture, Path | None], draw: Draw) -> None:
    """Draw the pictures that wait, until none does."""
    while (picture := next_of(waiting)) is not None:
        files[picture] = draw(picture)


def hand_on(
    process: subprocess.Popen[str],
    waiting: deque[Picture],
    files: dict[Picture, Path | None],
    failures: list[str],
) -> None:
    """Let a process draw what waits; where it fails, its picture waits again."""
    while (picture := next_of(waiting)) is not None:
        file, failure = answer_of(process, picture)
        if failure:
            failures.append(failure)
            waiting.appendleft(picture)
            return
        files[picture] = file


def next_of(waiting: deque[Picture]) -> Picture | None:
    """The next picture that waits; None where none does, as another thread may have taken it."""
    try:
        return waiting.popleft()
    except IndexError:
        return None


def answer_of(process: subprocess.Popen[str], picture: Picture) -> tuple[Path | None, str]:
    """File of a picture that a process draws, if any, and why it failed, empty if it did not."""
    assert process.stdin is not None and process.stdout is not None
    try:
        process.stdin.write(json.dumps(picture) + "\n")
        process.stdin.flush()
        answer = json.loads(process.stdout.readline())
    except (OSError, ValueError):  # it has ended, with no answer or half of one
        process.kill()
        return None, f"exit code {process.wait()}"
    return (None if answer["file"] is None else Path(answer["file"])), answer["failure"]
