"""Vapor that leaves as a flux: its heat is L_v times its mass, in particles at rest and in flow."""

import numpy as np
import pytest
from law_runs import budget, go, imbalance, solver_of

LATENT = 6.5e6
DENSITY = 7262.0
CASE = (
    *("laser.fluence=1.3 J/cm^2", "domain.depth=3 um", "probes="),
    *("particles.spacing=100 nm", "particles.arrangement=uniform", "particles.ratio="),
    "material.vaporization.critical_temperature=1e9 K",
)
FLAT = {
    "conduction": ("solver.plateau=evaporate",),
    "melt-pool": ("solver.vaporization=flux", "boundaries.ambient_pressure=1 atm"),
}
"""Of both, the rule under which the metal does not follow what has evaporated."""


@pytest.mark.parametrize("kind", FLAT)
def test_heat_is_latent_heat_times_mass(kind):
    """A metal without a critical temperature has a constant L_v: what the steps book as removed is
    L_v times the mass that columns have lost, and the balance of the fields closes."""
    case, solver = solver_of("dlip-steel", *CASE, f"solver.kind={kind}", *FLAT[kind])
    go(solver, 6.2e-8)
    columns = solver.body.filling.surface
    mass = solver.backend.to_host(solver.particles["evaporated_mass"])
    assert not np.delete(mass, columns).any()
    # the crest of the light loses some nanometers, its trough nothing
    assert 1e-9 < mass[0] / DENSITY < 1e-7 and mass[columns[-1]] < 1e-3 * mass[0]
    ((left, right),) = case.domain.lateral(case.geometry)
    lost = float(np.mean(mass[columns])) * 2.0 * (right - left)  # of the whole period
    # T_c of 1e9 K leaves 1e-6 of a change in L_v
    removed = budget(case, solver)["energy_removed_J"]
    assert removed == pytest.approx(LATENT * lost, rel=3e-6)
    assert imbalance(case, solver) < (1e-9 if kind == "conduction" else 1e-5)
    assert (kind == "conduction") or solver.flow.largest_speed > 0.5
