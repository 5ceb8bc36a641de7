"""The run folder: what a run writes, where, and how it is found again after a kill.

    case.toml        the case as given
    resolved.json    the case with every default, in SI, the versions of the programs
    run.log          what the program said
    events.jsonl     what happened, one JSON object per line
    history.csv      one row per time step
    summary.json     the results; appears only when the run is complete
    particles.vtkhdf snapshots, for ParaView
    uncertainty.json errors of the results, from the runs in companions/ (`run --uncertainty`)
    checkpoint/      what a resumed run starts from
    figures/, report.html

A checkpoint records how long the other files were when it was written. A resumed run cuts them
back to that, so that it continues as if nothing had happened.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from lasersph.output import checkpoint as checkpoints
from lasersph.output.atomic import TEMPORARY_SUFFIX, replace_json, replace_text, to_json_values
from lasersph.output.checkpoint import Checkpoint
from lasersph.output.errors import FolderRefused, OutputError, clear_errors
from lasersph.output.history import Events, History
from lasersph.output.particle_file import ParticleFile
from lasersph.output.transaction import rename_damaged

SUMMARY_SCHEMA = 1
REQUIRED_KEYS = (
    "case",
    "solver",
    "particles",
    "steps",
    "time_s",
    "wall_time_s",
    "temperature_max_K",
    "energy",
)


@dataclass(frozen=True)
class Origin:
    """What a run begins with.

    Attributes:
        case_text: the case file as given. case: with all defaults, SI.
        versions: of the programs that compute. case_hash: which case this is; from `case` if empty.
    """

    case_text: str
    case: Mapping[str, Any]
    versions: Mapping[str, str]
    case_hash: str = ""

    @property
    def name(self) -> str:
        """Short name of the case that the folder belongs to."""
        return self.case_hash or hash_of_case(self.case)


class RunFolder:
    """The open run folder of one run. Make it with `create` or `resume`.

    Attributes:
        path: the folder. case_hash: says which case the folder belongs to.
        history, events, particles: the files that grow with the run.
    """

    def __init__(self, path: Path, case_hash: str) -> None:
        self.path = path
        self.case_hash = case_hash
        self.history = History(path / "history.csv")
        self.events = Events(path / "events.jsonl")
        self.particles = ParticleFile(path / "particles.vtkhdf")
        self._lock = lock_folder(path)

    @classmethod
    def create(cls, path: str | Path, origin: Origin) -> RunFolder:
        """Make a new run folder at a path that does not exist or is an empty folder.

        Raises:
            FolderRefused: the folder holds files or cannot be written; nothing was written.
        """
        folder = Path(path)
        if folder.exists() and not folder.is_dir():
            raise FolderRefused(f"{folder} is a file, not a folder: choose another name with --out")
        with clear_errors("write", folder, FolderRefused):
            if folder.is_dir() and any(folder.iterdir()):
                raise FolderRefused(
                    f"{folder} is not empty: choose another folder with --out,"
                    " or continue the run in it with --resume"
                )
            folder.mkdir(parents=True, exist_ok=True)
            if not os.access(folder, os.W_OK | os.X_OK):
                raise FolderRefused(f"cannot write {folder}: permission denied")
        return cls._start(folder, origin)

    @classmethod
    def resume(cls, path: str | Path, origin: Origin) -> tuple[RunFolder, Checkpoint | None]:
        """Open the folder of an earlier run of the same case and cut it back to its checkpoint.

        A folder without a checkpoint is started again from the beginning, a folder that does not
        exist is made, a complete run is left as it is.

        Returns:
            The folder, and the checkpoint to go on from. None: from the beginning, or, where
            `is_complete`, nothing is left to do.

        Raises:
            FolderRefused: the folder belongs to another case or to another version of this
                program, or is not a run folder.
            OutputError: no checkpoint in it can be used.
        """
        folder = Path(path)
        if is_untouched(folder):
            for left in folder.iterdir() if folder.is_dir() else ():
                with clear_errors("write", left, FolderRefused):
                    left.unlink()
            return cls.create(folder, origin), None
        files = checkpoints.candidates(folder / "checkpoint")
        is_complete = (folder / "summary.json").exists()
        if not is_complete:  # an earlier version hashed cases in its own way: ask for it first
            checkpoints.refuse_formats(files)
        check_owner(folder, origin.name)
        if is_complete:
            return cls(folder, origin.name), None
        if not files:
            run = cls._start(folder, origin)
            run.restart()
            return run, None
        run = cls(folder, origin.name)
        return run, run.last_good(files)

    @classmethod
    def _start(cls, folder: Path, origin: Origin) -> RunFolder:
        """Write what is known before the first step."""
        resolved = {
            "schema_version": SUMMARY_SCHEMA,
            "case_hash": origin.name,
            "versions": dict(origin.versions),
            "case": origin.case,
        }
        replace_json(folder / "resolved.json", resolved)
        replace_text(folder / "case.toml", origin.case_text)
        return cls(folder, origin.name)

    @property
    def is_complete(self) -> bool:
        """Whether the run has reached its end."""
        return (self.path / "summary.json").exists()

    @property
    def summary(self) -> dict[str, Any]:
        """The results of a complete run. Raises OutputError."""
        with clear_errors("read", self.path / "summary.json"):
            return json.loads((self.path / "summary.json").read_text())

    def log(self, text: str) -> None:
        """Add a line to run.log, with date and time. Raises OutputError."""
        stamp = datetime.now(UTC).strftime("%Y-%m-%d %H:%M:%S")
        path = self.path / "run.log"
        with clear_errors("write", path), open(path, "a", encoding="utf-8") as stream:
            stream.write(f"{stamp}  {text}\n")

    def save_checkpoint(
        self,
        *,
        step: int,
        time: float,
        arrays: Mapping[str, np.ndarray],
        scalars: Mapping[str, Any],
    ) -> None:
        """Write a checkpoint after bringing history and events onto the disk.

        Args:
            step, time: number of steps done; seconds.
            arrays: everything the next step reads, float64.
            scalars: numbers and texts it reads, states of observers.

        Raises:
            OutputError: the disk is full, ...; the last checkpoint is intact.
        """
        self.history.flush(sync=True)
        self.events.flush()
        marks = {
            "history_rows": self.history.rows,
            "events": self.events.count,
            "snapshots": self.particles.steps,
        }
        state = Checkpoint(step, time, self.case_hash, arrays, scalars, marks)
        checkpoints.save(self.path / "checkpoint", state)

    def last_good(self, files: list[Path]) -> Checkpoint:
        """Load the latest checkpoint that is whole, cut the folder back to it.

        Raises:
            OutputError: none can be used; says why for the latest.
        """
        complaints: list[tuple[Path, str]] = []
        for file in files:
            try:
                found = checkpoints.load(file)
                marks = found.meta
                self.history.cut(marks["history_rows"])
                self.events.cut(marks["events"])
            except OutputError as error:
                complaints.append((file, str(error)))
                continue
            for damaged, complaint in complaints:
                self.warn(found, f"{complaint}; going on from step {found.step}")
                damaged.rename(damaged.with_name(damaged.name + ".damaged"))
            self.cut_snapshots(found)
            return found
        raise OutputError(
            f"{complaints[0][1]}; no earlier checkpoint can be used either:"
            " start the run again in a new folder"
        )

    def cut_snapshots(self, found: Checkpoint) -> None:
        """Drop later snapshots; a damaged particle file is set aside and a new one begun."""
        try:
            self.particles.cut(found.meta["snapshots"])
        except OutputError as error:
            aside = rename_damaged(self.particles.path)
            self.warn(found, f"{error}; it is kept as {aside.name}, snapshots go to a new file")

    def warn(self, found: Checkpoint, message: str) -> None:
        """Log a warning and record it as an event. Raises OutputError."""
        self.log(f"warning: {message}")
        self.events.append("warning", time=found.time, step=found.step, message=message)

    def restart(self) -> None:
        """Drop everything that an earlier attempt computed. Raises OutputError."""
        self.history.cut(0)
        self.events.cut(0)
        self.particles.cut(0)

    def finish(self, summary: Mapping[str, Any]) -> None:
        """Write summary.json: the run is complete. Raises OutputError.

        Raises ValueError where one of `REQUIRED_KEYS` is missing.
        """
        missing = [key for key in REQUIRED_KEYS if key not in summary]
        if missing:
            raise ValueError(f"the summary lacks {', '.join(missing)}")
        self.history.flush(sync=True)
        self.events.flush()
        replace_json(self.path / "summary.json", {"schema_version": SUMMARY_SCHEMA, **summary})

    def close(self) -> None:
        """Flush the history and let other processes use the folder."""
        self.history.flush()
        if self._lock is not None:
            os.close(self._lock)
            self._lock = None


def hash_of_case(case: Mapping[str, Any]) -> str:
    """Short name of a case: equal for equal content, whatever the order of its keys."""
    text = json.dumps(to_json_values(case), sort_keys=True, ensure_ascii=True)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def is_untouched(folder: Path) -> bool:
    """Whether a folder is missing, empty, or left by a run killed before it wrote its case."""
    if not folder.exists():
        return True
    left = folder / ("resolved.json" + TEMPORARY_SUFFIX)
    return folder.is_dir() and all(path == left and path.is_file() for path in folder.iterdir())


def check_owner(folder: Path, case_hash: str) -> None:
    """Refuse a folder that is not a run folder or holds another case."""
    path = folder / "resolved.json"
    if not folder.is_dir() or not path.exists():
        raise FolderRefused(f"{folder} is not a run folder: nothing to resume there")
    with clear_errors("read", path, FolderRefused):
        text = path.read_text()
    try:
        found = json.loads(text)["case_hash"]
    except (ValueError, KeyError, TypeError) as error:
        raise FolderRefused(f"{path} is damaged: start the run again in a new folder") from error
    if found != case_hash:
        raise FolderRefused(
            f"{folder} holds a run of another case: resume it with the case and settings that it"
            " was started with, or choose another folder"
        )


def lock_folder(folder: Path) -> int | None:
    """Keep a second process from writing into the folder, as long as this one lives.

    Returns:
        The open lock, to be closed; None on systems without file locks.

    Raises:
        FolderRefused: another process is writing.
    """
    try:
        import fcntl
    except ImportError:
        return None
    with clear_errors("write", folder, FolderRefused):
        descriptor = os.open(folder / "run.log", os.O_RDWR | os.O_CREAT, 0o666)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        os.close(descriptor)
        raise FolderRefused(f"another process is writing to {folder}") from error
    except OSError:  # a file system without locks
        os.close(descriptor)
        return None
    return descriptor
