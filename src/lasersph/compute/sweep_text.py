"""Text of the sweeps: arranging pairs for them, and the loops of one sweep.

`TILES` has the functions that arrange pairs; `sweep_text` writes that of one sweep from a plain
function.
"""

from __future__ import annotations

from collections.abc import Callable

from lasersph.compute.source import SourceUnit

ROWS = 4
"""Rows of a tile: of a chunk that shares its columns."""

_HEAD = f"""
ZERO = np.uint64(0)
ONE = np.uint64(1)
ROWS = np.uint64({ROWS})
"""
TILES = f'''{_HEAD}

def touching(_, size, row_start, neighbor, touches):
    """touches[a, b] is 1 where a row of block a has a neighbor in block b."""
    for i in range(np.uint64(row_start.size - 1)):
        for p in range(row_start[i], row_start[i + ONE]):
            touches[i // size, np.uint64(neighbor[p]) // size] = 1


def place(i, j, size, color):
    """0 where j comes before the chunk of i, 1 where after it, 2 where it belongs to it."""
    here, there = i // size, j // size
    if here != there:
        return ZERO if color[there] < color[here] else ONE
    c, d = i // ROWS, j // ROWS
    return ONE + ONE if c == d else (ZERO if d < c else ONE)


def count_columns(_, size, color, row_start, neighbor, seen, columns):
    """columns[k, c]: particles before (k = 0) and after (1) that chunk c sees; `seen` is 0."""
    count = np.uint64(row_start.size - 1)
    for i in range(count):
        c = i // ROWS
        for p in range(row_start[i], row_start[i + ONE]):
            j = np.uint64(neighbor[p])
            k = place(i, j, size, color)
            if k < ONE + ONE and seen[j] != np.uint32(c + ONE):
                seen[j] = np.uint32(c + ONE)
                columns[k, c] += ONE


def fill(_, side, size, color, row_start, neighbor, weights, slot, start, column, value, inner,
         total, after):
    """Tiles before (side = 0) or after (1) the chunks; with the latter, weights within chunks.

    Slots of the particles are 0 at first."""
    count = np.uint64(row_start.size - 1)
    for r in range(ZERO, count, ROWS):
        c = r // ROWS
        begin = start[c if side == ZERO else np.uint64(start.size - 2) - c]
        end = begin
        for i in range(r, min(r + ROWS, count)):
            for p in range(row_start[i], row_start[i + ONE]):
                j, g = np.uint64(neighbor[p]), weights[p]
                k = place(i, j, size, color)
                if k == side:
                    q = slot[j]
                    if q < begin or q >= end or column[q] != neighbor[p]:
                        q = end
                        end += ONE
                        slot[j], column[q] = q, neighbor[p]
                        for lane in range(ROWS):
                            value[q, lane] = 0.0
                    value[q, i - r] += g
                elif k <= ONE or side == ZERO or i == j:
                    continue
                elif j < i:
                    l = i - r
                    inner[c, l * (l - ONE) // (ONE + ONE) + (j - r)] += g
                total[i] += g
                if k == ONE or j > i and k > ONE:
                    after[i] += g
'''
_SWEEP = '''{head}

{functions}
def sweep(number, blocks, size, count, partial, start, column, value, inner, {names}):
    """A block of one color, which reads nothing that another writes; chunk after chunk."""
    b = blocks[number]
    first = np.uint64(b) * size // ROWS
    last = (min((np.uint64(b) + ONE) * size, count) + ROWS - ONE) // ROWS
    chunks = np.uint64(start.size - 1)
    {sums} = {zeros}
    for k in range(last - first):
        c = {chunk}
        q0 = {stored}
        {totals} = {lanes}
        for q in range(start[q0], start[q0 + ONE]):
            v = a_value[np.uint64(column[q])]
{adding}
{rows}
{partials}
'''


_WRITTEN: dict[tuple, tuple[SourceUnit, str]] = {}
"""Texts by what they were written from, with what they have read: solvers that follow each other
ask for the same few."""


def sweep_text(
    function: Callable,
    roles: dict[str, str],
    reduces: int,
    outputs: int,
    *,
    backward: bool,
) -> str:
    """Text of the function `sweep`.

    Args:
        roles: of each argument of `function`: "total", "field" or "constant".
        reduces: how many of the results, the last ones, are summed over the rows instead of stored.
        outputs: how many results are stored; the first is what neighbors read.
    """
    key = (function, tuple(roles.items()), reduces, outputs, backward)
    unit, text = _WRITTEN.get(key, (None, ""))
    # written anew where a name in the function means something else now
    if unit is None or not unit.is_current():
        unit = SourceUnit()
        text = _written(unit, function, roles, reduces, outputs, backward=backward)
        _WRITTEN[key] = unit, text
    return text


def _written(
    unit: SourceUnit,
    function: Callable,
    roles: dict[str, str],
    reduces: int,
    outputs: int,
    *,
    backward: bool,
) -> str:
    """Text of the function `sweep`, with the functions that it calls in `unit`."""
    # the function of a row, and where its arguments come from
    name, _ = unit.add(function, (("real", ()),) * len(roles))
    fields = [f"a_{field}" for field, role in roles.items() if role == "field"]
    constants = [field for field, role in roles.items() if role == "constant"]
    outs = ["a_value", *(f"o_{k}" for k in range(1, outputs))]
    # rows of a chunk in the order of the sweep, each after those it depends on
    lanes = range(ROWS)
    rows = [f"y{lane} = real(0.0)" for lane in lanes]
    for lane in reversed(lanes) if backward else lanes:
        rows += _row(lane, name, roles, constants, outs, reduces, backward=backward)
    return _SWEEP.format(
        head=_HEAD,
        functions="\n".join(f"{part}\n" for part in unit.texts),
        names=", ".join([*outs, *fields, "numbers"]),
        sums=", ".join(f"r{k}" for k in range(reduces)) or "_",
        zeros=", ".join("real(0.0)" for _ in range(reduces)) or "ZERO",
        chunk="last - ONE - k" if backward else "first + k",
        stored="chunks - ONE - c" if backward else "c",
        totals=", ".join(f"s{lane}" for lane in lanes),
        lanes=", ".join("real(0.0)" for _ in lanes),
        adding="\n".join(f"{12 * ' '}s{lane} += real(value[q, {lane}]) * v" for lane in lanes),
        rows="\n".join(f"{8 * ' '}{line}" for line in rows),
        partials="\n".join(f"    partial[b, {k}] = r{k}" for k in range(reduces)),
    )


def _row(
    lane: int,
    name: str,
    roles: dict[str, str],
    constants: list[str],
    outs: list[str],
    reduces: int,
    *,
    backward: bool,
) -> list[str]:
    """Lines of one row of a chunk: the rest of its sum, its results, where they go."""
    # add the neighbors within the chunk that the sweep has passed
    done = range(lane + 1, ROWS) if backward else range(lane)
    lines = []
    for other in done:
        high, low = max(lane, other), min(lane, other)
        # lower triangle without its diagonal, row after row
        place = high * (high - 1) // 2 + low
        lines.append(f"s{lane} += real(inner[c, {place}]) * y{other}")
    # call the function with the sum, fields and constants of the row
    numbers = {field: f"numbers[{k}]" for k, field in enumerate(constants)}
    values = {field: f"a_{field}[i]" for field in roles} | numbers | {"total": f"s{lane}"}
    results = [f"y{lane}", *(f"z{k}" for k in range(1, len(outs)))]
    results += [f"e{k}" for k in range(reduces)]
    lines.append(f"{', '.join(results)} = {name}({', '.join(values[field] for field in roles)})")
    # store what is stored, and sum what is reduced
    lines += [f"{out}[i] = {result}" for out, result in zip(outs, results, strict=False)]
    lines += [f"r{k} += e{k}" for k in range(reduces)]
    inside = [f"    {line}" for line in lines]
    return [f"i = c * ROWS + np.uint64({lane})", "if i < count:", *inside]
