"""A backend that tells how much the loops of a piece of program must move and compute at least."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from hot_loops.least import Least, least_of
from lasersph.compute.backend import Backend
from lasersph.compute.launch import Bound, Launch
from lasersph.compute.loops import Loops
from lasersph.compute.phase import Phase
from lasersph.compute.signature import Call


class CountingBackend(Backend):
    """The CPU's backend; its loops are counted while `least` runs them, and otherwise only run."""

    def __init__(self, threads: int | None) -> None:
        super().__init__(threads, "float64")
        self._loops = _CountedLoops(self.precision, self.launcher(), self.unwrap)

    def phase(self, run: Callable[..., Any]) -> Phase:
        """A phase that is run as it is, so that its loops are counted each time."""
        return Phase(self._loops, run, checks=True)

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

    def run(self, call: Call) -> tuple[float, ...]:
        if self.recorder.recording is None:
            self.note(call)
        return super().run(call)

    def prepared(self, call: Call, again: Launch | None = None) -> Launch:
        return super().prepared(call)

    def bind(self, call: Call) -> Launch:
        bound = self._bound(self.given(call))
        return _CountedLaunch(bound, self.launcher.threads, partial(self._tell, call))

    def _tell(self, call: Call) -> None:
        self.note(call)


class _CountedLaunch(Launch):
    """A launch that tells of each run."""

    def __init__(self, bound: Bound, threads: int, tell: Callable[[], None]) -> None:
        super().__init__(bound, threads, holds=True)
        self._tell = tell

    def __call__(self, **constants: Any) -> tuple[float, ...]:
        self._tell()
        return super().__call__(**constants)
