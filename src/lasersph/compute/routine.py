"""Routines: loops driven by numbers that they reduce, such as conjugate gradients.

A routine is a plain function of steps and numbers. It runs a step by `take` and asks for what that
has reduced by `result`. On the processor it is compiled, so that nothing of Python runs between the
loops; elsewhere, and where a step is more than loops, Python runs the very same function.
"""

from __future__ import annotations

import ctypes
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
@njit
def take(step, number):
    """Run the launches of the step at an address, with a number for those that have it."""
    words = at_uint64(step)
    launches, places = words[0], words[1]
    for k in range(launches, launches + places):
        at_{precision}(words[np.uint64(3) + k])[0] = number
    for k in range(launches):
        run(words[np.uint64(3) + k])


@njit
def result(step, k):
    """What the last launch of a step has reduced."""
    return at_float64(at_uint64(step)[2])[np.uint64(k)]


@njit
{function}

def loop(frame):
    words = at_uint64(frame)
    numbers = at_float64(words[{steps}])
    results = {name}({arguments})
    for k in range(len(results)):
        numbers[np.uint64(k)] = results[k]
'''


class Step:
    """Launches that run one after the other.

    Args:
        launches: prepared loops, or anything that is called likewise. number: name of the constant
            that changes from run to run, of those launches that have it.
    """

    def __init__(self, launches: Sequence[Any], number: str = "") -> None:
        self.launches, self.number = list(launches), number
        self.results: tuple[float, ...] = ()

    def __call__(self) -> tuple[float, ...]:
        """Run all; returns what the last one reduces."""
        if self.launches and self.is_compiled:
            last, (address, _) = self.launches[-1], self.words.buffer_info()
            list_function(last.precision)(address + 8 * HEAD, len(self.launches))
            self.results = tuple(last.results)
        else:
            for launch in self.launches:
                self.results = launch()
        return self.results

    @cached_property
    def is_compiled(self) -> bool:
        """Whether every launch has a frame."""
        return all(type(launch) is Launch for launch in self.launches)

    @cached_property
    def words(self) -> array:
        """Numbers of launches and of places of the constant, address of the results, and addresses
        of all launches and places, for compiled code."""
        launches = self.launches
        places = [place for launch in launches for place in launch.number_places(self.number)]
        results = launches[-1].results_address if launches else 0
        head = [len(launches), len(places), results]
        return array("Q", [*head, *(launch.address for launch in launches), *places])


def take(step: Step, number: float) -> None:
    """Run a step with its number."""
    for launch in step.launches:
        has_number = step.number in launch.places
        step.results = launch(**{step.number: number}) if has_number else launch()


def result(step: Step, k: int) -> float:
    """What the last launch of a step has reduced, number k."""
    return step.results[k]


def run_routine(
    function: Callable[..., tuple], steps: Sequence[Step], numbers: Sequence[float], precision: str
) -> tuple[float, ...]:
    """Results of a routine.

    Args:
        function: plain function of so many steps and then numbers, which returns numbers, no more
            of them than it takes; it reads no global names but `take` and `result`.
    """
    if not all(step.is_compiled for step in steps):
        return function(*steps, *numbers)
    words, values = [step.words for step in steps], array("d", numbers)
    frame = array("Q", [word.buffer_info()[0] for word in (*words, values)])
    _compiled(function, len(steps), precision)(frame.buffer_info()[0])
    return tuple(values)


@cache
def _compiled(function: Any, steps: int, precision: str) -> Callable[[int], None]:
    """Foreign function of the address of a frame."""
    count = function.__code__.co_argcount
    given = [f"words[{k}]" for k in range(steps)] + [f"numbers[{k}]" for k in range(count - steps)]
    text = (NATIVE + RUN + _TEXT).format(
        precision=precision,
        function=inspect.getsource(function),
        steps=steps,
        name=function.__name__,
        arguments=", ".join(given),
    )
    return ctypes.PYFUNCTYPE(None, ctypes.c_uint64)(folder.entry(text, is_fast=False))
