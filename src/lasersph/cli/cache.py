"""`lasersph cache`: the folder of compiled loops."""

from __future__ import annotations

from typing import Annotated, Literal

import typer

Action = Annotated[
    Literal["show", "clear"],
    typer.Argument(help="show: where the loops are and how large; clear: remove them."),
]


def cache(action: Action = "show") -> None:
    """Show or clear the cache of compiled loops."""
    from lasersph.case.size import in_words
    from lasersph.compute import cache as loops

    if action == "clear":
        print(f"removed {in_words(loops.clear())} from {loops.location()}")
    else:
        print(f"{loops.location()}: {len(loops.files())} loops, {in_words(loops.size())}")
