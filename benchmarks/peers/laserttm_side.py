"""laserttm on the pulse of 150 fs, with C_e and k_e that grow as T_e: it knows no constant C_e."""

from __future__ import annotations

from measurement import Measurement
from pulse_problem import LINEAR, answers_of, compared
from workplace import Program, Workplace

SIZES = (
    {"points": 161, "tolerance": 1e-3},
    {"points": 321, "tolerance": 1e-4},
    {"points": 641, "tolerance": 1e-4},
    {"points": 1281, "tolerance": 1e-4},
    {"points": 2561, "tolerance": 1e-4},
    {"points": 5121, "tolerance": 1e-5},
    {"points": 10241, "tolerance": 1e-5},
)
"""Points of its even grid, and tolerances of its integrator, coarse to fine."""


def pulse(workplace: Workplace) -> Measurement:
    """Runs of the problem."""
    answers = answers_of("laserttm_pulse.py", str(workplace.python), LINEAR, SIZES, workplace)
    return compared("hot-electrons", "laserttm", answers, LINEAR, workplace)


PROGRAM = Program(
    name="laserttm",
    package="laserttm",
    is_installed=lambda workplace: workplace.has_module("laserttm"),
    measures={"hot-electrons": pulse},
    differs="an even grid, first order at the surface, stiff integrator of SciPy; its conductivity "
    "k T_e/T_l is given k that grows as T_l, by a table which its settings do not offer",
)
