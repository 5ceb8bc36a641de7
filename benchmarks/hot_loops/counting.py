"""A backend that tells how much the loops of a piece of program must move and compute at least."""

from __future__ import annotations

from collections.abc import Callable, Sequence
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
        self.loops = _CountedLoops(self.precision, self.launcher(), self.unwrap)

    def launcher(self) -> Launcher:
        """The launcher of the loops, which starts those of a graph one by one."""
        return _SingleLauncher(self.threads, self.precision)

    def least(self, run: Callable[[], Any]) -> Least:
        """Run `run` once; returns the sum over its loops, called or those of graphs."""
        total = Least()

        def note(call: Call) -> None:
            nonlocal total
            total += least_of(call)

        self.loops.note = note
        try:
            run()
        finally:
            self.loops.note = _ignore
        return total


def _ignore(call: Call) -> None:
    """Nothing is counted."""


class _SingleLauncher(Launcher):
    def list_of(self, launches: Sequence[Launch], precision: str) -> Callable[[], None]:
        """Function that calls launches one after the other, so that each tells."""

        def run() -> None:
            for launch in launches:
                launch()

        return run


class _CountedLoops(Loops):
    """Loops that tell of each launch."""

    note: Callable[[Call], None] = staticmethod(_ignore)

    def run(self, call: Call) -> tuple[float, ...]:
        if self.recorder.recording is None:
            self.note(call)
        return super().run(call)

    def _bind_again(self, call: Call, again: Launch | None) -> Launch:
        return self.bind(call)

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
