"""Plain aligned text: the same on a terminal, in a file and in a pipe."""

from __future__ import annotations

from collections.abc import Iterable, Sequence


def aligned(rows: Iterable[Sequence[str]], *, header: bool = False) -> str:
    """Rows of text in columns, the last one ragged; a rule below the header."""
    lines = [list(row) for row in rows]
    if not lines:
        return ""
    count = max(len(line) for line in lines)
    lines = [line + [""] * (count - len(line)) for line in lines]
    widths = [max(len(line[column]) for line in lines) for column in range(count)]
    if header:
        lines.insert(1, ["-" * width for width in widths])
    padded = (zip(line, widths, strict=True) for line in lines)
    return "\n".join("  ".join(cell.ljust(width) for cell, width in row).rstrip() for row in padded)
