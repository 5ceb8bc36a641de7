"""What a run waits for the first time: the compiling of loops that no earlier run has left."""

from __future__ import annotations

import time
from collections.abc import Callable
from types import TracebackType
from typing import Any, Self

from numba.core import event

_EVENT = "numba:compile"


class Compiling(event.Listener):
    """Counts and times the loops that are compiled inside a `with` block.

    Args:
        begun: called once, before the first of them. done: called after each, with this.

    Attributes:
        loops: how many so far. seconds: how long that has taken, by the wall clock [s].
    """

    def __init__(
        self, begun: Callable[[], None], done: Callable[[Compiling], None] = lambda _: None
    ) -> None:
        self.loops, self.seconds = 0, 0.0
        self._begun, self._done, self._depth, self._start = begun, done, 0, 0.0

    def __enter__(self) -> Self:
        """Listen."""
        event.register(_EVENT, self)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Listen no more."""
        event.unregister(_EVENT, self)

    def on_start(self, event: Any) -> None:
        """A loop, or a function that one calls, is about to be compiled."""
        if self._depth == 0:
            if self.loops == 0:
                self._begun()
            self._start = time.perf_counter()
        self._depth += 1

    def on_end(self, event: Any) -> None:
        """It has been."""
        self._depth -= 1
        if self._depth == 0:
            self.loops += 1
            self.seconds += time.perf_counter() - self._start
            self._done(self)
