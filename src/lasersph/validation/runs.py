"""Runs of shipped cases for validations: always computed anew, each in a folder of its own."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path

from lasersph.case import load_case
from lasersph.output import Run, open_run
from lasersph.reading import CaseError
from lasersph.simulation import run

THREADS = 2


def computed(case_name: str, overrides: Sequence[str], out_dir: Path, label: str) -> Run:
    """Run a shipped case with overrides into out_dir/runs/label and open the result.

    An older run in that folder is replaced: a validation never judges what another version of the
    program computed.

    Raises:
        CaseError: the folder holds something that is no run.
    """
    folder = out_dir / "runs" / label
    if folder.exists() and any(folder.iterdir()):
        if not (folder / "resolved.json").exists():
            raise CaseError(f"{folder} is not a run folder", "give another folder")
        shutil.rmtree(folder)
    run(load_case(case_name, overrides), folder, threads=THREADS)
    return open_run(folder)
