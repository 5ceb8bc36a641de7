"""Loop graphs: methods that read as an equation, whose loops are bound once and then run again.

    class Flow:
        @graph
        def correct_kernel(self, rows: Rows) -> None:
            self.backend.pair_sum(moment_term, ..., self._C, finish=bounded_inverse, rows=rows)

A graph is called like any method, and returns what its loops reduce, in order. Called first, its
method is run as it is. Called again, what it launches is recorded, and from then on runs as one
list, on the processor in compiled code, with other numbers, other lists of rows and other elements
of the same arrays; so nothing of Python runs between loops that take less time than their calls.
Numbers are the parameters that are annotated `float`. Where the method would come to other arrays
(`access_paths`), it is recorded anew.

A method launches loops, makes arrays (`zeros`, `unset`), copies or fills some, and calls graphs,
which are then part of it. It reads nothing else that changes, neither elements of arrays nor
attributes that are numbers, and sorts nothing. Its owner has the `backend`. Graphs are also the
steps of `Backend.iterate`, which are bound without being run.

The strict backend, and all within `checked_graphs`, run the method each time and refuse it where it
does not launch what it did before.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial, wraps
from typing import Any, ParamSpec, overload

from lasersph.compute.access_paths import arrangement, parameters_of
from lasersph.compute.compiled_iteration import CalledStep, LoopStep
from lasersph.compute.kept_graph import KeptGraph, refuse_change
from lasersph.compute.loops import Loops
from lasersph.compute.recording import Number, Recorder, Recording

P = ParamSpec("P")
GRAPHS: dict[str, LoopGraph] = {}
"""All graphs by the names of their methods."""
NOTHING = LoopStep([], [])
"""Step that launches no loop."""


class LoopGraph:
    """A method that launches loops, as above.

    Args:
        function: the method, which returns nothing.

    Attributes:
        name: of module and method.
    """

    def __init__(self, function: Callable[..., None]) -> None:
        self.function = function
        self.name = f"{function.__module__}.{function.__qualname__}"
        self._parameters = parameters_of(function)
        self._arrange = arrangement(self._parameters)
        names = self._parameters.text.split(", ")
        self._plain = names[1 : names.index("*") if "*" in names else None]
        self._free: dict[tuple, int] = {}

    def run(self, owner: Any, arguments: tuple, options: dict[str, Any]) -> tuple[float, ...]:
        """Run; returns what the loops reduce, in order; nothing inside another graph.

        Raises:
            ValueError: a loop takes an array that the method has not from its arguments, or it
                computes with a number of the graph; see also `checked_graphs`.
        """
        loops: Loops = owner.backend.loops
        recorder = loops.recorder
        # within another graph it is part of that one
        if recorder.is_busy:
            self.function(owner, *arguments, **options)
            return ()
        # recorded: run that where it leads to the same arrays, else record anew
        kept: KeptGraph | None = owner.__dict__.get(self.name)
        if kept is not None:
            values, found = self._updated(loops, kept, owner, arguments, options)
            return kept.run(values) if found is None else found.results
        # first call: nothing is recorded of a method that is called once
        owner.__dict__[self.name] = KeptGraph()
        return recorder.reductions(lambda: self.function(owner, *arguments, **options))

    def step(self, owner: Any, arguments: tuple, options: dict[str, Any]) -> LoopStep:
        """The graph as a step of an iteration, of the one number that is not given, if any."""
        loops: Loops = owner.backend.loops
        # the number that the iteration changes; any value stands for it
        place = self._free_number(len(arguments), tuple(options))
        if place >= 0:
            options = options | {self._parameters.numbers[place]: 0.0}
        # recorded once, without being run
        kept = owner.__dict__.get(self.name)
        if kept is None:
            kept = owner.__dict__[self.name] = KeptGraph()
        values, _ = self._updated(loops, kept, owner, arguments, options, is_run=False)
        return kept.step(values, place)

    def _free_number(self, plain: int, named: tuple[str, ...]) -> int:
        """Place of the number that is not given with so many arguments and these, -1 for none."""
        found = self._free.get((plain, named))
        if found is None:
            given, numbers = (*self._plain[:plain], *named), self._parameters.numbers
            found = next((k for k, name in enumerate(numbers) if name not in given), -1)
            self._free[plain, named] = found
        return found

    def _recorded(self, loops: Loops, objects: tuple, values: tuple, into: Recording) -> Recording:
        """Record what the method launches, with numbers that are told from others."""
        # numbers of the graph carry their places, to be found in calls of loops
        given = dict(zip(self._parameters.objects, objects, strict=True))
        for k, (name, value) in enumerate(zip(self._parameters.numbers, values, strict=True)):
            given[name] = Number(value, k)
        return loops.recorder.record(lambda: self.function(**given), into)

    def _updated(
        self,
        loops: Loops,
        kept: KeptGraph,
        owner: Any,
        arguments: tuple,
        options: dict[str, Any],
        *,
        is_run: bool = True,
    ) -> tuple[tuple, Recording | None]:
        """Numbers of a call, and what its method has launched; None where the recording serves."""
        values = kept.fits(loops, owner, arguments, options)
        if values is not None and not loops.recorder.checks:
            return values, None
        before = kept.recording
        objects, given = self._arrange(owner, *arguments, **options)
        # it would launch the same: compare that with the recording
        if values is not None and before is not None:
            into = Recording(before.without_launches(), is_run=is_run)
            found = self._recorded(loops, objects, given, into)
            refuse_change(before, found)
            return given, found
        # else record it anew, with the launches of the recording before bound again
        kept.recording = None
        found = self._recorded(loops, objects, given, Recording(before, is_run=is_run))
        kept.keep(loops, found, self._parameters, objects, given)
        return given, found


@overload
def graph(function: Callable[P, None]) -> Callable[P, tuple[float, ...]]: ...
@overload
def graph(function: Callable[..., None]) -> Any: ...
def graph(function: Callable[..., None]) -> Any:
    """Make a method a loop graph, see above."""
    one = LoopGraph(function)

    @wraps(function)
    def run(owner: Any, *arguments: Any, **options: Any) -> tuple[float, ...]:
        return one.run(owner, arguments, options)

    GRAPHS[one.name] = run.graph = one  # type: ignore[attr-defined]
    return run


@contextmanager
def checked_graphs() -> Iterator[None]:
    """Let all graphs run their methods each time; ValueError where one does not launch the same
    loops with the same arrays and constants as when it was recorded."""
    before = Recorder.checks
    Recorder.checks = True
    try:
        yield
    finally:
        Recorder.checks = before


def step_of(given: Any) -> LoopStep | CalledStep:
    """A step of an iteration: of a graph of an owner, with arguments by `partial`, of another
    function of one number, or of None."""
    if given is None:
        return NOTHING
    # arguments given by `partial`, and the graph behind the method
    bound = given.func if isinstance(given, partial) else given
    one: LoopGraph | None = getattr(bound, "graph", None)
    if one is None:
        return CalledStep(given)
    if bound is given:
        return one.step(bound.__self__, (), {})
    return one.step(bound.__self__, given.args, given.keywords)
