"""Commented plans to start from."""

from __future__ import annotations

import re
from os import PathLike
from pathlib import Path

from lasersph.case import CaseFile
from lasersph.case.loading import write_new_file
from lasersph.input import CaseError
from lasersph.input.schema import as_toml

LIBRARY = Path(__file__).parent / "plans"


def write_new_plan(kind: str, case: str, target: str | PathLike[str]) -> Path:
    """Write a commented plan of a kind ("sweep") for a case.

    Raises:
        CaseError: no such kind or case, the target exists already or cannot be written.
    """
    files = {path.stem: path for path in sorted(LIBRARY.glob("*.toml"))}
    if kind not in files:
        raise CaseError(
            f'no kind of plan "{kind}"', f"write one of {', '.join(files)}", file="--plan"
        )
    # a case that cannot be read is refused here, not by the plan
    CaseFile(case)
    text = files[kind].read_text(encoding="utf-8")
    text = re.sub(r'^case = "[^"]*"', f"case = {as_toml(case)}", text, flags=re.MULTILINE)
    return write_new_file(text, target)
