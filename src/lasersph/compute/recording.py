"""Recordings: launches, and arrays that are made, while a graph is under way."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from lasersph.compute.signature import Call


class Number(float):
    """A number that a graph is given, while it is recorded; nothing can be computed from it.

    Attributes:
        place: among the numbers of the graph.
    """

    __slots__ = ("place",)

    def __new__(cls, value: float, place: int) -> Number:
        found = super().__new__(cls, value)
        found.place = place
        return found


def _refuse(_number: Number, *_others: Any) -> Any:
    raise ValueError("a graph computes with a number that it is given: let it be given the result")


# what is computed would keep its value when the graph is run again with other numbers
for _operator in ["add", "sub", "mul", "truediv", "pow", "mod", "floordiv"]:
    for _name in (f"__{_operator}__", f"__r{_operator}__"):
        setattr(Number, _name, _refuse)
for _name in ("__neg__", "__pos__", "__abs__"):
    setattr(Number, _name, _refuse)


def without_names(call: Call) -> Call:
    """A call with plain numbers."""
    constants = call.constants
    if not any(type(value) is Number for value in constants.values()):
        return call
    plain = {k: float(v) if type(v) is Number else v for k, v in constants.items()}
    return call._replace(constants=plain)


class Recorded(NamedTuple):
    """A launch of a recording, its call, and what it has reduced; None where it was only bound."""

    launch: Any
    call: Call
    results: tuple[float, ...] | None


class Recording:
    """Launches while it was under way, and the arrays that were made.

    Args:
        before: launches that are bound again, and arrays that are taken again, in order.
        is_run: False where launches are bound without running.
    """

    def __init__(self, before: Recording | None = None, *, is_run: bool = True) -> None:
        self.launches: list[Recorded] = []
        self.arrays: list[Any] = []
        self.is_run = is_run
        self._before = before

    @property
    def results(self) -> tuple[float, ...]:
        """All reductions, in order."""
        return tuple([number for _, _, found in self.launches for number in found or ()])

    def next_before(self) -> Any:
        """The launch that the recording before has at the place of the next one, if any."""
        before, place = self._before, len(self.launches)
        if before is None or place >= len(before.launches):
            return None
        return before.launches[place].launch

    def without_launches(self) -> Recording:
        """A recording that has made the same arrays, and nothing else."""
        found = Recording()
        found.arrays = self.arrays
        return found

    def forget_before(self) -> None:
        """Hold the recording before no longer."""
        self._before = None

    def make(self, shape: int | tuple[int, ...], kind: np.dtype, empty: Callable[..., Any]) -> Any:
        """A new array, or the one that the recording before has made here.

        Args:
            empty: makes one of a shape and kind.

        Raises:
            ValueError: launches are only bound: nothing would set its elements to 0.
        """
        if not self.is_run:
            raise ValueError("a step of an iteration makes no arrays")
        # the array made at this place before, if it has the same shape and kind
        place, before = len(self.arrays), self._before
        kept = before.arrays[place] if before and place < len(before.arrays) else None
        wanted = shape if isinstance(shape, tuple) else (shape,)
        if kept is None or kept.shape != wanted or kept.dtype != kind:
            kept = empty(shape, kind)
        self.arrays.append(kept)
        return kept


class Recorder:
    """Recording or reductions that the loops which are run are kept in at present.

    Attributes:
        recording: takes launches and arrays. tally: takes reductions. None where they do not.
        is_busy: whether a graph is under way. checks: whether graphs run their methods each time,
            and compare what these launch.
    """

    recording: Recording | None = None
    tally: list[float] | None = None
    is_busy = checks = False

    def record(self, run: Callable[[], Any], into: Recording) -> Recording:
        """Run `run`; returns `into` with what it has launched and made.

        Raises:
            ValueError: a recording is under way.
        """
        if self.is_busy:
            raise ValueError("a recording is under way")
        self.recording, self.is_busy = into, True
        try:
            run()
        finally:
            self.recording, self.is_busy = None, False
            into.forget_before()
        return into

    def reductions(self, run: Callable[[], Any]) -> tuple[float, ...]:
        """Run `run`; returns all that its loops reduce, in order."""
        found = self.tally = []
        self.is_busy = True
        try:
            run()
        finally:
            self.tally, self.is_busy = None, False
        return tuple(found)

    def add(self, launch: Any, call: Call) -> tuple[float, ...]:
        """Take a launch, and run it where it is to be; returns its results."""
        assert self.recording is not None
        # a step of an iteration is bound without being run
        results = launch() if self.recording.is_run else None
        self.recording.launches.append(Recorded(launch, call, results))
        return results or ()
