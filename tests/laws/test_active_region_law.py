"""Inactive cold matter changes nothing: craters with and without it are the same."""

import numpy as np
import pytest

from lasersph import compute
from lasersph.case import load_case
from lasersph.particles.kinds import LEAVING
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.step_control import binding_limit

SPOT = ("solver.dimensions=2", "particles.spacing=0.2 um", "domain.depth=12 um",
        "domain.width=6 um", "laser.fluence=20 J/cm2", "time.end=4 ns")  # fmt: skip
UNIFORM = ("solver.dimensions=1", "particles.spacing=0.1 um", "laser.fluence=20 J/cm2",
           "time.end=8 ns")  # fmt: skip
TOP_HAT = ("laser.beam.kind=top-hat", "laser.beam.radius=1.5 um")
PUBLISHED = ("solver.ejection.model=published", "solver.ejection.preset=timeline")


def computed(*settings):
    """The solver after its run."""
    case = load_case("ablation-depth", list(settings))
    solver = recipe_of(case).build(compute.cpu(threads=1))
    while solver.state.time < case.time.end * (1.0 - 1e-12):
        solver.step(binding_limit(solver.time_step_limits())[1])
    return solver


@pytest.mark.parametrize(
    "settings",
    [UNIFORM, (*UNIFORM, *PUBLISHED), (*SPOT, *TOP_HAT)],
    ids=["enthalpy", "published", "spot"],
)
def test_inactive_matter_changes_nothing(settings):
    """Temperatures agree within 1e-8 of the rise, and the same particles have left."""
    partial, whole = computed(*settings), computed(*settings, "solver.active_region=false")
    assert whole.region is None and partial.region.active_count < 0.95 * partial.particles.capacity
    assert partial.state.ejecta.number == whole.state.ejecta.number > 0
    T, expected = (s.backend.to_host(s.particles["temperature"]) for s in (partial, whole))
    kind, other = (s.backend.to_host(s.particles["kind"]) for s in (partial, whole))
    np.testing.assert_array_equal(kind, other)
    body = kind <= LEAVING
    rise = expected[body].max() - 300.0
    assert np.abs(T - expected)[body].max() < 1e-8 * rise
    assert partial.state.energy["removed"] == pytest.approx(whole.state.energy["removed"], rel=1e-9)
