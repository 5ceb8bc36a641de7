"""How far a run is: one line that is drawn again on a terminal, ten lines elsewhere."""

from __future__ import annotations

import shutil
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf
from typing import TYPE_CHECKING, Generic, Protocol, Self, TypeVar

if TYPE_CHECKING:
    from lasersph.compute.compiling import Compiling
    from lasersph.simulation import RunProgress

LINES = 10
"""Lines of a whole run where there is no terminal."""
BAR = 24
"""Characters of the bar."""
REDRAW = 0.1
"""Shortest time between two drawings of the line [s]: terminals are slow."""
USUAL_LOOPS = 150
"""Loops of a melt pool whose surface moves, which has most of them: 147 were counted."""
LOOPS_OF_A_RATE = 10
"""Loops after which it is said how long the others take: the first takes as long as ten."""
LOOPS_OF_A_LINE = 25
"""Loops from one line about them to the next, where there is no terminal."""
STILL_COMPILING = 20
"""Steps after which no further loop is expected: the first steps of a phase need new ones."""
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
        # The last line stays on the terminal.
        if self._line:
            _write(f"{CLEAR}{self._line}\n")

    def __call__(self, status: S) -> None:
        """Show how far it is."""
        if self.is_terminal:
            self._draw(status)
        else:
            self._print(status)

    def say(self, text: str) -> None:
        """Show a line above the progress."""
        _write(f"{CLEAR if self._line else ''}{text}\n{self._line}")

    def _draw(self, status: S) -> None:
        # The bar, then the words, on one line of the terminal.
        done = BAR * min(status.work_done, 1.0)
        bar = ("=" * int(done)).ljust(BAR)
        # longer than the terminal, the line could not be drawn over
        self._line = f"[{bar}] {self._describe(status)}"[: shutil.get_terminal_size().columns - 1]
        # Terminals are slow: not every step is drawn.
        now = time.monotonic()
        if now - self._drawn_at >= REDRAW:
            self._drawn_at = now
            _write(CLEAR + self._line)

    def _print(self, status: S) -> None:
        # Elsewhere a line for each tenth of the work.
        lines = int(LINES * min(status.work_done, 1.0))
        if self._lines_shown is None:  # a resumed run does not repeat what it has shown
            self._lines_shown = lines
        if lines > self._lines_shown:
            self._lines_shown = lines
            _write(f"{self._describe(status)}\n")


class RunDisplay(ProgressDisplay["RunProgress"]):
    """Shows the progress of a run, and the compiling of its loops as what it is.

    While loops are compiled nothing is said of the time that is left to compute.

    Args:
        loops: how many the run may have to compile.
    """

    def __init__(self, loops: int = USUAL_LOOPS, *, is_terminal: bool | None = None) -> None:
        super().__init__(str, is_terminal=is_terminal)
        self._loops = loops
        self._steps_since_compiling: float = inf

    def __call__(self, status: RunProgress) -> None:
        """Show how far the run is."""
        self._steps_since_compiling += 1
        # Time that is left is unknown while loops are compiled.
        if self._steps_since_compiling <= STILL_COMPILING:
            status = replace(status, remaining_s=None)
        super().__call__(status)

    def compiling(self) -> None:
        """The first loop that no earlier run has left is about to be compiled."""
        self.say("compiling loops as they are needed, some seconds in all; later runs find them")

    def compiled(self, compiling: Compiling) -> None:
        """Another loop is: how many now, and how long the rest may take."""
        self._steps_since_compiling = 0
        # What is left at the rate so far, at most; the first loops load the compiler as well.
        count, took = compiling.loops, compiling.seconds
        text = f"compiled {count} loops of up to {max(self._loops, count)} in {took:.0f} s"
        if count >= LOOPS_OF_A_RATE:
            remaining = max(self._loops - count, 0) * took / count
            text += f", {remaining:.0f} s more at most"
        if self.is_terminal:
            self._line = text[: shutil.get_terminal_size().columns - 1]
            _write(CLEAR + self._line)
        elif count % LOOPS_OF_A_LINE == 0:
            _write(f"{text}\n")


@dataclass(frozen=True)
class Drawn:
    """How many figures of a run are looked at, of how many, and which is next."""

    count: int
    total: int
    name: str

    @property
    def work_done(self) -> float:
        """Part that is done, 0 to 1."""
        return self.count / self.total


class WarningsOnce:
    """Shows each kind of warning of a command once, however many of its runs have it, each with
    other numbers."""

    def __init__(self) -> None:
        self._shown: set[str] = set()

    def show(self, text: str, say: Callable[[str], None]) -> None:
        """Hand a warning to what shows lines, unless one of its kind was shown before."""
        # One of each kind, with the numbers of the first run that has it.
        from lasersph.sweeps.run_warnings import warning_kind

        if (kind := warning_kind(text)) not in self._shown:
            self._shown.add(kind)
            say(f"warning: {text}")


def _write(text: str) -> None:
    sys.stderr.write(text)
    sys.stderr.flush()
