"""FiPy on a square with as many cells as the sheet has particles; SciPy's conjugate gradients."""

from __future__ import annotations

import same_particles as particles
from measurement import Measurement
from pysph_side import json_line
from workplace import CASES, Program, Workplace, output_of

TOLERANCE = 1e-8
"""Of its solver, relative to the right-hand side."""


def implicit(workplace: Workplace) -> Measurement:
    """One implicit step, assembly included."""
    command = [str(workplace.python), str(CASES / "fipy_sheet.py"), str(workplace.sheet)]
    command += [str(workplace.segments), str(particles.STIFFNESS), str(TOLERANCE)]
    text = output_of(command, folder=workplace.run_folder("fipy"))
    found = json_line(text)
    return Measurement("implicit", "FiPy", 1, workplace.sheet**2, found["wall"], found["processor"])


PROGRAM = Program(
    name="FiPy",
    package="fipy",
    is_installed=lambda workplace: workplace.has_module("fipy"),
    measures={"implicit": implicit},
    differs="cells of a grid, 5 entries a row; one processor; assembles its matrix in each step",
)
