"""`lasersph validate`: published numbers beside computed ones."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def validate(
    names: Annotated[
        list[str] | None, typer.Argument(metavar="[NAME]...", help="Default: all of them.")
    ] = None,
) -> None:
    """Compute published cases and compare."""
    print(names, Path())
