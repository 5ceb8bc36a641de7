"""Phases: parts of a step whose loops are bound once, and run again while their arrays stay.

A phase is a plain function that launches loops, makes arrays and copies or fills some. Where the
arrays that may be replaced are the same as the last time, all that it launches is kept, and from
then on runs again in compiled code, with other numbers and other lists of rows; the arrays that it
makes are the same from then on, filled with zeros again. So nothing of Python runs between loops
that take less time than their calls. With other arrays, and where launches are not bound to memory
(on a graphics card), the function is run as it is.
"""

from __future__ import annotations

from array import array
from collections.abc import Callable, Sequence
from operator import is_
from typing import Any, NamedTuple

from lasersph.compute.array_types import Array, Rows
from lasersph.compute.launch import Launch, list_function
from lasersph.compute.loops import Loops
from lasersph.compute.recording import Recording


class Replay(NamedTuple):
    """What a phase has launched, and what changes in it.

    Attributes:
        recording: the launches, with what holds their arrays. listed: those of each list of rows.
            numbered: those that take numbers, with the names. reducing: those that reduce.
            addresses: of all that run.
    """

    recording: Recording
    listed: list[list[Launch]]
    numbered: list[tuple[Launch, list[str]]]
    reducing: list[Launch]
    addresses: array


class Phase:
    """A function of numbers and of what stays, as above.

    Args:
        run: called as run(*arguments, **numbers). Its loops take the numbers under their own names,
            and no rows but those that are given; nothing else that it reads changes but the
            elements of arrays. It leaves reductions to the caller. A method is given as the
            function of its class: an owner that the phase held would go only with its ring.
        checks: run the function each time, and refuse it where it does not do the same again.
    """

    def __init__(self, loops: Loops, run: Callable[..., Any], *, checks: bool = False) -> None:
        self._loops, self._run, self._checks = loops, run, checks
        self._seen: list[Any] = []
        self._replay: Replay | None = None
        self._numbers: dict[str, float] = {}
        self._rows: list[Any] = []
        self._start = list_function(loops.precision) if loops.launcher.rebinds else None

    def __call__(
        self, *arguments: Any, reads: Sequence[Array], rows: Sequence[Rows] = (), **numbers: float
    ) -> tuple[float, ...]:
        """Run; returns what its loops reduce, in order.

        Args:
            reads: arrays that may be replaced by others, among all that the loops take. rows: lists
                of rows that they take, each new at each call.

        Raises:
            ValueError: a loop takes rows that are not given, or another value under the name of a
                number.
        """
        unwrap, recorder = self._loops.unwrap, self._loops.recorder
        hosts = [unwrap(one) for one in reads]
        if len(hosts) != len(self._seen) or not all(map(is_, hosts, self._seen)):
            self._seen, self._replay = hosts, None
            return recorder.reductions(lambda: self._run(*arguments, **numbers))
        replay, start = self._replay, self._start
        if replay is None or start is None or self._checks:
            before = None if replay is None else replay.recording
            found = recorder.record(lambda: self._run(*arguments, **numbers), before)
            if before is not None:
                refuse_change(before, found, numbers)
            elif start is not None:
                self._replay, self._numbers = replay_of(found, rows, numbers), numbers
                self._rows = [unwrap(one) for one in rows]
            return found.results
        chosen = [unwrap(one) for one in rows]
        for one, last, launches in zip(chosen, self._rows, replay.listed, strict=True):
            if one is not last:
                for launch in launches:
                    launch.take_rows(one)
        self._rows = chosen
        if numbers != self._numbers:
            self._numbers = numbers
            for launch, names in replay.numbered:
                launch.set({name: numbers[name] for name in names})
        start(replay.addresses.buffer_info()[0], len(replay.addresses))
        return tuple([number for launch in replay.reducing for number in launch.results])


def replay_of(found: Recording, rows: Sequence[Rows], numbers: dict[str, float]) -> Replay:
    """Find what changes in the launches of a recording."""
    listed: list[list[Launch]] = [[] for _ in rows]
    numbered: list[tuple[Launch, list[str]]] = []
    for launch, call, _ in found.launches:
        name = call.function.__name__
        names = [one for one in numbers if one in call.constants]
        if any(call.constants[one] != numbers[one] for one in names):
            raise ValueError(f"{name}() takes other numbers than its phase: {names}")
        if names:
            numbered.append((launch, names))
        if call.rows is not None:
            places = [k for k, chosen in enumerate(rows) if chosen is call.rows]
            if not places:
                raise ValueError(f"{name}() takes rows that its phase is not given")
            listed[places[0]].append(launch)
    runs = [launch for launch, _, results in found.launches if results is not None]
    reducing = [launch for launch in runs if launch.reduces]
    return Replay(found, listed, numbered, reducing, array("Q", [one.address for one in runs]))


def refuse_change(before: Recording, found: Recording, numbers: dict[str, float]) -> None:
    """Raise ValueError where a phase launches other loops than before, with other arrays or with
    other constants beside its numbers."""
    for (old, old_call, _), (new, call, _) in zip(before.launches, found.launches, strict=True):
        fixed = [
            name
            for name, value in call.constants.items()
            if name not in numbers and not getattr(value, "ndim", 0)
        ]
        is_same = old.bound_to == new.bound_to and old_call.function is call.function
        if not is_same or any(old_call.constants[k] != call.constants[k] for k in fixed):
            raise ValueError(f"{call.function.__name__}() is not what its phase ran before")
