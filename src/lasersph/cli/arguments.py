"""Arguments and options that several verbs share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

CaseName = Annotated[
    str, typer.Argument(metavar="CASE", help="A case file, or the name of a shipped case.")
]
Settings = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="KEY=VALUE",
        help="Change one key of the case, e.g. laser.fluence=0.8J/cm2. Later ones win.",
    ),
]
Out = Annotated[Path | None, typer.Option("--out", metavar="DIR", help="Folder to write into.")]
Quick = Annotated[bool, typer.Option("--quick", help="Four times coarser, to see that it works.")]
Threads = Annotated[
    int | None, typer.Option("--threads", min=1, metavar="N", help="Default: all processors.")
]
RunFolder = Annotated[Path, typer.Argument(metavar="DIR", help="The folder of a run.")]
