"""What iron's electrons would change of AISI 304: docs/methods/two_temperatures.md.

    python benchmarks/other_electrons.py

A pulse of 150 fs and 775 nm heats the steel in 1-D. Prints the fluence from which it melts 1 nm
with the electrons of Fe-Cr-Ni and with iron's, and at two fluences the highest temperature of the
lattice and the depth of its melt. Half a minute.
"""

from __future__ import annotations

import numpy as np

from lasersph import compute
from lasersph.case import Case, load_case
from lasersph.materials import load_material
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.step_control import choose_step

LEAST = 1e-9
"""Melt that counts as molten [m]."""
BETWEEN, HALVINGS = (0.04, 0.1), 6
"""Fluences [J/cm^2] between which it begins to melt, and how often they are halved."""
ABOVE = (0.12, 0.3)
"""Fluences [J/cm^2] at which temperature and depth are compared."""
SETTINGS = (
    *("material=steel-304", "laser.wavelength=", "probes=", "solver.plateau=evaporate"),
    *("laser.reflectivity=0.666", "laser.absorption.absorption_coefficient=7.1e7 1/m"),
    *("particles.fine_depth=100 nm", "particles.ratio=0.9"),
    "laser.pulse={ kind = 'gaussian', fwhm = '150 fs', center = '0.5 ps' }",
    *("time.end=200 ps", "output.snapshots={ interval = '200 ps' }"),
)


def case_of(fluence: float, electrons: str) -> Case:
    """Steel under a fluence [J/cm^2] with the electrons of a metal."""
    case = load_case("short-pulse-gold", (*SETTINGS, f"laser.fluence={fluence} J/cm^2"))
    other = {"electrons": load_material(electrons).electrons}
    return case.model_copy(update={"material": case.material.model_copy(update=other)})


def heated(case: Case) -> tuple[float, float]:
    """Highest temperature of the lattice [K] and largest depth of its melt [m]."""
    solver = recipe_of(case).build(compute.cpu(threads=1))
    look, count = solver.backend.host_view, solver.body.count
    width = solver.body.filling.width[-1, :count]
    hottest = deepest = 0.0
    while solver.state.time < case.time.end * (1.0 - 1e-12):
        left = {"end": case.time.end - solver.state.time}
        _, step, unclipped = choose_step(solver.time_step_limits() | left)
        solver.step(step, unclipped)
        # the melt of a column, cell by cell
        molten = np.asarray(look(solver.particles["melt_fraction"]))[:count]
        hottest = max(hottest, float(look(solver.particles["temperature"]).max()))
        deepest = max(deepest, float(width @ molten))
    return hottest, deepest


def melts_from(electrons: str) -> float:
    """Fluence from which the least melt is there [J/cm^2], by halving."""
    low, high = BETWEEN
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        _, depth = heated(case_of(middle, electrons))
        low, high = (low, middle) if depth > LEAST else (middle, high)
    return 0.5 * (low + high)


def main() -> None:
    """Print what both kinds of electrons give."""
    for electrons in ("steel-304", "iron"):
        print(f"{electrons}: melts from {melts_from(electrons):.3f} J/cm^2", flush=True)
        for fluence in ABOVE:
            hottest, depth = heated(case_of(fluence, electrons))
            print(f"{electrons}: {fluence} J/cm^2: {hottest:.0f} K, {1e9 * depth:.1f} nm")


if __name__ == "__main__":
    main()
