"""The run folder: written by a run (`RunFolder`), read back by `open_run`."""

from lasersph.output.checkpoint import Checkpoint
from lasersph.output.errors import FolderRefused, OutputError
from lasersph.output.reader import Run, Snapshots, open_run
from lasersph.output.run_folder import RunFolder, hash_of_case

__all__ = [
    "Checkpoint",
    "FolderRefused",
    "OutputError",
    "Run",
    "RunFolder",
    "Snapshots",
    "hash_of_case",
    "open_run",
]
