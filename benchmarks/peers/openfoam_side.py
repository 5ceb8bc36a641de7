"""OpenFOAM's laplacianFoam on a square with as many cells as the sheet has particles."""

from __future__ import annotations

import itertools
import os
import re
import shutil
import subprocess
from pathlib import Path
from statistics import median
from time import perf_counter

import same_particles as particles
from measurement import Measurement
from workplace import CASES, PeerFailed, Program, Workplace, output_of

ENVIRONMENT = {"WM_PROJECT_DIR": "/usr/share/openfoam"}
"""What Debian's package wants to know, and does not set."""
MPI = ["mpirun.openmpi", "--allow-run-as-root", "--oversubscribe", "-np"]

Lines = list[tuple[float, str]]
"""When each line arrived [s], and the line."""


def step_times(lines: Lines) -> tuple[float, float, float]:
    """Median wall time of a step [s], mean processor time of a process in it, and iterations.

    The first step is left out.
    """
    clock = [(t, float(line.split()[2])) for t, line in lines if line.startswith("ExecutionTime")]
    counts = [int(n) for _, line in lines for n in re.findall(r"No Iterations (\d+)", line)]
    if len(clock) < 3 or not counts:
        raise PeerFailed("laplacianFoam printed no times of steps")
    clock = clock[1:]
    walls = [after[0] - before[0] for before, after in itertools.pairwise(clock)]
    processor = (clock[-1][1] - clock[0][1]) / len(walls)
    return median(walls), processor, sum(counts) / len(counts)


def _prepared(workplace: Workplace) -> Path:
    """Folder of a run with its mesh, split among the processors."""
    folder = workplace.run_folder("openfoam")
    shutil.rmtree(folder)
    shutil.copytree(CASES / "openfoam", folder)
    (folder / "initial").rename(folder / "0")
    count = (workplace.segments + 1) * workplace.steps
    size = {
        "cells": workplace.sheet, "step": particles.STIFFNESS,
        "end": particles.STIFFNESS * count,
        "threads": workplace.threads,
    }  # fmt: skip
    text = "".join(f"{name} {value};\n" for name, value in size.items())
    (folder / "system" / "size").write_text(text, encoding="utf-8")
    output_of(["blockMesh"], folder=folder, environment=ENVIRONMENT)
    if workplace.threads > 1:
        output_of(["decomposePar"], folder=folder, environment=ENVIRONMENT)
    return folder


def _arriving(command: list[str], folder: Path) -> Lines:
    """Lines of a command as they arrive."""
    with subprocess.Popen(
        ["stdbuf", "-oL", *command], cwd=folder, env=os.environ | ENVIRONMENT, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
    ) as process:  # fmt: skip
        return [(perf_counter(), line) for line in process.stdout or ()]


def implicit(workplace: Workplace) -> Measurement:
    """One implicit step with conjugate gradients and the diagonal's incomplete factors."""
    folder, threads = _prepared(workplace), workplace.threads
    command = ["laplacianFoam"]
    if threads > 1:
        command = [*MPI, str(threads), *command, "-parallel"]
    wall, processor, iterations = step_times(_arriving(command, folder))
    each = workplace.time(wall, threads * processor) / iterations
    detail = {"iterations": iterations, "ms per iteration": 1e3 * each}
    return Measurement(
        "implicit", "OpenFOAM", threads, workplace.sheet**2, wall, threads * processor,
        detail=detail,
    )  # fmt: skip


PROGRAM = Program(
    name="OpenFOAM",
    package="openfoam",
    is_installed=lambda _workplace: shutil.which("laplacianFoam") is not None,
    measures={"implicit": implicit},
    differs="cells of a grid with 5 entries a row in place of particles with some 44",
)
