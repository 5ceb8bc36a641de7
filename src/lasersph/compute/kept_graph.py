"""`KeptGraph`: what the owner of a loop graph keeps of it, and what runs it again."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from lasersph.compute.access_paths import (
    LOST,
    AccessPaths,
    NamedArray,
    Parameters,
    access_paths,
    owner_of,
)
from lasersph.compute.compiled_iteration import LoopStep
from lasersph.compute.loops import Loops
from lasersph.compute.recording import Number, Recorded, Recording

Named = list[tuple[Any, list[str]]]
"""Launches with their names for a number."""


class KeptGraph:
    """A recording, with the ways to its arrays; it holds arrays, but never the owner.

    Attributes:
        recording: None before it is recorded.
    """

    recording: Recording | None = None
    _start: Callable[[], None]

    def __init__(self) -> None:
        self._paths: AccessPaths | None = None
        self._kept: tuple = ()
        self._rows: tuple = ()
        self._listed: list[list[Any]] = []
        self._values: tuple | None = None
        self._places: list[tuple[Any, int, int]] = []
        self._reducing: list[Any] = []
        self._steps: dict[int, LoopStep] = {}

    def fits(self, loops: Loops, owner: Any, arguments: tuple, options: dict) -> tuple | None:
        """Take the row lists that the method would come to, if it would to the same arrays.

        Returns:
            The numbers among the arguments; None where it would not, or nothing is recorded.
        """
        if self.recording is None:
            return None
        # the access paths compare every array; only lists of rows may be others
        try:
            found = self._compare(self._kept, owner, *arguments, **options)
        except LOST:
            return None
        if found is None:
            return None
        # bind the loops of each list of rows that is another one
        rows, values = found
        for k, one in enumerate(rows):
            if one is not self._rows[k]:
                if type(one) is not type(self._rows[k]):
                    return None
                host = loops.unwrap(one)
                for launch in self._listed[k]:
                    launch.take_rows(host)
        self._rows = rows
        return values

    def run(self, values: tuple) -> tuple[float, ...]:
        """Run what was recorded, with these numbers; returns what its loops reduce."""
        self._set(values)
        self._start()
        return tuple([number for launch in self._reducing for number in launch.results])

    def step(self, values: tuple, place: int) -> LoopStep:
        """Step of an iteration by what was recorded, with these numbers but for one of them.

        Args:
            place: of the number that changes, -1 for none.
        """
        self._set(values)
        self._values = None  # the iteration writes others
        step = self._steps.get(place)
        if step is None:
            assert self.recording is not None
            step = self._steps[place] = step_of_recording(self.recording, len(values), place)
        return step

    def keep(
        self,
        loops: Loops,
        found: Recording,
        parameters: Parameters,
        objects: tuple,
        values: tuple,
    ) -> None:
        """Keep a recording of the method with these arguments."""
        by_name = dict(zip(parameters.objects, objects, strict=True))
        by_name |= zip(parameters.numbers, values, strict=True)
        # ways to the arrays, unless those of the recording before lead there as well
        taken, rows = _taken(loops, found)
        if not self._leads_to(loops, taken, rows, by_name):
            self._paths = access_paths(parameters, objects, taken, rows, loops.unwrap)
            self._kept, self._rows = self._paths.ends(**by_name)
        assert self._paths is not None
        self._compare, self._values, self._steps = self._paths.compare, None, {}

        # launches of each list of rows, and memory of each number
        hosts = [loops.unwrap(one) for one in self._rows]
        self._listed = [
            [one.launch for one in found.launches if _has_rows(loops, one, host)] for host in hosts
        ]
        named = launches_of_numbers(found, len(values))
        # memory of each number of the graph in all loops that take it
        self._places = [
            (*memory, place)
            for place, launches in enumerate(named)
            for launch, names in launches
            for name in names
            for memory in launch.memory_of(name)
        ]
        # list of all launches, which run one after the other
        launches = [one.launch for one in found.launches]
        self._reducing = [launch for launch in launches if launch.reduces]
        self._start = loops.launcher.list_of(launches, loops.precision)
        self.recording = found

    def _set(self, values: tuple) -> None:
        """Take numbers."""
        if values != self._values:
            for memory, k, place in self._places:
                memory[k] = values[place]
            self._values = values

    def _leads_to(
        self,
        loops: Loops,
        taken: list[NamedArray],
        rows: list[NamedArray],
        by_name: dict[str, Any],
    ) -> bool:
        """Whether the ways that are known lead to other arrays; takes what lies at their ends."""
        if self._paths is None:
            return False
        try:
            kept, lists = self._paths.ends(**by_name)
            if self._paths.compare(kept, **by_name) is None:
                return False
        except LOST:
            return False
        # arrays that the ways lead to, and those whose memory they show
        owners, listed = set[int](), set[int]()
        for one in kept:
            if hasattr(one, "dtype"):
                host = loops.unwrap(one)
                owners |= {id(host), id(owner_of(host))}
        for one in lists:
            if one is None:
                return False
            listed.add(id(loops.unwrap(one)))
        # each list of rows by a way of its own, and each array that loops take by some way
        if len(listed) < len(lists) or any(id(host) not in listed | owners for _, host in rows):
            return False
        if any(id(owner_of(host)) not in owners for _, host in taken):
            return False
        self._kept, self._rows = kept, lists
        return True


def step_of_recording(found: Recording, numbers: int, place: int) -> LoopStep:
    """The launches of a recording as a step, of the number at a place."""
    named = launches_of_numbers(found, numbers)[place] if place >= 0 else []
    return LoopStep([one.launch for one in found.launches], named)


def launches_of_numbers(found: Recording, numbers: int) -> list[Named]:
    """For each number of a graph the launches that take it, with their names for it."""
    named: list[Named] = [[] for _ in range(numbers)]
    for launch, call, _ in found.launches:
        # a number of the graph is told by its type from a constant of the same value
        for name, value in call.constants.items():
            if type(value) is Number:
                named[value.place].append((launch, [name]))
    return named


def refuse_change(before: Recording, found: Recording) -> None:
    """Raise ValueError where a method launches other loops than before, with other arrays or with
    other constants beside the numbers of its graph."""
    if len(before.launches) != len(found.launches):
        raise ValueError(f"{len(found.launches)} loops, {len(before.launches)} when recorded")
    # loop by loop: the same function, arrays and constants
    for old, new in zip(before.launches, found.launches, strict=True):
        is_same = old.launch.bound_to == new.launch.bound_to
        if not (is_same and old.call.function is new.call.function and _have_same(old, new)):
            raise ValueError(f"{new.call.function.__name__}() is not what its graph recorded")


def _have_same(old: Recorded, new: Recorded) -> bool:
    """Whether the constants that are no numbers of a graph are the same."""
    constants, given = old.call.constants, new.call.constants
    fixed = [
        name
        for name, value in given.items()
        if type(value) is not Number and not getattr(value, "ndim", 0)
    ]
    return all(constants[name] == given[name] for name in fixed)


def _has_rows(loops: Loops, one: Recorded, host: Any) -> bool:
    """Whether a launch runs a list of rows."""
    return one.call.rows is not None and loops.unwrap(one.call.rows) is host


def _taken(loops: Loops, found: Recording) -> tuple[list[NamedArray], list[NamedArray]]:
    """Arrays that the launches of a recording take and it has not made, and row lists."""
    made = {id(owner_of(one)) for one in found.arrays}
    taken: dict[int, NamedArray] = {}
    rows: dict[int, NamedArray] = {}
    for _, call, _ in found.launches:
        given, name = loops.given(call), call.function.__name__
        # all arrays of a loop, with their names for messages
        lists = [(one, getattr(given, one)) for one in ("row_start", "row_end", "neighbor")]
        for symbol, host in (*given.named, *lists):
            # arrays that the recording has made are its own
            if host is not None and id(owner_of(host)) not in made:
                taken.setdefault(id(host), (f"{symbol} of {name}()", host))
        if given.rows is not None:
            rows.setdefault(id(given.rows), (f"rows of {name}()", given.rows))
    return list(taken.values()), list(rows.values())
