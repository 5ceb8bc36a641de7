"""lasersph itself, in the process that compares."""

from __future__ import annotations

from lasersph_block import heat, heat_sum, wcsph
from lasersph_pulse import electrons, hot_electrons
from lasersph_sheet import implicit
from workplace import Program

PROGRAM = Program(
    name="lasersph",
    package="",
    is_installed=lambda _workplace: True,
    measures={
        "wcsph": wcsph,
        "heat": heat,
        "heat-sum": heat_sum,
        "implicit": implicit,
        "electrons": electrons,
        "hot-electrons": hot_electrons,
    },
    differs="whole steps are the midpoint rule, two right-hand sides; cubic spline in 3-D, quintic "
    "with 44 neighbors in 2-D",
)
