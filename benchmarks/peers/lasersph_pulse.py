"""lasersph on the pulse of 150 fs: electrons and lattice in 1-D, particles graded with depth."""

from __future__ import annotations

import tempfile
from pathlib import Path
from time import perf_counter, process_time

import numpy as np
from lasersph_block import backend
from measurement import Measurement
from pulse_problem import COLD, CONSTANT, LINEAR, Answer, Pulse, at_depths, compared
from workplace import Workplace

from lasersph.case import Case, load_case
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.step_control import choose_step

SIZES = (
    {"spacing": "40 nm", "ratio": "0.8", "step_error": "0.1"},
    {"spacing": "25 nm", "ratio": "0.8", "step_error": "0.05"},
    {"spacing": "12 nm", "ratio": "0.85", "step_error": "0.02"},
    {"spacing": "6 nm", "ratio": "0.9", "step_error": "0.005"},
    {"spacing": "3 nm", "ratio": "0.9", "step_error": "0.001"},
)
"""Of the finest layers, the ratio of one to the next, and the error of a step, coarse to fine."""
TEXT = """schema_version = 2
initial_temperature = "{cold} K"
boundaries = {{ emissivity = 0 }}
[material]
density = "1000 kg/m^3"
heat_capacity = {{ polynomial = [{heat}], scale = "1 J/(kg K)" }}
conductivity = {{ polynomial = [{metal}], scale = "1 W/(m K)" }}
electrons = {{ heat_capacity = {electrons}, {law}coupling = "{coupling} W/(m^3 K)" }}
[laser]
fluence = "{fluence} J/m^2"
beam = {{ kind = "uniform" }}
pulse = {{ kind = "gaussian", fwhm = "{fwhm} s", center = "{center} s" }}
absorption = {{ kind = "beer-lambert", absorption_coefficient = "{alpha} 1/m" }}
reflectivity = 0.0
[domain]
depth = "{thickness} m"
[particles]
spacing = "{spacing}"
arrangement = "graded"
fine_depth = "100 nm"
coarsest = "50 nm"
ratio = {ratio}
[solver]
dimensions = 1
heat = "two-temperature"
step_error = {step_error}
phase_change = false
[time]
end = "{end} s"
growth = 4
"""
DENSITY = 1000.0
"""Of the metal [kg/m^3]; only heats per volume matter."""


def case_of(pulse: Pulse, size: dict[str, str]) -> Case:
    """The problem with particles of a size. The metal's heat is that of electrons and lattice."""
    slope = pulse.capacity / COLD
    if pulse.is_linear:
        heat = f"{pulse.lattice / DENSITY}, {slope / DENSITY}"
        metal, law = f"0.0, {pulse.conductivity / COLD}", ""
        electrons = f'{{ coefficient = "{slope} J/(m^3 K^2)" }}'
    else:
        heat, metal = f"{(pulse.lattice + pulse.capacity) / DENSITY}", f"{pulse.conductivity}"
        electrons = f'"{pulse.capacity} J/(m^3 K)"'
        law = f'conductivity = "{pulse.conductivity} W/(m K)", '
    laws = {"heat": heat, "metal": metal, "electrons": electrons, "law": law}
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "pulse.toml"
        file.write_text(
            TEXT.format(**vars(pulse), **laws, **size, cold=COLD, end=pulse.times[-1]),
            encoding="utf-8",
        )
        return load_case(file)


def answer(case: Case, pulse: Pulse) -> Answer:
    """A run from the particles to the last time."""
    begin = perf_counter(), process_time()
    solver = recipe_of(case).build(backend(1))
    found: list[list[np.ndarray]] = [[], []]
    count = solver.body.count
    for time in pulse.times:
        while solver.state.time < time * (1.0 - 1e-12):
            limits = solver.time_step_limits() | {"snapshot": time - solver.state.time}
            _, step, unclipped = choose_step(limits)
            solver.step(step, unclipped)
        for rows, name in zip(found, ("electron_temperature", "temperature"), strict=True):
            T = np.array(solver.backend.to_host(solver.particles[name]))[:count]
            rows.append(T)
    end = perf_counter(), process_time()
    depth = -solver.body.filling.position[-1, :count]
    T = np.array([[at_depths(depth, row, pulse) for row in rows] for rows in found])
    return Answer(count, end[0] - begin[0], end[1] - begin[1], T)


def answers(pulse: Pulse) -> list[Answer]:
    """Runs from coarse to fine, the first of them once more before, while loops are compiled."""
    cases = [case_of(pulse, size) for size in SIZES]
    answer(cases[0], pulse)
    return [answer(case, pulse) for case in cases]


def electrons(workplace: Workplace) -> Measurement:
    """Constant coefficients."""
    return compared("electrons", "lasersph", answers(CONSTANT), CONSTANT, workplace)


def hot_electrons(workplace: Workplace) -> Measurement:
    """Coefficients that grow with T_e."""
    return compared("hot-electrons", "lasersph", answers(LINEAR), LINEAR, workplace)
