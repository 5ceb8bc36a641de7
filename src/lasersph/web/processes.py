"""Runs that the page starts, stops and resumes: ordinary commands in sessions of their own.

They outlive the page and the server. A run is stopped by a signal to the process that holds its
folder, whoever started it, and then writes its checkpoint.
"""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from itertools import count
from pathlib import Path
from typing import BinaryIO

from lasersph.output import OutputError
from lasersph.output.folder_lock import NAME, is_computing, machine, read_owner
from lasersph.web.case_source import CaseSource

FOLDER_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,63}")
LONGEST_STEM = 56
"""Letters of a name before its number."""
LOOKS, PAUSE = 600, 0.1
"""How often and how long [s] a new process is looked at until it holds its folder or has ended."""

BEGUN = ("resolved.json", "case.toml")
"""Files that a folder has, in this order, once its run has begun."""


class Processes:
    """The processes that this server started."""

    def __init__(self, root: Path) -> None:
        self._root = root.resolve()
        self._started: dict[Path, tuple[subprocess.Popen[bytes], BinaryIO]] = {}
        self._sources: dict[Path, CaseSource] = {}  # whose files last as long as they are held here

    def free_name(self, case: str) -> str:
        """Name of a folder that a run of a case may get, "steel-2" where "steel-1" is taken."""
        # A number is put behind the name, in place of one that it has.
        plain = re.sub(r"[^A-Za-z0-9._-]+", "-", re.sub(r"-[0-9]+$", "", case)).lstrip("._-")
        names = (f"{plain[:LONGEST_STEM] or 'run'}-{number}" for number in count(1))
        return next(name for name in names if not os.path.lexists(self._root / name))

    def start(self, name: str, source: CaseSource, settings: Sequence[str]) -> Path:
        """Start a case in a new folder.

        Raises:
            ValueError: the name is no name of a folder, or is taken. OutputError: it did not start.
        """
        # The name may not lead out of the folder.
        if FOLDER_NAME.fullmatch(name) is None:
            raise ValueError("name the run with letters, digits, dots, dashes: steel-0.8")
        folder = self._root / name
        if folder.exists() or folder.is_symlink():
            raise ValueError(f"{name} is taken: choose another name")
        # The case file lasts as long as the run may need it.
        self._sources[folder] = source
        self._run(folder, [str(source.path), *_options(settings)])
        return folder

    def resume(self, folder: Path) -> None:
        """Go on with a run that was stopped. Raises OutputError where that did not start."""
        if is_computing(folder):
            raise OutputError("the run is computed already")
        # The folder stands for the case as it was started, with its settings.
        self._run(folder, [str(folder), "--resume"])

    def stop(self, folder: Path) -> None:
        """Ask the process that computes in a folder to end with a checkpoint.

        Raises OutputError where there is none on this machine.
        """
        # Only a process of this machine can be signaled.
        owner = read_owner(folder / NAME)
        number = owner.get("process")
        if not is_computing(folder) or not isinstance(number, int) or number <= 1:
            raise OutputError("nobody computes this run")
        if owner.get("machine") != machine():
            raise OutputError(f"the run is computed on {owner.get('host')}: stop it there")
        # The number may belong to another program by now.
        command = Path(f"/proc/{number}/cmdline")
        if command.parent.parent.is_dir() and b"lasersph" not in _read(command):
            raise OutputError("the process that held this folder has ended")
        os.kill(number, signal.SIGTERM)

    def note_of(self, folder: Path) -> str:
        """Last words of a process of this server that failed; empty where none did."""
        # A process that still runs, ended well or was stopped has nothing to say.
        process, said = self._started.get(folder, (None, None))
        if process is None or said is None or process.poll() in (None, 0, 143):
            return ""
        said.seek(0)
        return said.read().decode(errors="replace").strip()[-2000:]

    def _run(self, folder: Path, arguments: Sequence[str]) -> None:
        said = tempfile.TemporaryFile()  # noqa: SIM115  (kept for note_of)
        # A session of its own: it outlives the server and its terminal.
        command = [sys.executable, "-m", "lasersph", "run", *arguments, "--out", str(folder)]
        process = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=said,
            start_new_session=True,
        )
        self._started[folder] = (process, said)
        # Wait until it holds its folder, or has ended with a message.
        for _ in range(LOOKS):
            if all((folder / name).exists() for name in BEGUN) and is_computing(folder):
                return
            try:
                process.wait(PAUSE)
            except subprocess.TimeoutExpired:
                continue
            if note := self.note_of(folder):
                raise OutputError(note)
            return


def _options(settings: Sequence[str]) -> list[str]:
    return [word for setting in settings for word in ("--set", setting)]


def _read(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError:
        return b""
