"""NTMpy on the pulse of 150 fs, in an environment of its own: it needs NumPy 1."""

from __future__ import annotations

from pathlib import Path

from measurement import Measurement
from pulse_problem import CONSTANT, LINEAR, Pulse, answers_of, compared
from workplace import Program, Workplace

SIZES = (
    {"layers": 2, "points": 12, "step": 2e-15},
    {"layers": 2, "points": 18, "step": 2e-15},
    {"layers": 2, "points": 24, "step": 5e-16},
    {"layers": 3, "points": 24, "step": 5e-16},
)
"""Layers, points in each, and the time step [s], coarse to fine: of those that were tried, the ones
with the least time for their error. Longer steps than these are unstable."""


def python(workplace: Workplace) -> Path:
    """Its interpreter."""
    return workplace.folder / "ntmpy" / "bin" / "python"


def pulse(case: str, problem: Pulse, workplace: Workplace) -> Measurement:
    """Runs of a problem."""
    interpreter = str(python(workplace))
    answers = answers_of("ntmpy_pulse.py", interpreter, problem, SIZES, workplace)
    return compared(case, "NTMpy", answers, problem, workplace)


PROGRAM = Program(
    name="NTMpy",
    package="ntmpy",
    is_installed=lambda workplace: python(workplace).exists(),
    measures={
        "electrons": lambda workplace: pulse("electrons", CONSTANT, workplace),
        "hot-electrons": lambda workplace: pulse("hot-electrons", LINEAR, workplace),
    },
    differs="B-splines between collocation points, explicit Euler; k_e is a function of T_e alone",
)
