"""How far a run is: one line that is drawn again on a terminal, ten lines elsewhere."""

from __future__ import annotations

import shutil
import sys
import time
from typing import TYPE_CHECKING, Self

if TYPE_CHECKING:
    from lasersph.simulation import RunProgress

LINES = 10
"""Lines of a whole run where there is no terminal."""
BAR = 24
"""Characters of the bar."""
REDRAW = 0.1
"""Shortest time between two drawings of the line [s]: terminals are slow."""
CLEAR = "\r\x1b[K"


class ProgressDisplay:
    """Shows the progress of one run on standard error; a callback of the time loop."""

    def __init__(self, *, is_terminal: bool | None = None) -> None:
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

    def __call__(self, status: RunProgress) -> None:
        """Show how far the run is, after each step."""
        if self.is_terminal:
            self._draw(status)
        else:
            self._print(status)

    def compiling(self) -> None:
        """The first loop that no earlier run has left is about to be compiled."""
        text = "compiling loops as they are needed, about a minute in all; later runs find them"
        _write(f"{CLEAR if self._line else ''}{text}\n{self._line}")

    def _draw(self, status: RunProgress) -> None:
        done = BAR * min(status.work_done, 1.0)
        bar = ("=" * int(done)).ljust(BAR)
        # longer than the terminal, the line could not be drawn over
        self._line = f"[{bar}] {describe(status)}"[: shutil.get_terminal_size().columns - 1]
        now = time.monotonic()
        if now - self._drawn_at >= REDRAW:
            self._drawn_at = now
            _write(CLEAR + self._line)

    def _print(self, status: RunProgress) -> None:
        lines = int(LINES * min(status.work_done, 1.0))
        if self._lines_shown is None:  # a resumed run does not repeat what it has shown
            self._lines_shown = lines
        if lines > self._lines_shown:
            self._lines_shown = lines
            _write(f"{describe(status)}\n")


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
