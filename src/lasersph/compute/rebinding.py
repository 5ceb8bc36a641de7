"""Binding of a launch to other arrays of the same kinds, in compiled code.

A step calls hundreds of loops, each with arrays of its own; to look at these in Python takes longer
than a loop over a thousand particles. What is checked of them at the first call is checked at each
one: types, shapes, lengths, that the last axis is contiguous, that active rows exist, and that no
output is read at neighbors. Where something differs, the launch is left alone, and whoever asks
binds anew, with messages.

Arrays are told by the addresses of NumPy's objects, whose structure (data, number of axes, lengths,
strides and type) NumPy documents as `PyArrayObject_fields`.
"""

from __future__ import annotations

import ctypes
from array import array
from collections.abc import Callable
from functools import cache
from math import prod
from typing import Any

import numpy as np

from lasersph.compute import cache as folder
from lasersph.compute.generate import NATIVE
from lasersph.compute.launch import HEAD_WORDS, RUN, Bound, Launch, Launcher
from lasersph.compute.signature import Call, Signature

HEAD, ENTRY = 7, 8
"""Words of the head of a plan, and of its entry for each field, output and table."""
ONLY_BINDS = 6
"""Place in the head of what tells that a launch is not run when it is bound."""
_INDEX, _OFFSET = np.dtype(np.uint32), np.dtype(np.uint64)
_MANY = 2**62
ANY, ROW, TOTAL, PAIR, OUT, TABLE = range(6)
"""Items that an array has entries for; ANY where only the lengths of others decide."""
READ_AT_NEIGHBORS = 8

TEXT = f'''
DATA, NDIM, SHAPE, STRIDES, DTYPE = (np.uint64(k) for k in (16, 24, 32, 40, 56))
WORD = np.uint64(8)


def word(address):
    return at_uint64(address)[ZERO]


def length(one):
    """Entries along the last axis."""
    axes = np.uint64(at_uint32(one + NDIM)[ZERO])
    return at_uint64(word(one + SHAPE))[axes - ONE]


def is_same_kind(one, entry):
    axes = np.uint64(at_uint32(one + NDIM)[ZERO])
    if word(one + DTYPE) != entry[0] or axes != entry[1]:
        return False
    shape, strides = at_uint64(word(one + SHAPE)), at_uint64(word(one + STRIDES))
    for k in range(axes - ONE):
        if shape[k] != entry[ONE + ONE + k]:
            return False
    return strides[axes - ONE] == entry[4] or shape[axes - ONE] <= ONE


def put(one, entry, frame):
    """Write the addresses of an array's components, and the length of a table."""
    axes, place = np.uint64(at_uint32(one + NDIM)[ZERO]), entry[7]
    data, strides = word(one + DATA), at_uint64(word(one + STRIDES))
    if axes == ONE:
        frame[place] = data
    elif axes == ONE + ONE:
        for k in range(entry[2]):
            frame[place + k] = data + k * strides[0]
    else:
        for a in range(entry[2]):
            for b in range(entry[3]):
                frame[place + a * entry[3] + b] = data + a * strides[0] + b * strides[1]
    if entry[5] == np.uint64({TABLE}):
        frame[place + entry[6]] = length(one)


def loop(plan_address, ones_address, frame_address):
    """Bind and run; the first word of `ones` tells whether that was possible."""
    plan, ones, frame = at_uint64(plan_address), at_uint64(ones_address), at_uint64(frame_address)
    ones[0] = ZERO
    count, block, capacity, is_values = plan[0], plan[1], plan[2], plan[3]
    active, row_start, row_end, neighbor, support = ones[1], ones[2], ones[3], ones[4], ones[5]
    fields, entries = ones_address + np.uint64(48), plan_address + np.uint64({8 * HEAD})
    there, total, pairs, known = ZERO, ZERO, ZERO, False
    place = np.uint64({HEAD_WORDS}) + (ONE if active else ZERO)
    if row_start:
        if word(row_start + DTYPE) != plan[4] or word(neighbor + DTYPE) != plan[5]:
            return
        there = length(row_start) - ONE
        pairs = at_uint64(word(row_start + DATA))[there]
        total = length(support) if support else there
        if pairs > length(neighbor) or total < there:
            return
        # a row ends where the list says, or with the next one
        frame[place], frame[place + ONE] = word(row_start + DATA), word(row_start + DATA) + WORD
        if row_end:
            if word(row_end + DTYPE) != plan[4] or length(row_end) < there:
                return
            frame[place + ONE] = word(row_end + DATA)
        frame[place + ONE + ONE] = word(neighbor + DATA)
        known = True
    for k in range(count):
        one = word(fields + k * np.uint64(8))
        entry = at_uint64(entries + k * np.uint64({8 * ENTRY}))
        if not is_same_kind(one, entry):
            return
        if not known and entry[5] == np.uint64({OUT}):
            there, known = length(one), True
    if not known:
        for k in range(count):
            one = word(fields + k * np.uint64(8))
            entry = at_uint64(entries + k * np.uint64({8 * ENTRY}))
            if entry[5] != np.uint64({TABLE}):
                if known and length(one) != there:
                    return
                there, known = length(one), True
    for k in range(count):
        one = word(fields + k * np.uint64(8))
        entry = at_uint64(entries + k * np.uint64({8 * ENTRY}))
        role = entry[5] & np.uint64(7)
        least = ZERO
        if role == np.uint64({ROW}) or (role == np.uint64({OUT}) and not is_values):
            least = there
        elif role == np.uint64({TOTAL}):
            least = total
        elif role == np.uint64({PAIR}) or role == np.uint64({OUT}):
            least = pairs
        if length(one) < least:
            return
        if role == np.uint64({OUT}):
            for other in range(count):
                far = at_uint64(entries + other * np.uint64({8 * ENTRY}))
                if far[5] >= np.uint64({READ_AT_NEIGHBORS}):
                    if word(fields + other * np.uint64(8)) == one:
                        return
    rows = there
    if active:
        rows = length(active)
        if word(active + DTYPE) != plan[5]:
            return
        numbers = at_uint32(word(active + DATA))
        largest = np.uint32(0)
        for k in range(rows):
            largest = max(largest, numbers[k])
        if rows and np.uint64(largest) >= there:
            return
        frame[{HEAD_WORDS}] = word(active + DATA)
    if (there + block - ONE) // block > capacity:
        return
    frame[1], frame[3] = (rows + block - ONE) // block, rows
    for k in range(count):
        entry = at_uint64(entries + k * np.uint64({8 * ENTRY}))
        if entry[6]:
            put(word(fields + k * np.uint64(8)), entry, frame)
    ones[0] = ONE
    if plan[{ONLY_BINDS}] == ZERO:
        run(frame_address)
'''


class Rebound:
    """Binding of a launch to other arrays at each call.

    The launch holds this, and not the other way round: in a ring both, and the arrays that a
    launch holds, would stay until Python looks for rings, which can take hundreds of steps.

    Args:
        launch: of `bound`, a call of the same kinds. signature: of all such calls. call: the same
            call.

    Attributes:
        key: signature and kinds of a launch that is bound again, see `only_binds`.
    """

    key: tuple | None = None
    _values: tuple | None = None

    def __init__(self, launch: Launch, bound: Bound, signature: Signature, call: Call) -> None:
        compiled = bound.compiled
        self.watched = compiled.watched
        # for each array the number of entries that it must have, by where it is read
        roles = {place: (ROW, TOTAL, PAIR)[need] for place, need, _ in signature.needs}
        at_neighbors = {place for place, _ in signature.neighbors}
        # place of each field in the frame, in the order that the compiled loop reads
        place, places = HEAD_WORDS + len(bound.lists), {}
        for symbol, one in zip(compiled.arrays, bound.fields, strict=True):
            places[symbol] = place
            place += prod(one.shape[:-1])
        by_symbol = dict(zip(compiled.arrays, bound.fields, strict=True))
        # plan: fields in the order of the signature, then outputs and tables
        words: list[int] = []
        for k, symbol in enumerate(signature.symbols):
            role = roles.get(k, ANY) + READ_AT_NEIGHBORS * (k in at_neighbors)
            words += _entry(by_symbol[symbol], role, places[symbol])
        for one in bound.outs:
            if one is not None:
                words += _entry(one, OUT, place)
                place += prod(one.shape[:-1])
        by_name = dict(zip(compiled.tables, bound.tables, strict=True))
        for name in signature.tables:
            words += _entry(by_name[name], TABLE, place)
            place += prod(by_name[name].shape[:-1]) + 1
        # what blocks reduce has room for the rows that there are at the first call; where there
        # are more now, a recorded launch may come to run them all
        capacity = -(-bound.listed // compiled.block) if compiled.reductions else _MANY
        is_values = call.shape == "pair_values"
        head = [len(words) // ENTRY, compiled.block, capacity, is_values]
        self._plan = array("Q", [*head, id(_OFFSET), id(_INDEX), 0, *words])
        self._call = rebinding_function(compiled.real.name)
        self._places = self._plan.buffer_info()[0], launch.address
        self._names = signature.numbers + (("period",) if signature.geometry else ())

    def only_binds(self, key: tuple) -> None:
        """Bind without running from now on, for a launch of its own that is run later."""
        self.key, self._plan[ONLY_BINDS] = key, 1

    def run(self, launch: Launch, ones: array, values: tuple) -> bool:
        """Run with the arrays at some addresses, 0 first; False where they are of other kinds.

        Args:
            launch: that this was made for. values: of the constants that are numbers, with the
                period of the list.
        """
        # iterations change the numbers of recorded launches where they lie
        if self.key is not None or values != self._values:
            launch.set(dict(zip(self._names, values, strict=True)))
            self._values = values
        plan, frame = self._places
        self._call(plan, ones.buffer_info()[0], frame)
        return bool(ones[0])


def rebindable(launcher: Launcher, bound: Bound, signature: Signature, call: Call) -> Launch:
    """Launch of a call that can take other arrays; it does not hold those that it has."""
    launch = launcher.launch(bound, holds=False)
    launch.rebound = Rebound(launch, bound, signature, call)
    return launch


def _entry(one: Any, role: int, place: int) -> list[int]:
    """Words of a plan for one array."""
    lead = (*one.shape[:-1], 0, 0)[:2]
    return [id(one.dtype), one.ndim, *lead, one.itemsize, role, prod(one.shape[:-1]), place]


@cache
def has_known_layout() -> bool:
    """Whether NumPy's arrays lie in memory as `TEXT` reads them; else calls are bound in Python."""
    # a view with an offset, two axes and strides of its own tells all fields apart
    one = np.zeros((2, 3), np.float32)[:, 1:]
    # address of the data, number of axes and type, as the structure has them
    words = (ctypes.c_uint64 * 8).from_address(id(one))
    axes = ctypes.c_uint32.from_address(id(one) + 8 * 3).value
    if (words[2], axes, words[7]) != (one.ctypes.data, one.ndim, id(one.dtype)):
        return False
    # lengths and strides, behind their addresses
    shape, strides = ((ctypes.c_uint64 * 2).from_address(words[k]) for k in (4, 5))
    return (*shape, *strides) == (*one.shape, *one.strides)


@cache
def rebinding_function(precision: str) -> Callable[[int, int, int], None]:
    """Foreign function that binds and runs, of the addresses of a plan, of arrays' addresses and of
    a frame."""
    return folder.function((NATIVE + RUN).format(precision=precision) + TEXT, 3)
