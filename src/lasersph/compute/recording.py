"""What is launched, and which arrays are made, while a part of a step is recorded."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from lasersph.compute.signature import Call


class Recorded(NamedTuple):
    """A launch of a recording, its call, and what it has reduced; None where it was prepared."""

    launch: Any
    call: Call
    results: tuple[float, ...] | None


class Recording:
    """What was launched while it was under way, and the arrays that were made.

    Args:
        before: the recording whose arrays are taken again, in order.
    """

    def __init__(self, before: Recording | None = None) -> None:
        self.launches: list[Recorded] = []
        self.arrays: list[np.ndarray] = []
        self._before = [] if before is None else before.arrays

    @property
    def results(self) -> tuple[float, ...]:
        """All reductions, in order."""
        return tuple([number for _, _, found in self.launches for number in found or ()])

    def make(self, shape: int | tuple[int, ...], kind: np.dtype) -> np.ndarray:
        """A new array, or the one that the recording before has made here."""
        place = len(self.arrays)
        kept = self._before[place] if place < len(self._before) else np.empty(shape, kind)
        self.arrays.append(kept)
        return kept


class Recorder:
    """What of the loops that are run is kept at present.

    Attributes:
        recording: takes launches and arrays. tally: takes reductions. None where they do not.
    """

    recording: Recording | None = None
    tally: list[float] | None = None

    def record(self, run: Callable[[], Any], before: Recording | None = None) -> Recording:
        """Run `run`; returns what it has launched and made.

        Raises:
            ValueError: a recording is under way.
        """
        if self.recording is not None:
            raise ValueError("a recording is under way")
        found = self.recording = Recording(before)
        try:
            run()
        finally:
            self.recording = None
        return found

    def reductions(self, run: Callable[[], Any]) -> tuple[float, ...]:
        """Run `run`; returns all that its loops reduce, in order."""
        found = self.tally = []
        try:
            run()
        finally:
            self.tally = None
        return tuple(found)

    def add(self, launch: Any, call: Call, results: tuple[float, ...] | None) -> tuple[float, ...]:
        """Take a launch that was run, or prepared; returns its results."""
        assert self.recording is not None
        self.recording.launches.append(Recorded(launch, call, results))
        return results or ()
