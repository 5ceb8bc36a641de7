"""Runs of shipped cases for validations, each in a folder of its own.

A run is kept: where the same program finds it again it is taken as it is, or continued where it was
interrupted. A run of another version of the program is computed anew, so that a validation never
judges what other sources computed.
"""

from __future__ import annotations

import hashlib
import shutil
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from importlib.metadata import version
from pathlib import Path

from lasersph import compute
from lasersph.case import Case, load_case
from lasersph.compute.backend import Backend
from lasersph.input import CaseError
from lasersph.output import Run, open_run
from lasersph.simulation import run
from lasersph.solvers.step_control import StepFailed

LOOK_ONLY = ("cli", "plots", "report", "studies", "validation")
"""Rooms whose sources no run depends on."""
NUMERICS = ("numba", "numpy", "scipy")
_where: ContextVar[tuple[int | None, str]] = ContextVar(
    "threads and backend of a validation", default=(None, "cpu")
)


@contextmanager
def computing(threads: int | None, backend: str = "cpu") -> Iterator[None]:
    """Within this context validations compute there; threads None takes all processors."""
    token = _where.set((threads, backend))
    try:
        yield
    finally:
        _where.reset(token)


def backend_of_loops() -> Backend:
    """Backend for loops that a validation runs itself."""
    threads, backend = _where.get()
    return compute.cuda() if backend == "cuda" else compute.cpu(threads)


def computed(case_name: str, overrides: Sequence[str], out_dir: Path, label: str) -> Run:
    """Run a shipped case with overrides in out_dir/runs/label and open the result.

    The file LABEL.made-by beside the folder says which case and sources the run belongs to.

    Raises:
        CaseError: the folder holds something that is no run.
    """
    case = load_case(case_name, overrides)
    folder = out_dir / "runs" / label
    made_by = folder.with_name(f"{label}.made-by")
    maker = fingerprint(case)
    if not made_by.is_file() or made_by.read_text(encoding="utf-8") != maker:
        _remove(folder)
        folder.mkdir(parents=True)
        made_by.write_text(maker, encoding="utf-8")
    threads, backend = _where.get()
    run(case, folder, resume=True, threads=threads, backend=backend)
    return open_run(folder)


def to_failure(
    case_name: str, overrides: Sequence[str], out_dir: Path, label: str
) -> tuple[Run, str]:
    """As `computed`, for a case that may fail; the reason is "" where it reached its end."""
    try:
        return computed(case_name, overrides, out_dir, label), ""
    except StepFailed as error:
        return open_run(out_dir / "runs" / label), str(error)


def fingerprint(case: Case) -> str:
    """What a run depends on: case, sources that compute it, versions below them, where it runs."""
    versions = " ".join(f"{name} {version(name)}" for name in NUMERICS)
    return f"case {case.hash()}\nsources {_sources()}\n{versions}\nbackend {_where.get()[1]}\n"


@cache
def _sources() -> str:
    """Hash of all sources and data of the package outside `LOOK_ONLY`."""
    package = Path(__file__).parents[1]
    digest = hashlib.sha256()
    for path in sorted(package.rglob("*")):
        place = path.relative_to(package)
        if path.suffix in (".py", ".toml") and place.parts[0] not in LOOK_ONLY:
            digest.update(str(place).encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()


def _remove(folder: Path) -> None:
    """Remove an older run; a folder that holds something else is refused."""
    if not folder.exists():
        return
    if any(folder.iterdir()) and not (folder / "resolved.json").exists():
        raise CaseError(f"{folder} is not a run folder", "give another folder")
    shutil.rmtree(folder)
