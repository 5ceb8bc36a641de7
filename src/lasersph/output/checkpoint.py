"""Checkpoints: everything the next step reads, so that a resumed run continues bit for bit.

Each checkpoint is one file `step-<number>.checkpoint`, written under a temporary name and
renamed; the one before it is kept. Layout: the line `lasersph checkpoint`, the length of the
header (8 bytes, little-endian), the header (JSON: schema version, hash of the case, step, time,
numbers, name, type and shape of each array), the arrays one after the other in that order, and
the SHA-256 of all that. A file whose checksum is wrong is passed over for the one before it.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from lasersph.output.atomic import TEMPORARY_SUFFIX, replace_file
from lasersph.output.errors import FolderRefused, OutputError, clear_errors

CHECKPOINT_SCHEMA = 22
"""Raised whenever names or meaning of what solvers and observers keep change."""
FIRST_LINE = b"lasersph checkpoint\n"
NAME = re.compile(r"step-(\d{10})\.checkpoint")
KEPT = 2


@dataclass(frozen=True)
class Checkpoint:
    """State of a run after a step.

    Attributes:
        step, time: number of steps done; seconds. case_hash: says which case the state belongs to.
        arrays: arrays by name, in their own types (float64 stays float64).
        scalars: numbers, texts and lists that JSON knows; floats survive exactly.
        meta: whatever the run folder adds (lengths of the history, events and snapshots).
    """

    step: int
    time: float
    case_hash: str
    arrays: Mapping[str, np.ndarray]
    scalars: Mapping[str, Any] = field(default_factory=dict)
    meta: Mapping[str, Any] = field(default_factory=dict)


def save(folder: Path, checkpoint: Checkpoint, *, kept: int = KEPT) -> Path:
    """Write a checkpoint and keep the latest `kept` with it.

    Returns:
        The file written.

    Raises:
        OutputError: the disk is full, ...; earlier checkpoints are intact.
    """
    # The header says where each array lies; floats are written with all their digits.
    arrays = {name: np.ascontiguousarray(array) for name, array in checkpoint.arrays.items()}
    header = json.dumps(
        {
            "schema_version": CHECKPOINT_SCHEMA,
            "case_hash": checkpoint.case_hash,
            "step": checkpoint.step,
            "time": checkpoint.time,
            "scalars": dict(checkpoint.scalars),
            "meta": dict(checkpoint.meta),
            "arrays": [[name, a.dtype.str, list(a.shape)] for name, a in arrays.items()],
        },
        default=lambda value: value.tolist(),  # of NumPy's numbers and arrays
    ).encode()

    def write(stream: BinaryIO) -> None:
        # The checksum covers all that stands before it, also the first line.
        checksum = hashlib.sha256()
        size = len(header).to_bytes(8, "little")
        for piece in (
            FIRST_LINE,
            size,
            header,
            *(a.reshape(-1).view(np.uint8).data for a in arrays.values()),
        ):
            checksum.update(piece)
            stream.write(piece)
        stream.write(checksum.digest())

    with clear_errors("write", folder):
        folder.mkdir(exist_ok=True)
    target = folder / f"step-{checkpoint.step:010d}.checkpoint"
    replace_file(target, write)

    # Older checkpoints, and what a killed process left unfinished, go once the new one is in place.
    with clear_errors("write", folder):
        for old in candidates(folder)[kept:]:
            old.unlink()
        for torn in folder.glob("*" + TEMPORARY_SUFFIX):
            torn.unlink()
    return target


def candidates(folder: Path) -> list[Path]:
    """Checkpoint files of a folder, the latest first; unfinished ones are left out."""
    if not folder.is_dir():
        return []
    found = [path for path in folder.iterdir() if NAME.fullmatch(path.name)]
    return sorted(found, key=lambda path: path.name, reverse=True)


def load(path: Path) -> Checkpoint:
    """Read one checkpoint file.

    Raises:
        OutputError: it is damaged or unreadable. FolderRefused: it is of another version.
    """
    with clear_errors("read", path):
        data = path.read_bytes()
    # The last 32 bytes are the SHA-256 of all before them.
    body, checksum = data[:-32], data[-32:]
    if not body.startswith(FIRST_LINE) or hashlib.sha256(body).digest() != checksum:
        raise OutputError(f"cannot read {path}: it is damaged")
    # First line, length of the header, header, arrays.
    start = len(FIRST_LINE) + 8
    offset = start + int.from_bytes(body[len(FIRST_LINE) : start], "little")
    header = json.loads(body[start:offset])
    refuse_other_format(path, header)
    # Each array is a copy: a view of the bytes could not be written to.
    arrays = {}
    for name, kind, shape in header["arrays"]:
        count = int(np.prod(shape, dtype=np.int64))
        flat = np.frombuffer(body, dtype=kind, count=count, offset=offset)
        arrays[name] = flat.reshape(shape).copy()
        offset += flat.nbytes
    names = ("step", "time", "case_hash", "scalars", "meta")
    return Checkpoint(**{name: header[name] for name in names}, arrays=arrays)


def refuse_other_format(path: Path, header: Mapping[str, Any]) -> None:
    """Refuse a checkpoint of another version of this program.

    Raises:
        FolderRefused: with both formats, and what can be done.
    """
    written = header["schema_version"]
    if written != CHECKPOINT_SCHEMA:
        raise FolderRefused(
            f"{path} is of another version of lasersph: its format is {written}, this version "
            f"reads {CHECKPOINT_SCHEMA}; resume with that version, or start again in a new folder"
        )


def refuse_formats(files: Sequence[Path]) -> None:
    """Refuse a folder whose latest checkpoint that can be read is of another version.

    Raises:
        FolderRefused: see `refuse_other_format`.
    """
    for path in files:
        # Only the header is read: a checkpoint can hold many megabytes.
        with clear_errors("read", path), path.open("rb") as stream:
            start = stream.read(len(FIRST_LINE) + 8)
            text = stream.read(int.from_bytes(start[len(FIRST_LINE) :], "little"))
        try:
            header = json.loads(text)
        except ValueError:  # damaged: the one before it tells
            continue
        refuse_other_format(path, header)
        return
