"""Tables as plain text, in one style: the same on a terminal, in a file and in a pipe."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

NUMBER = re.compile(r"[+-]?(\d|\.\d|nan|inf|–)|-?$")
"""Begins every cell of a column of numbers, where a cell is not empty."""


def text_table(rows: Iterable[Sequence[str]], head: Sequence[str] = ()) -> str:
    """Rows of text in columns, two spaces apart.

    With a head, whose names stand above a rule, columns of numbers end below one another, but the
    first, which names the rows. Without one a row is a name and what belongs to it.

    Raises:
        ValueError: more than two columns without a head, or a row longer than the head.
    """
    lines = [list(row) for row in rows]
    count = len(head) or 2
    if any(len(line) > count for line in lines):
        raise ValueError(f"a table of {count} columns got a longer row; more than two need a head")
    # Short rows end with empty cells.
    lines = [line + [""] * (count - len(line)) for line in lines]
    # Columns of numbers end below one another, but for the names in the first.
    is_number = [
        bool(head) and column > 0 and all(NUMBER.match(line[column]) for line in lines)
        for column in range(count)
    ]
    lines = [list(head), *lines] if head else lines
    # The rule has the widths of the columns.
    widths = [max((len(line[column]) for line in lines), default=0) for column in range(count)]
    if head:
        lines.insert(1, ["-" * width for width in widths])
    return "\n".join(
        "  ".join(
            cell.rjust(width) if right else cell.ljust(width)
            for cell, width, right in zip(line, widths, is_number, strict=True)
        ).rstrip()
        for line in lines
    )
