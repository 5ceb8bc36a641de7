"""Remove the run that a folder holds, so that another can begin there."""

from __future__ import annotations

import shutil
from pathlib import Path

from lasersph.output.errors import FolderRefused, clear_errors
from lasersph.output.generation import raise_generation
from lasersph.output.run_owner import CASE, DERIVED, RESOLVED, SUMMARY

FILES = (
    SUMMARY,
    *DERIVED,
    "run.log",
    "events.jsonl",
    "history.csv",
    "surface.csv",
    CASE,
    RESOLVED,
)
"""In the order of their removal: the folder is no complete run from the first on, and is known as
that of a run to the last, so that a kill in between leaves one that can be overwritten again."""
SERIES = ("particles.vtkhdf", "surface.vtkhdf")
FOLDERS = ("checkpoint", "companions", "figures")


def refuse_other_folders(folder: Path) -> None:
    """Refuse what holds files and is not the folder of a run. Raises FolderRefused."""
    if not (folder / RESOLVED).is_file():
        raise FolderRefused(
            f"{folder} is not the folder of a run, and nothing else is overwritten: choose another "
            "folder with --out"
        )


def remove_run(folder: Path) -> None:
    """Remove all that a run writes; files of others in the folder stay. Raises OutputError."""
    raise_generation(folder)
    with clear_errors("write", folder):
        # Without its summary the folder is no complete run any more.
        (folder / FILES[0]).unlink(missing_ok=True)
        for name in FOLDERS:
            if (folder / name).is_dir() and not (folder / name).is_symlink():
                shutil.rmtree(folder / name)
        for name in SERIES:
            # The names of files go last and in their order: see `FILES`.
            for file in folder.glob(f"{name}*"):  # with journals and damaged ones set aside
                file.unlink()
        for name in FILES:
            (folder / name).unlink(missing_ok=True)
