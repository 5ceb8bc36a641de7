"""Runs of shipped cases for validations, each in a folder of its own.

A run is kept: where the same program finds it again it is taken as it is, or continued where it was
interrupted. A run of other sources, of those that it runs through, is computed anew, so that a
validation never judges what they computed.
"""

from __future__ import annotations

import shutil
from importlib.metadata import version
from pathlib import Path

from lasersph.case import Case
from lasersph.input import CaseError
from lasersph.output import Run, hash_of_case, open_run
from lasersph.simulation import run
from lasersph.validation import sources

NUMERICS = ("numba", "numpy", "scipy")


def run_case(case: Case, folder: Path, *, threads: int | None = None, backend: str = "cpu") -> Run:
    """Run a case in a folder and open the result; a finished run of the same program is taken.

    The file FOLDER.made-by beside the folder says which case and sources the run belongs to.

    Raises:
        CaseError: the folder holds something that is no run.
    """
    # A run of other sources is removed and computed anew.
    made_by = folder.with_name(f"{folder.name}.made-by")
    maker = fingerprint(case, backend)
    if not made_by.is_file() or made_by.read_text(encoding="utf-8") != maker:
        _remove(folder)
        folder.mkdir(parents=True)
        made_by.write_text(maker, encoding="utf-8")
    run(case, folder, resume=True, threads=threads, backend=backend, warn=False)
    return open_run(folder)


def fingerprint(case: Case, backend: str = "cpu") -> str:
    """Fingerprint of a run: case, sources that compute it, versions below them, where it runs."""
    # Versions of the libraries below count as sources.
    versions = " ".join(f"{name} {version(name)}" for name in NUMERICS)
    modules = sources.hashes([sources.TIME_LOOP, sources.recipe_module(case.solver.kind)])
    return f"case {case.hash()}\nsources {hash_of_case(modules)}\n{versions}\nbackend {backend}\n"


def _remove(folder: Path) -> None:
    """Remove an older run; a folder that holds something else is refused."""
    # A folder that is no run is somebody else's.
    if not folder.exists():
        return
    if any(folder.iterdir()) and not (folder / "resolved.json").exists():
        raise CaseError(f"{folder} is not a run folder", "give another folder")
    shutil.rmtree(folder)
