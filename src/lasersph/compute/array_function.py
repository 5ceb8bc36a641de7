"""Functions of arrays and whole numbers, compiled, stored and called as loops are.

What is no loop over rows with a formula, such as the scan for neighbors, is a text with functions
as `native_functions` understands them. One of them is called for each of some blocks, with the
number of the block first; its arrays and numbers stand in a frame, as those of a launch do.
"""

from __future__ import annotations

from array import array
from functools import lru_cache
from typing import Any

import numpy as np

from lasersph.compute import cache
from lasersph.compute.arguments import address
from lasersph.compute.generate import NATIVE
from lasersph.compute.launch import HEAD_WORDS, start_function


class ArrayFunction:
    """A function of a text.

    Args:
        text: functions. name: of the one to call, which takes the number of a block and any
            arrays and whole numbers.
        precision: of `real` in the text.
    """

    def __init__(self, text: str, name: str, precision: str) -> None:
        self._text, self._name = NATIVE.format(precision=precision) + text, name
        self._start = start_function(precision)
        self._entries: dict[tuple, int] = {}

    def __call__(self, *given: Any, blocks: int = 1, threads: int = 1) -> None:
        """Run it for so many blocks on so many threads; see `frame`."""
        self.run(self.frame(*given, blocks=blocks, threads=threads))

    def run(self, frame: array) -> None:
        """Run it with the arguments in a frame, whose arrays the caller holds."""
        self._start(frame.buffer_info()[0])

    def frame(self, *given: Any, blocks: int = 1, threads: int = 1) -> array:
        """Arguments of a call: addresses and shapes of arrays, and whole numbers.

        Raises:
            ValueError: an array is not contiguous.
        """
        # the head of a launch that reduces nothing
        kinds: list[tuple[int, int] | None] = []
        words = [0, blocks, threads, *[0] * (HEAD_WORDS - 3)]
        for one in given:
            if not isinstance(one, np.ndarray):
                kinds.append(None)
                words.append(one)
                continue
            if not one.flags.c_contiguous:
                raise ValueError(f"an array of shape {one.shape} is not contiguous")
            kinds.append((one.dtype.num, one.ndim))
            words.append(address(one))
            words += one.shape
        # compiled for the types and axes of its arrays
        key = tuple(kinds)
        entry = self._entries.get(key)
        if entry is None:
            entry = self._entries[key] = cache.entry(self._text + self._loop(given))
        words[0] = entry
        return array("Q", words)

    def _loop(self, given: tuple) -> str:
        """Text of the loop that takes such arguments from a frame."""
        # words in the order of `frame`
        arguments, place = ["block"], 0
        for one in given:
            if not isinstance(one, np.ndarray):
                arguments.append(f"words[{place}]")
                place += 1
                continue
            shape = "".join(f"np.int64(words[{place + k + 1}]), " for k in range(one.ndim))
            arguments.append(f"carray(at_{one.dtype.name}(words[{place}]), ({shape}))")
            place += one.ndim + 1
        lines = ["words = at_uint64(frame)", f"{self._name}({', '.join(arguments)})"]
        head = "\n\ndef loop(block, count, frame):"
        return "\n    ".join([head, *lines]) + "\n"


@lru_cache(maxsize=64)
def array_function(text: str, name: str, precision: str = "float64") -> ArrayFunction:
    """The function of that name of a text, one for the whole process."""
    return ArrayFunction(text, name, precision)
