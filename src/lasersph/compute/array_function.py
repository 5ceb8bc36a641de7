"""Functions of arrays and whole numbers, compiled, stored and called as loops are.

What is no loop over rows with a formula, such as the scan for neighbors, is a text with functions
of Numba's language. One of them is called for each of some blocks, with the number of the block
first; its arrays and numbers stand in a frame, as those of a launch do.
"""

from __future__ import annotations

from array import array
from functools import lru_cache
from typing import Any

import numpy as np

from lasersph.compute import cache
from lasersph.compute.arguments import address
from lasersph.compute.generate import DISPATCH, NATIVE
from lasersph.compute.launch import HEAD_WORDS, start_function


class BoundFunction:
    """A function with its arguments; called, it runs all blocks."""

    def __init__(self, function: ArrayFunction, head: list[int], given: tuple) -> None:
        # the head of a launch that reduces nothing, then addresses with shapes, and numbers
        words = [*head, *[0] * (HEAD_WORDS - len(head))]
        for one in given:
            if isinstance(one, np.ndarray):
                words += (address(one), *one.shape)
            else:
                words.append(int(one))
        self._frame, self._given, self._start = array("Q", words), given, function.start

    def __call__(self) -> None:
        """Run it."""
        self._start(self._frame.buffer_info()[0])


class ArrayFunction:
    """A function of a text.

    Args:
        text: functions, each with the decorator `generate.INNER`. name: of the one to call, which
            takes the number of a block and any arrays and whole numbers.
        precision: of `real` in the text.
    """

    def __init__(self, text: str, name: str, precision: str) -> None:
        self.start = start_function(precision)
        self._text, self._name = NATIVE.format(precision=precision) + text, name
        self._entries: dict[tuple, int] = {}

    def bind(self, *given: Any, blocks: int = 1, threads: int = 1) -> BoundFunction:
        """The function with arguments, for so many blocks on so many threads.

        Raises:
            ValueError: an array is not contiguous.
        """
        # compiled for the types and axes of its arrays
        kinds = tuple([(one.dtype, one.ndim) if _is_array(one) else None for one in given])
        entry = self._entries.get(kinds)
        if entry is None:
            entry = self._entries[kinds] = cache.entry(self._text + self._loop(kinds))
        return BoundFunction(self, [entry, blocks, threads], given)

    def __call__(self, *given: Any, blocks: int = 1, threads: int = 1) -> None:
        """Run it once."""
        self.bind(*given, blocks=blocks, threads=threads)()

    def _loop(self, kinds: tuple) -> str:
        """Text of the loop that takes the arguments from a frame."""
        arguments, place = ["begin"], 0
        for kind in kinds:
            if kind is None:
                arguments.append(f"words[{place}]")
                place += 1
                continue
            dtype, axes = kind
            shape = "".join(f"np.int64(words[{place + k + 1}]), " for k in range(axes))
            arguments.append(f"carray(at_{dtype.name}(words[{place}]), ({shape}))")
            place += axes + 1
        lines = [*DISPATCH, "words = at_uint64(frame)", f"{self._name}({', '.join(arguments)})"]
        head = "\n\nONE = np.uint64(1)\n\n\ndef loop(begin, end, threads, count, frame):"
        return "\n    ".join([head, *lines]) + "\n"


def _is_array(one: Any) -> bool:
    """Whether an argument is an array, whose elements lie side by side.

    Raises:
        ValueError: they do not.
    """
    if not isinstance(one, np.ndarray):
        return False
    if not one.flags.c_contiguous:
        raise ValueError(f"an array of shape {one.shape} is not contiguous")
    return True


@lru_cache(maxsize=64)
def array_function(text: str, name: str, precision: str = "float64") -> ArrayFunction:
    """The function of that name of a text, one for the whole process."""
    return ArrayFunction(text, name, precision)
