"""Where peers are installed, how large the cases are, and how a peer is run."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from measurement import Clock, Measurement

CASES = Path(__file__).parent / "cases"
LAST_LINES = 5


class PeerFailed(RuntimeError):
    """A peer ended with an error or printed something else than expected."""


@dataclass(frozen=True)
class Workplace:
    """What all programs of a round are given.

    Attributes:
        folder: where `install.sh` has put the peers; runs write into its folder `runs`.
        threads: processors of each program. edge: particles along an edge of the 3-D block.
        sheet: unknowns along an edge of the 2-D sheet. segments: timed, after one that is not.
        steps: of a segment. clock: what times are compared by.
    """

    folder: Path
    threads: int
    edge: int
    sheet: int
    segments: int
    steps: int
    clock: Clock

    def time(self, wall: float, processor: float) -> float:
        """Time by that clock [s] of what took `wall` and, of all processors, `processor`."""
        return wall if self.clock == "wall" else processor / self.threads

    @property
    def python(self) -> Path:
        """Interpreter that the peers written for Python are installed for."""
        return self.folder / "venv" / "bin" / "python"

    def tool(self, name: str) -> Path:
        """Program beside that interpreter."""
        return self.python.with_name(name)

    def has_module(self, name: str) -> bool:
        """Whether that interpreter has a package."""
        return any(self.folder.glob(f"venv/lib/python*/site-packages/{name}"))

    def run_folder(self, name: str) -> Path:
        """Folder for the files of a run."""
        found = self.folder / "runs" / name
        found.mkdir(parents=True, exist_ok=True)
        return found


@dataclass(frozen=True)
class Program:
    """A program that is timed.

    Attributes:
        name: as printed. package: argument of `install.sh`, "" for what needs no installation.
        is_installed: whether it can be run. measures: by case. differs: what it computes or
            counts otherwise than lasersph, in a few words.
    """

    name: str
    package: str
    is_installed: Callable[[Workplace], bool]
    measures: Mapping[str, Callable[[Workplace], Measurement]]
    differs: str


def output_of(
    command: list[str],
    *,
    folder: Path,
    threads: int = 1,
    environment: Mapping[str, str] | None = None,
) -> str:
    """What a command prints.

    Raises:
        PeerFailed: it ends with an error; the message has its last lines.
    """
    variables = os.environ | {"OMP_NUM_THREADS": str(threads)} | dict(environment or {})
    variables.pop("PYTHONPATH", None)  # lasersph's own packages are not the peer's
    done = subprocess.run(command, capture_output=True, text=True, cwd=folder, env=variables)
    if done.returncode:
        last = (done.stdout + done.stderr).strip().splitlines()[-LAST_LINES:]
        raise PeerFailed(
            f"{Path(command[0]).name} ended with {done.returncode}: " + " | ".join(last)
        )
    return done.stdout
