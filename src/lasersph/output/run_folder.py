"""The run folder: what a run writes, where, and how it is found again after a kill.

    case.toml        the case as given
    resolved.json    the case with every default, in SI, the versions of the programs
    run.log          what the program said
    events.jsonl     what happened, one JSON object per line
    history.csv      one row per time step
    summary.json     the results; appears only when the run is complete
    particles.vtkhdf snapshots, for ParaView
    surface.vtkhdf   the surface at the same times, where it moves; surface.csv at the end
    uncertainty.json errors of the results, from the runs in companions/ (`run --uncertainty`)
    checkpoint/      what a resumed run starts from
    figures/, report.html
    .lock            who computes in the folder now; gone when nobody does (`folder_lock`)
    .generation      how readers notice that files change while they read them (`generation`)

A checkpoint records how long the other files were when it was written. A resumed run cuts them
back to that, so that it continues as if nothing had happened.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from lasersph.output import checkpoint as checkpoints
from lasersph.output.atomic import TEMPORARY_SUFFIX, replace_json
from lasersph.output.checkpoint import Checkpoint
from lasersph.output.errors import FolderRefused, OutputError, clear_errors
from lasersph.output.folder_lock import FolderLock, is_lock
from lasersph.output.history import WARNING, Events, History
from lasersph.output.older_results import RESULTS_SCHEMA, read_summary
from lasersph.output.overwriting import refuse_other_folders, remove_run
from lasersph.output.particle_file import ParticleFile
from lasersph.output.run_owner import (
    RESOLVED,
    SUMMARY,
    Origin,
    change_origin,
    check_owner,
    started_with,
    write_origin,
)
from lasersph.output.transaction import rename_damaged

LEFT_BY_KILL = RESOLVED + TEMPORARY_SUFFIX
"""All that a run killed before it wrote its case leaves."""
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


class RunFolder:
    """The open run folder of one run. Make it with `create` or `resume`.

    Attributes:
        path: the folder. case_hash: says which case the folder belongs to.
        history, events, particles: the files that grow with the run.
    """

    def __init__(self, path: Path, case_hash: str, lock: FolderLock | None) -> None:
        """The folder of a run that `lock` keeps others from; a complete one needs none."""
        self.path = path
        self.case_hash = case_hash
        self.history = History(path / "history.csv")
        self.events = Events(path / "events.jsonl")
        self.particles = ParticleFile(path / "particles.vtkhdf")
        self.surface = ParticleFile(path / "surface.vtkhdf", "Lines")
        self._lock = lock

    @classmethod
    def create(
        cls, path: str | Path, origin: Origin, *, overwrite: bool = False, wait: float = 0.0
    ) -> RunFolder:
        """Make a new run folder at a path that does not exist or is an empty folder.

        Args:
            overwrite: remove the run that the folder holds, and nothing else.
            wait: how long another process may take to leave the folder [s].

        Raises:
            FolderRefused: the folder holds files, another process computes in it or it cannot be
                written; nothing was written.
        """
        folder = Path(path)
        # Refuse before the lock, so that nothing is written, and again behind it, when nobody else
        # writes.
        is_replaced = overwrite and folder.is_dir() and not is_untouched(folder)
        refuse = refuse_other_folders if is_replaced else refuse_if_used
        refuse(folder)
        lock = make_and_lock(folder, wait)
        with releasing_on_failure(lock):
            refuse(folder)
            if is_replaced:
                remove_run(folder)
            return cls._start(folder, origin, lock)

    @classmethod
    def resume(
        cls, path: str | Path, origin: Origin, *, wait: float = 0.0
    ) -> tuple[RunFolder, Checkpoint | None]:
        """Open the folder of an earlier run of the same case and cut it back to its checkpoint.

        A folder without a checkpoint is started again from the beginning, a folder that does not
        exist is made, a complete run is left as it is unless the case has changed where it may
        (`Origin.changeable`): then it goes on from its end.

        Args:
            wait: how long another process may take to leave the folder [s].

        Returns:
            The folder, and the checkpoint to go on from. None: from the beginning, or, where
            `is_complete`, nothing is left to do.

        Raises:
            FolderRefused: the folder belongs to another case or to another version of this
                program, is not a run folder, or another process computes in it.
            OutputError: no checkpoint in it can be used.
        """
        folder = Path(path)
        if is_untouched(folder):
            lock = make_and_lock(folder, wait)
        elif not (folder / RESOLVED).exists():
            raise FolderRefused(f"{folder} is not a run folder: nothing to resume there")
        elif (run := cls.complete(folder, origin)) is not None:
            return run, None
        else:
            lock = FolderLock(folder, wait=wait)
        # Behind the lock the folder may have changed: another process was waited for.
        with releasing_on_failure(lock):
            if is_untouched(folder):
                (folder / LEFT_BY_KILL).unlink(missing_ok=True)
                return cls._start(folder, origin, lock), None
            files, changed = check_folder(folder, origin)
            if changed:
                change_origin(folder, origin, changed)
            run = cls(folder, origin.name, lock)
            if run.is_complete:  # by the process that was waited for
                run.close()
                return run, None
            if files:
                return run, run.last_good(files)
            run = cls._start(folder, origin, lock)
            run.restart()
            return run, None

    @classmethod
    def complete(cls, path: str | Path, origin: Origin) -> RunFolder | None:
        """The folder of a complete run of this very case; None where anything is left to compute.

        Raises:
            FolderRefused: it holds a run of another case.
        """
        folder = Path(path)
        if not (folder / SUMMARY).exists() or check_owner(folder, origin):
            return None
        return cls(folder, origin.name, None)

    @classmethod
    def _start(cls, folder: Path, origin: Origin, lock: FolderLock) -> RunFolder:
        """Write what is known before the first step."""
        write_origin(folder, origin, {})
        return cls(folder, origin.name, lock)

    @property
    def started_with(self) -> dict[str, Any]:
        """Values that the run began with, by the keys of the case that have others since.

        Raises OutputError.
        """
        return started_with(self.path)

    @property
    def is_complete(self) -> bool:
        """Whether the run has reached its end."""
        return (self.path / SUMMARY).exists()

    @property
    def summary(self) -> dict[str, Any]:
        """The results of a complete run. Raises OutputError."""
        return read_summary(self.path)

    def confirm_lock(self) -> None:
        """Make sure that no other process took the folder over. Raises OutputError."""
        if self._lock is not None:
            self._lock.confirm()

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
        is_last: bool = False,
    ) -> None:
        """Write a checkpoint after bringing history and events onto the disk.

        Args:
            step, time: number of steps done; seconds.
            arrays: everything the next step reads, float64.
            scalars: numbers and texts it reads, states of observers.
            is_last: of a run at its end: those before it are removed.

        Raises:
            OutputError: the disk is full, ...; the last checkpoint is intact.
        """
        self.history.flush(sync=True)
        self.events.flush()
        # Lengths of the files at this moment: a resumed run cuts them back to these.
        marks = {
            "history_rows": self.history.rows,
            "events": self.events.count,
            "snapshots": self.particles.steps,
        }
        state = Checkpoint(step, time, self.case_hash, arrays, scalars, marks)
        checkpoints.save(self.path / "checkpoint", state, kept=1 if is_last else checkpoints.KEPT)

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
                self.warn(f"{complaint}; going on from step {found.step}", found.time, found.step)
                damaged.rename(damaged.with_name(damaged.name + ".damaged"))
            self.cut_snapshots(found)
            return found
        raise OutputError(
            f"{complaints[0][1]}; no earlier checkpoint can be used either:"
            " start the run again in a new folder"
        )

    def cut_snapshots(self, found: Checkpoint) -> None:
        """Drop later snapshots; a damaged file of them is set aside and a new one begun."""
        for file in (self.particles, self.surface):
            if file is self.surface and not file.path.exists():  # one that stays flat
                continue
            try:
                file.cut(found.meta["snapshots"])
            except OutputError as error:
                aside = rename_damaged(file.path)
                text = f"{error}; it is kept as {aside.name}, snapshots go to a new file"
                self.warn(text, found.time, found.step)

    def warn(self, message: str, time: float, step: int) -> None:
        """Log a warning and record it as an event, at a time [s]. Raises OutputError."""
        self.log(f"warning: {message}")
        self.events.append(WARNING, time=time, step=step, message=message)

    def restart(self) -> None:
        """Drop everything that an earlier attempt computed. Raises OutputError."""
        self.history.cut(0)
        self.events.cut(0)
        self.particles.cut(0)
        self.surface.cut(0)

    def finish(self, summary: Mapping[str, Any]) -> None:
        """Write summary.json: the run is complete. Raises OutputError.

        Raises ValueError where one of `REQUIRED_KEYS` is missing.
        """
        missing = [key for key in REQUIRED_KEYS if key not in summary]
        if missing:
            raise ValueError(f"the summary lacks {', '.join(missing)}")
        self.history.flush(sync=True)
        self.events.flush()
        replace_json(self.path / SUMMARY, {"schema_version": RESULTS_SCHEMA, **summary})

    def close(self) -> None:
        """Flush the history and let other processes use the folder."""
        if self._lock is None:
            return
        try:
            if self._lock.is_ours:
                self.history.flush()
        finally:
            self._lock.release()
            self._lock = None


def is_untouched(folder: Path) -> bool:
    """Whether a folder is missing, empty, or left by a run killed before it wrote its case."""
    if not folder.exists():
        return True
    return folder.is_dir() and all(
        path.is_file() and (path.name == LEFT_BY_KILL or is_lock(path)) for path in folder.iterdir()
    )


def refuse_if_used(folder: Path) -> None:
    """Refuse a new run in a folder that holds files. Raises FolderRefused."""
    if folder.exists() and not folder.is_dir():
        raise FolderRefused(f"{folder} is a file, not a folder: choose another name with --out")
    with clear_errors("write", folder, FolderRefused):
        if folder.is_dir() and not all(is_lock(path) for path in folder.iterdir()):
            raise FolderRefused(
                f"{folder} is not empty: choose another folder with --out,"
                " or continue the run in it with --resume, or replace it with --overwrite"
            )


def make_and_lock(folder: Path, wait: float) -> FolderLock:
    """Make a folder where there is none, and lock it. Raises FolderRefused."""
    with clear_errors("write", folder, FolderRefused):
        folder.mkdir(parents=True, exist_ok=True)
        if not os.access(folder, os.W_OK | os.X_OK):
            raise FolderRefused(f"cannot write {folder}: permission denied")
    return FolderLock(folder, wait=wait)


@contextmanager
def releasing_on_failure(lock: FolderLock) -> Iterator[None]:
    """Let go of a folder where the block raises."""
    try:
        yield
    except BaseException:
        lock.release()
        raise


def check_folder(folder: Path, origin: Origin) -> tuple[list[Path], dict[str, Any]]:
    """Refuse the folder of another case or another version of this program.

    Returns:
        Its checkpoint files, the latest first, and what `check_owner` returns.

    Raises:
        FolderRefused: see `check_owner`, `checkpoint.refuse_formats`.
        OutputError: the case has changed, and no checkpoint can be used to go on from.
    """
    files = checkpoints.candidates(folder / "checkpoint")
    if not (folder / SUMMARY).exists():
        # an earlier version hashed cases in its own way: ask for it first
        checkpoints.refuse_formats(files)
    changed = check_owner(folder, origin)
    if changed:
        checkpoints.refuse_formats(files)
        refuse_damaged(files)
    return files, changed


def refuse_damaged(files: list[Path]) -> None:
    """Refuse checkpoints of which none is whole, before anything is given up for them.

    Raises OutputError.
    """
    for file in files:
        try:
            checkpoints.load(file)
            return
        except OutputError as error:
            if file == files[-1]:
                raise OutputError(f"{error}: there is nothing to go on from") from error
