"""Text of the neighbor search on the graphics card: a thread per target.

The walk over levels, periodic images and rows of cells is that of `scan`; it is made twice, first
to count a row's neighbors, then to store them, so that each row has its place and the order within
it is that of the processor's lists.
"""

from __future__ import annotations

from collections.abc import Callable

from lasersph.compute.cuda_text import HEAD, INNER, supported
from lasersph.compute.scan import distance, images, indented
from lasersph.compute.source import SourceUnit

_SCAN = '''{mean}

@cuda.jit(cache=True)
def scan(count, {targets}, support, {sorted_positions}, sorted_support, order, starts, first_cell,
         low, high, inverse, shape, largest, slack, period, row_start, counts, neighbor, stores):
    """Count the neighbors of each target, or store them from row_start on."""
    member = ZERO
    step = np.uint64(cuda.gridsize(1))
    i = np.uint64(cuda.grid(1))
    while i < count:
        place = row_start[i] if stores else ZERO
        li = support[i]
{load_targets}
        for level in range(largest.size):
            reach = f__mean_of(li, largest[level]) + slack
            size = real(1.0) / inverse[level]
            cells = first_cell[level]
{images}
        if not stores:
            counts[i] = np.uint32(place)
        i += step
'''


def cuda_scan_text(
    precision: str, dimension: int, mean: Callable, periodic: tuple[bool, ...]
) -> str:
    """Text of the module with `scan`."""
    unit = SourceUnit()
    name, _ = unit.add(mean, (("real", ()), ("real", ())))
    loops, depth = images(dimension, periodic)
    candidates = [f"sorted_{k}[k]" for k in range(dimension)]
    loops += [
        "    " * depth + line
        for line in (
            "for k in range(first, last):",
            *("    " + line for line in distance(candidates, periodic)),
            "    if square < limit * limit and np.uint64(order[k]) != i:",
            "        if stores:",
            "            neighbor[place] = order[k]",
            "        place += ONE",
        )
    ]
    text = (HEAD + _SCAN).format(
        precision=precision,
        mean="\n".join(f"{INNER}\n{text}\n" for text in unit.texts),
        targets=", ".join(f"target_{k}" for k in range(dimension)),
        sorted_positions=", ".join(f"sorted_{k}" for k in range(dimension)),
        load_targets=indented(2, [f"x{k} = target_{k}[i]" for k in range(dimension)]),
        images=indented(3, loops),
    )
    return supported(text.replace("f__mean_of(", f"{name}("))
