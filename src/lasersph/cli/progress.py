"""How far a run is: one line that is drawn again on a terminal, ten lines elsewhere."""

from __future__ import annotations

import shutil
import sys
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Generic, Protocol, Self, TypeVar

if TYPE_CHECKING:
    from lasersph.simulation import RunProgress

LINES = 10
"""Lines of a whole run where there is no terminal."""
BAR = 24
"""Characters of the bar."""
REDRAW = 0.1
"""Shortest time between two drawings of the line [s]: terminals are slow."""
CLEAR = "\r\x1b[K"


class Status(Protocol):
    """How far something is."""

    @property
    def work_done(self) -> float:
        """Part of the work that is done, 0 to 1."""
        ...


S = TypeVar("S", bound=Status)


class ProgressDisplay(Generic[S]):
    """Shows progress on standard error; a callback of the time loop, or of many runs.

    Args:
        describe: how far it is, in one line.
    """

    def __init__(self, describe: Callable[[S], str], *, is_terminal: bool | None = None) -> None:
        self._describe = describe
        self.is_terminal = sys.stderr.isatty() if is_terminal is None else is_terminal
        self._line = ""
        self._drawn_at = float("-inf")
        self._lines_shown: int | None = None

    def __enter__(self) -> Self:
        """Nothing is shown before a loop is compiled or the first step is done."""
        return self

    def __exit__(self, *_: object) -> None:
        """Leave the line as it stands."""
        if self._line:
            _write(f"{CLEAR}{self._line}\n")

    def __call__(self, status: S) -> None:
        """Show how far it is."""
        if self.is_terminal:
            self._draw(status)
        else:
            self._print(status)

    def compiling(self) -> None:
        """The first loop that no earlier run has left is about to be compiled."""
        self.say("compiling loops as they are needed, about a minute in all; later runs find them")

    def say(self, text: str) -> None:
        """Show a line above the progress."""
        _write(f"{CLEAR if self._line else ''}{text}\n{self._line}")

    def _draw(self, status: S) -> None:
        done = BAR * min(status.work_done, 1.0)
        bar = ("=" * int(done)).ljust(BAR)
        # longer than the terminal, the line could not be drawn over
        self._line = f"[{bar}] {self._describe(status)}"[: shutil.get_terminal_size().columns - 1]
        now = time.monotonic()
        if now - self._drawn_at >= REDRAW:
            self._drawn_at = now
            _write(CLEAR + self._line)

    def _print(self, status: S) -> None:
        lines = int(LINES * min(status.work_done, 1.0))
        if self._lines_shown is None:  # a resumed run does not repeat what it has shown
            self._lines_shown = lines
        if lines > self._lines_shown:
            self._lines_shown = lines
            _write(f"{self._describe(status)}\n")


def describe(status: RunProgress) -> str:
    """Part of the work, simulated time, steps, highest temperature, and the time left if known."""
    from lasersph.input import format_duration, format_quantity

    left = status.remaining_s
    return ", ".join(
        [
            f"{100 * min(status.work_done, 1.0):3.0f} %  {format_quantity(status.time, 's')}",
            f"step {status.steps}",
            f"{status.hottest:.0f} K",
            *([] if left is None else [f"{format_duration(left)} left"]),
        ]
    )


def _write(text: str) -> None:
    sys.stderr.write(text)
    sys.stderr.flush()
