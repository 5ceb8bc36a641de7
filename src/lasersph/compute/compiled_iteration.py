"""Compiled iterations: loops driven by numbers that they reduce, such as conjugate gradients.

An iteration is a plain function of steps and numbers. It runs a step by `run_step` and asks for
what that has reduced by `reduction`. On the processor it is compiled, so that nothing of Python
runs between the loops; elsewhere, and where a step is more than loops, Python runs the very same
function.
"""

from __future__ import annotations

import ast
import inspect
from array import array
from collections.abc import Callable, Sequence
from functools import cache, cached_property
from typing import Any

from lasersph.compute import cache as folder
from lasersph.compute.generate import NATIVE
from lasersph.compute.launch import RUN, Launch, list_function

HEAD = 3
"""Words of a step before the addresses of its launches."""
_TEXT = '''
def run_step(step, number):
    """Run the launches of the step at an address, with a number for those that have it."""
    words = at_uint64(step)
    launches, places = words[0], words[1]
    for k in range(launches, launches + places):
        at_{precision}(words[np.uint64(3) + k])[0] = number
    for k in range(launches):
        run(words[np.uint64(3) + k])


def reduction(step, k):
    """Number k of those that the last launch of a step has reduced."""
    return at_float64(at_uint64(step)[2])[np.uint64(k)]


{function}

def loop(frame):
    words = at_uint64(frame)
    numbers = at_float64(words[{steps}])
    {results} = {name}({arguments})
'''


class LoopStep:
    """Launches that run one after the other, with a number that changes from run to run.

    Args:
        launches: bound loops. named: those that take the number, with their names for it.

    Attributes:
        results: what the last launch has reduced.
    """

    def __init__(self, launches: Sequence[Any], named: Sequence[tuple[Any, list[str]]]) -> None:
        self.launches, self.named = list(launches), list(named)
        self.results: tuple[float, ...] = ()

    @cached_property
    def is_compiled(self) -> bool:
        """Whether every launch has a frame."""
        return all(type(launch) is Launch for launch in self.launches)

    @cached_property
    def words(self) -> array:
        """Numbers of launches and of places of the number, address of the results, and addresses
        of all launches and places, for compiled code."""
        launches = self.launches
        places = [
            place
            for launch, names in self.named
            for name in names
            for place in launch.number_places(name)
        ]
        results = launches[-1].results_address if launches else 0
        head = [len(launches), len(places), results]
        return array("Q", [*head, *(launch.address for launch in launches), *places])

    def run(self, number: float) -> None:
        """Run all with a number."""
        # numbers first, then all launches by one foreign call where they have frames
        for launch, names in self.named:
            launch.set(dict.fromkeys(names, number))
        if self.launches and self.is_compiled:
            last, (address, _) = self.launches[-1], self.words.buffer_info()
            list_function(last.precision)(address + 8 * HEAD, len(self.launches))
            self.results = tuple(last.results)
        else:
            for launch in self.launches:
                self.results = launch()


class CalledStep:
    """A function of a number that does more than launch loops, and returns what it reduces.

    Attributes:
        results: what the last run has reduced.
    """

    is_compiled = False

    def __init__(self, function: Callable[[float], tuple[float, ...]]) -> None:
        self.function = function
        self.results: tuple[float, ...] = ()

    def run(self, number: float) -> None:
        """Run it with a number."""
        self.results = self.function(number)


def run_step(step: LoopStep | CalledStep, number: float) -> None:
    """Run a step with its number."""
    step.run(number)


def reduction(step: LoopStep | CalledStep, k: int) -> float:
    """Number k of those that the last launch of a step has reduced."""
    return step.results[k]


def iterate(
    function: Callable[..., tuple],
    steps: Sequence[LoopStep | CalledStep],
    numbers: Sequence[float],
    precision: str,
) -> tuple[float, ...]:
    """Results of an iteration.

    Args:
        function: plain function of so many steps and then numbers, which returns numbers, no more
            of them than it takes; it reads no global names but `run_step` and `reduction`.
    """
    # Python runs it where a step is more than bound loops
    loops = [step for step in steps if isinstance(step, LoopStep) and step.is_compiled]
    if len(loops) < len(steps):
        return function(*steps, *numbers)
    # frame: addresses of the steps and of the numbers, which results replace
    words, values = [step.words for step in loops], array("d", numbers)
    frame = array("Q", [word.buffer_info()[0] for word in (*words, values)])
    _compiled(function, len(steps), precision)(frame.buffer_info()[0])
    return tuple(values)


@cache
def _compiled(function: Any, steps: int, precision: str) -> Callable[[int], None]:
    """Foreign function of the address of a frame."""
    # steps are addresses, the other arguments numbers
    count = function.__code__.co_argcount
    given = [f"words[{k}]" for k in range(steps)] + [f"numbers[{k}]" for k in range(count - steps)]
    source = inspect.getsource(function)
    returned = next(node.value for node in ast.walk(ast.parse(source)) if type(node) is ast.Return)
    assert isinstance(returned, ast.Tuple)
    text = (NATIVE + RUN + _TEXT).format(
        precision=precision,
        function=source,
        steps=steps,
        name=function.__name__,
        arguments=", ".join(given),
        results=", ".join(f"numbers[{k}]" for k in range(len(returned.elts))),
    )
    return folder.function(text, 1)
