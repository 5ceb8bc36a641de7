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

import hashlib
import json
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from lasersph.output import checkpoint as checkpoints
from lasersph.output.atomic import TEMPORARY_SUFFIX, replace_json, replace_text, to_json_values
from lasersph.output.checkpoint import Checkpoint
from lasersph.output.errors import FolderRefused, OutputError, clear_errors
from lasersph.output.folder_lock import FolderLock, is_lock
from lasersph.output.history import Events, History
from lasersph.output.particle_file import ParticleFile
from lasersph.output.transaction import rename_damaged

SUMMARY_SCHEMA = 1
SHOWN_LETTERS = 60
"""Of two values that differ; longer ones, tables of laws, would fill the line."""
LEFT_BY_KILL = "resolved.json" + TEMPORARY_SUFFIX
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
    def create(cls, path: str | Path, origin: Origin, *, wait: float = 0.0) -> RunFolder:
        """Make a new run folder at a path that does not exist or is an empty folder.

        Args:
            wait: how long another process may take to leave the folder [s].

        Raises:
            FolderRefused: the folder holds files, another process computes in it or it cannot be
                written; nothing was written.
        """
        folder = Path(path)
        refuse_if_used(folder)
        lock = make_and_lock(folder, wait)
        with releasing_on_failure(lock):
            refuse_if_used(folder)
            return cls._start(folder, origin, lock)

    @classmethod
    def resume(
        cls, path: str | Path, origin: Origin, *, wait: float = 0.0
    ) -> tuple[RunFolder, Checkpoint | None]:
        """Open the folder of an earlier run of the same case and cut it back to its checkpoint.

        A folder without a checkpoint is started again from the beginning, a folder that does not
        exist is made, a complete run is left as it is.

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
        elif not (folder / "resolved.json").exists():
            raise FolderRefused(f"{folder} is not a run folder: nothing to resume there")
        elif (folder / "summary.json").exists():
            check_owner(folder, origin)
            return cls(folder, origin.name, None), None
        else:
            lock = FolderLock(folder, wait=wait)
        with releasing_on_failure(lock):
            if is_untouched(folder):
                (folder / LEFT_BY_KILL).unlink(missing_ok=True)
                return cls._start(folder, origin, lock), None
            files = check_folder(folder, origin)
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
    def _start(cls, folder: Path, origin: Origin, lock: FolderLock) -> RunFolder:
        """Write what is known before the first step."""
        resolved = {
            "schema_version": SUMMARY_SCHEMA,
            "case_hash": origin.name,
            "versions": dict(origin.versions),
            "case": origin.case,
        }
        replace_json(folder / "resolved.json", resolved)
        replace_text(folder / "case.toml", origin.case_text)
        return cls(folder, origin.name, lock)

    @property
    def is_complete(self) -> bool:
        """Whether the run has reached its end."""
        return (self.path / "summary.json").exists()

    @property
    def summary(self) -> dict[str, Any]:
        """The results of a complete run. Raises OutputError."""
        with clear_errors("read", self.path / "summary.json"):
            return json.loads((self.path / "summary.json").read_text())

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
        """Drop later snapshots; a damaged file of them is set aside and a new one begun."""
        for file in (self.particles, self.surface):
            if file is self.surface and not file.path.exists():  # one that stays flat
                continue
            try:
                file.cut(found.meta["snapshots"])
            except OutputError as error:
                aside = rename_damaged(file.path)
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
        self.surface.cut(0)

    def write_profile(self, x: np.ndarray, height: np.ndarray) -> None:
        """Write surface.csv: x and height of a surface at the end (columns,) [m].

        Raises OutputError.
        """
        rows = (f"{a:.9g},{b:.9g}" for a, b in zip(x, height, strict=True))
        replace_text(self.path / "surface.csv", "\n".join(["x_m,height_m", *rows, ""]))

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
        if self._lock is None:
            return
        try:
            if self._lock.is_ours:
                self.history.flush()
        finally:
            self._lock.release()
            self._lock = None


def hash_of_case(case: Mapping[str, Any]) -> str:
    """Short name of a case: equal for equal content, whatever the order of its keys."""
    text = json.dumps(to_json_values(case), sort_keys=True, ensure_ascii=True)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


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
                " or continue the run in it with --resume"
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


def check_folder(folder: Path, origin: Origin) -> list[Path]:
    """Refuse the folder of another case or another version of this program.

    Returns:
        Its checkpoint files, the latest first.

    Raises:
        FolderRefused: see `check_owner`, `checkpoint.refuse_formats`.
    """
    files = checkpoints.candidates(folder / "checkpoint")
    if not (folder / "summary.json").exists():
        # an earlier version hashed cases in its own way: ask for it first
        checkpoints.refuse_formats(files)
    check_owner(folder, origin)
    return files


def check_owner(folder: Path, origin: Origin) -> None:
    """Refuse a folder that holds another case. Raises FolderRefused."""
    path = folder / "resolved.json"
    with clear_errors("read", path, FolderRefused):
        text = path.read_text()
    try:
        found = json.loads(text)
        is_own = found["case_hash"] == origin.name
    except (ValueError, KeyError, TypeError) as error:
        raise FolderRefused(f"{path} is damaged: start the run again in a new folder") from error
    if not is_own:
        here = json.loads(json.dumps(to_json_values(origin.case)))
        what = first_difference(found.get("case"), here)
        raise FolderRefused(
            f"{folder} holds a run of another case{what}: resume it with the case and settings "
            "that it was started with, or choose another folder"
        )


def first_difference(there: Any, here: Any, key: str = "") -> str:
    """The first key that two cases have not alike, with both values if they are short [SI]."""
    if isinstance(there, Mapping) and isinstance(here, Mapping):
        name = next((k for k in {**there, **here} if there.get(k) != here.get(k)), None)
        below = f"{key}.{name}" if key else f"{name}"
        return "" if name is None else first_difference(there.get(name), here.get(name), below)
    old, new = json.dumps(there), json.dumps(here)
    is_short = len(old + new) <= SHOWN_LETTERS
    return f" ({key} is {old} there, not {new}, SI)" if is_short else f" ({key} is another)"
