"""Texts of loops that this process has written, for the backends that it starts later.

Each solver has a backend with loops of its own, and its loops are mostly those of the solver before
it. To translate the functions of a loop takes 20 ms, longer than to find its machine code. A text
is used again as long as all that entered it is the same: the meaning of global names, and the code
of its functions, which editors replace while a program runs.
"""

from __future__ import annotations

from lasersph.compute.generate import Loop, LoopText

_written: dict[tuple[type[LoopText], Loop], tuple[LoopText, str]] = {}


def written(kind: type[LoopText], loop: Loop) -> tuple[LoopText, str]:
    """Text of a loop: the order of its arguments, and the lines of its file.

    Args:
        kind: for the processor, or for a graphics card.

    Raises:
        LoopSourceError: a function contains something that a loop cannot.
    """
    found = _written.get((kind, loop))
    if found is None or not found[0].unit.is_current():
        text = kind(loop)
        found = _written[kind, loop] = text, text.written()
    return found
