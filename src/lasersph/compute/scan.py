"""Text of the neighbor search: sorting by cell, scanning and storing, one function each.

For each target and each level of cells, rows of cells along the first axis are cut to the sphere of
the level's largest search radius, and their particles, contiguous in memory, are scanned without
branches: first the tests r_ij < mean(l_i, l_j) of a piece, in vector instructions, then each
candidate is written and the place moves on only where its test holds and j != i.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import NamedTuple

from lasersph.compute.generate import BLOCK
from lasersph.compute.source import SourceUnit

_HEAD = """ZERO = np.uint64(0)
ONE = np.uint64(1)
BLOCK = np.uint64({block})
PIECE = np.uint64(CAPACITY)


"""
_SORT = '''def sort(_, position, members, low, inverse, shape, cell, start, order):
    """Stable counting sort of the members of a level by cell; start has one entry more."""
    for c in range(start.size):
        start[np.uint64(c)] = 0
    for m in range(members.size):
        j = np.uint64(members[m])
        c = ZERO
{cell_index}
        cell[m] = c
        start[c + ONE] += np.uint32(1)
    for c in range(start.size - 1):
        start[np.uint64(c) + ONE] += start[np.uint64(c)]
    for m in range(members.size):
        c = np.uint64(cell[m])
        order[np.uint64(start[c])] = members[m]
        start[c] += np.uint32(1)
    for c in range(start.size - 1, 0, -1):
        start[np.uint64(c)] = start[np.uint64(c) - ONE]
    start[0] = 0
'''
_SCAN = '''{mean}

def scan(block, start, used, count, targets, support, sorted_position, sorted_support, order,
         starts, first_cell, first_member, low, high, inverse, shape, largest, smallest, widening,
         period, scratch, ends):
    """Neighbors of the targets of block `start + block` into a row of scratch; used[block]: number
    of pairs, or the largest integer where scratch is too short."""
    number, slack = start + block, widening[0]
    capacity = np.uint64(scratch.shape[1])
    slot = number % np.uint64(scratch.shape[0])
    near = scratch_uint64()
    place = ZERO
    for i in range(number * BLOCK, min((number + ONE) * BLOCK, count)):
        li = support[i]
{load_targets}
        for level in range(largest.size):
            radius = f__mean_of(li, largest[level]) + slack
            size = real(1.0) / inverse[level]
            cells = first_cell[level]
            member = first_member[level]
{images}
        ends[i] = place
    used[block] = place
'''
_STORE = '''def store(block, start, count, bases, scratch, ends, row_start, neighbor):
    """Copy scratch to its place in the list and set the row pointers."""
    number = start + block
    slot = number % np.uint64(scratch.shape[0])
    base = bases[block]
    used = ZERO
    for i in range(number * BLOCK, min((number + ONE) * BLOCK, count)):
        row_start[i + ONE] = base + ends[i]
        used = ends[i]
    for p in range(ZERO, used):
        neighbor[base + p] = scratch[slot, p]
'''


def _text(text: str, **parts: str) -> str:
    return (_HEAD + text).format(block=BLOCK, **parts)


class ScanText(NamedTuple):
    """Text of the function `scan`, and the names that it was made from (`source.is_current`)."""

    text: str
    watched: tuple


def _cell_number(dimension: int, shape: str) -> str:
    """Text of the number of a cell with the index c0, c1, ...: the first axis runs fastest."""
    # Horner's rule, from the slowest axis to the fastest
    number = f"c{dimension - 1}"
    for k in reversed(range(dimension - 1)):
        number = f"({number}) * {shape.format(k=k)} + c{k}"
    return number


@cache
def sort_text(dimension: int) -> str:
    """Text of the function `sort`."""
    # index along each axis, at most that of the last cell, which takes the upper face
    cell = [
        f"c{k} = min(int((position[{k}, j] - low[{k}]) * inverse[0]), shape[{k}] - 1)"
        for k in range(dimension)
    ]
    index = _cell_number(dimension, "shape[{k}]")
    lines = indented(2, [*cell, f"c = np.uint64({index})"])
    return _text(_SORT, cell_index=lines)


@cache
def store_text() -> str:
    """Text of the function `store`."""
    return _text(_STORE)


def scan_text(dimension: int, mean: Callable, periodic: tuple[bool, ...]) -> ScanText:
    """Text of the function `scan`."""
    # the mean and what it calls become functions of the same file
    unit = SourceUnit()
    name, _ = unit.add(mean, (("real", ()), ("real", ())))
    # walk over images and rows of cells, and within it the candidates
    loops, depth = images(dimension, periodic)
    text = _text(
        _SCAN,
        mean="\n".join(f"{text}\n" for text in unit.texts),
        load_targets=indented(2, [f"x{k} = targets[{k}, i]" for k in range(dimension)]),
        images=indented(3, loops) + "\n" + indented(3 + depth, _pieces(dimension, periodic)),
    )
    return ScanText(text.replace("f__mean_of(", f"{name}("), unit.watched())


def images(dimension: int, periodic: tuple[bool, ...]) -> tuple[list[str], int]:
    """Loops over the periodic images of the target and over rows of cells, and their depth.

    Inside, `first` to `last` are the candidates of a row of cells.
    """
    lines: list[str] = []
    depth = 0

    def put(text: str) -> None:
        lines.append("    " * depth + text)

    for k in reversed(range(dimension)):
        # the target and its images one period away on either side
        if periodic[k]:
            put(f"for image{k} in range(-1, 2):")
            depth += 1
            put(f"shift{k} = real(image{k}) * period[{k}]")
            put(f"y{k} = x{k} + shift{k}")
        else:
            put(f"y{k} = x{k}")
        # leave out what cannot reach the level's box
        put(f"if y{k} - radius > high[level, {k}] or y{k} + radius < low[level, {k}]:")
        put("    continue")
        # cells in reach along this axis, and the distance from the target to each
        if k:
            put(f"a{k} = max((y{k} - radius - low[level, {k}]) * inverse[level], real(0.0))")
            put(f"b{k} = (y{k} + radius - low[level, {k}]) * inverse[level]")
            put(f"for c{k} in range(int(a{k}), min(int(b{k}), shape[level, {k}] - 1) + 1):")
            depth += 1
            put(f"edge = low[level, {k}] + real(c{k}) * size")
            put(f"gap{k} = max(max(edge - y{k}, y{k} - edge - size) - slack, real(0.0))")
    # sphere cut by a row of cells: half = sqrt(r^2 - sum_k gap_k^2) along the first axis
    gaps = "".join(f" - gap{k} * gap{k}" for k in range(1, dimension))
    put(f"remaining = radius * radius{gaps}")
    put("if remaining <= real(0.0):")
    put("    continue")
    put("half = math.sqrt(remaining) + slack")
    # first and last cell of the row within that half length
    put("a0 = int(max((y0 - half - low[level, 0]) * inverse[level], real(0.0)))")
    put("if y0 + half < low[level, 0] or a0 >= shape[level, 0]:")
    put("    continue")
    put("b0 = min(int((y0 + half - low[level, 0]) * inverse[level]), shape[level, 0] - 1)")
    # members of the cells from first to last lie side by side in memory
    put("c0 = 0")
    put(f"base = cells + np.uint64({_cell_number(dimension, 'shape[level, {k}]')})")
    put("first = member + np.uint64(starts[base + np.uint64(a0)])")
    put("last = member + np.uint64(starts[base + np.uint64(b0) + ONE])")
    return lines, depth


def _pieces(dimension: int, periodic: tuple[bool, ...]) -> list[str]:
    """Tests of the candidates from `first` to `last`, piece by piece."""
    # as many places as there are candidates, then piece by piece: all tests, all writes
    position = [f"sorted_position[{k}, k]" for k in range(dimension)]
    return [
        "if place + (last - first) > capacity:",
        "    used[block] = np.uint64(0xFFFFFFFFFFFFFFFF)",
        "    return",
        "for piece in range(first, last, PIECE):",
        "    length = min(last - piece, PIECE)",
        "    if smallest[level] == largest[level]:",  # the same limit for all: nothing to look up
        "        bound = f__mean_of(li, largest[level])",
        "        bound *= bound",
        "        for q in range(length):",
        "            k = piece + q",
        *("            " + line for line in distance(position, periodic)[:-1]),
        "            near[q] = ONE if square < bound else ZERO",
        "    else:",
        "        for q in range(length):",
        "            k = piece + q",
        *("            " + line for line in distance(position, periodic)),
        "            near[q] = ONE if square < limit * limit else ZERO",
        "    for q in range(length):",
        "        j = order[piece + q]",
        "        scratch[slot, place] = j",
        "        place += near[q] & np.uint64(np.uint64(j) != i)",
    ]


def distance(position: list[str], periodic: tuple[bool, ...]) -> list[str]:
    """Lines for the squared distance to candidate k and the limit of that pair."""
    # squared distance to the image that is looked at
    differences = [
        f"d{k} = (x{k} - {text})" + (f" + shift{k}" if periodic[k] else "")
        for k, text in enumerate(position)
    ]
    squares = " + ".join(f"d{k} * d{k}" for k in range(len(position)))
    return [*differences, f"square = {squares}", "limit = f__mean_of(li, sorted_support[k])"]


def indented(level: int, lines: list[str]) -> str:
    """Lines of a block at a level of indentation."""
    return "\n".join("    " * level + line for line in lines)
