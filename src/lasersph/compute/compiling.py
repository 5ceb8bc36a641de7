"""Progress of compiling: a run waits for loops that no earlier run has left."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import TracebackType
from typing import Self

_listening: list[Compiling] = []


class Compiling:
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
        self._begun, self._done, self._start = begun, done, 0.0

    def __enter__(self) -> Self:
        """Listen."""
        _listening.append(self)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Listen no more."""
        _listening.remove(self)

    def count_begin(self) -> None:
        """Count a loop that is about to be compiled."""
        if self.loops == 0:
            self._begun()
        self._start = time.perf_counter()

    def count_end(self) -> None:
        """Time it once it has been."""
        self.loops += 1
        self.seconds += time.perf_counter() - self._start
        self._done(self)


@contextmanager
def reported() -> Iterator[None]:
    """Tell who listens that a loop is compiled inside a `with` block."""
    heard = list(_listening)
    for one in heard:
        one.count_begin()
    try:
        yield
    finally:
        for one in heard:
            one.count_end()
