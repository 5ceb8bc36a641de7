"""The run folder: written by a run (`RunFolder`), read back by `open_run`.

settings             what a case says of its results, and when snapshots are due
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lasersph.output.checkpoint import Checkpoint
    from lasersph.output.errors import FolderLocked, FolderRefused, OutputError
    from lasersph.output.reader import Run, RunOrFolder, Snapshots, open_run
    from lasersph.output.run_folder import RunFolder
    from lasersph.output.run_owner import hash_of_case

__all__ = [
    "Checkpoint",
    "FolderLocked",
    "FolderRefused",
    "OutputError",
    "Run",
    "RunFolder",
    "RunOrFolder",
    "Snapshots",
    "hash_of_case",
    "open_run",
]

_FILES = {
    "Checkpoint": "checkpoint",
    "FolderLocked": "errors",
    "FolderRefused": "errors",
    "OutputError": "errors",
    "Run": "reader",
    "RunFolder": "run_folder",
    "RunOrFolder": "reader",
    "Snapshots": "reader",
    "hash_of_case": "run_owner",
    "open_run": "reader",
}


def __getattr__(name: str) -> Any:
    """Import a public name from its file when it is first asked for: a case needs none of them."""
    if name not in _FILES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    value = getattr(import_module(f"lasersph.output.{_FILES[name]}"), name)
    globals()[name] = value
    return value
