"""A backend that tells how much the loops of a piece of program must move and compute at least."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from hot_loops.least import Least, least_of
from lasersph.compute.backend import Backend
from lasersph.compute.launch import Bound, Launch, Launcher
from lasersph.compute.loops import Loops
from lasersph.compute.signature import Call


class CountingBackend(Backend):
    """The CPU's backend; its loops are counted while `least` runs them, and otherwise only run."""

    def __init__(self, threads: int | None) -> None:
        super().__init__(threads, "float64")
        self._loops = _CountedLoops(self.precision, self.launcher(), self.unwrap)

    def least(self, run: Callable[[], Any]) -> Least:
        """Run `run` once; returns the sum over its loops, called, prepared or recorded."""
        total = Least()

        def note(call: Call) -> None:
            nonlocal total
            total += least_of(call)

        self._loops.note = note
        try:
            run()
        finally:
            self._loops.note = _ignore
        return total


def _ignore(call: Call) -> None:
    """Nothing is counted."""


class _CountedLoops(Loops):
    """Loops that tell of each launch."""

    note: Callable[[Call], None] = staticmethod(_ignore)

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self._calls: list[Call] | None = None

    def run(self, call: Call) -> tuple[float, ...]:
        if self._calls is not None:
            self._calls.append(call)
        self.note(call)
        return super().run(call)

    def prepared(self, call: Call) -> Launch:
        return _CountedLaunch(self._bound(call), self.launcher, partial(self._tell, call))

    def recorded(self, run: Callable[[], None]) -> Callable[[], None]:
        self._calls = calls = []
        try:
            replay = super().recorded(run)
        finally:
            self._calls = None

        def again() -> None:
            for call in calls:
                self.note(call)
            replay()

        return again

    def _tell(self, call: Call) -> None:
        self.note(call)


class _CountedLaunch(Launch):
    """A launch that tells of each run."""

    def __init__(self, bound: Bound, launcher: Launcher, tell: Callable[[], None]) -> None:
        super().__init__(bound, launcher)
        self._tell = tell

    def __call__(self, **constants: Any) -> tuple[float, ...]:
        self._tell()
        return super().__call__(**constants)
