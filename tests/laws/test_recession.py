"""A surface that recedes in the solver of conduction: Landau's steady state, and its balances."""

import numpy as np
import pytest
from law_runs import go, host, imbalance, solver_of
from receding_metals import METALS, recession_of

from lasersph.compute import cpu

COLUMN = (
    *("solver.kind=conduction", "solver.dimensions=1", "solver.vaporization=flux"),
    *("boundaries.ambient_pressure=0 Pa", 'laser.beam={ kind = "uniform" }', "probes="),
    *("laser.fluence=", 'laser.pulse={ kind = "square", duration = "1 ms" }'),
    *('laser.absorption={ kind = "surface" }', "laser.reflectivity=0", "domain.extent=full"),
    *("particles.arrangement=uniform", "particles.ratio=", "domain.width="),
)


@pytest.mark.parametrize(
    ("metal", "flux", "share"), [("steel-304-demuth", 1e11, 0.01), ("aluminium-demuth", 6e10, 1e-3)]
)
def test_steady_recession(metal, flux, share):
    """Speed within 0.5 % and temperature within 5 K of the root, after seven D/v^2, neither of
    which depends on the conductivity; a run from cold is still 0.2 % slow then."""
    exact = recession_of(metal, flux, conductivity_share=share)
    spacing = exact.thermal_length / 12.0
    case, solver = solver_of(
        "dlip-steel",
        *COLUMN,
        f'material={{ base = "{metal}", conductivity = "{share * METALS[metal][2]} W/(m K)" }}',
        f"laser.intensity={flux} W/m^2",
        f"particles.spacing={spacing} m",
        f"domain.depth={120 * spacing} m",
        f"time.end={8 * exact.time} s",
        f"time.step={exact.time / 60} s",
    )
    go(solver, 6.0 * exact.time)
    start, gone, sum_of_T = solver.state.time, host(solver, "evaporated_mass")[0], 0.0
    while solver.state.time < 7.0 * exact.time:
        step = solver.step(min(solver.time_step_limits().values()))
        sum_of_T += step * host(solver, "temperature")[0]
    duration = solver.state.time - start
    speed = (host(solver, "evaporated_mass")[0] - gone) / exact.density / duration
    assert speed == pytest.approx(exact.speed, rel=5e-3)
    assert sum_of_T / duration == pytest.approx(exact.surface_temperature, abs=5.0)
    # the melting point lies where it should, within a cell
    molten = np.count_nonzero(host(solver, "melt_fraction") > 0.5) * spacing
    assert molten == pytest.approx(exact.melt_depth, abs=1.5 * spacing)
    assert imbalance(case, solver) < 1e-10


def test_columns_follow_apart_and_resume_bit_for_bit():
    """In 2-D each column by its own loss; from the arrays of a checkpoint the same bits."""
    settings = (
        *("solver.vaporization=flux", "laser.fluence=1.3 J/cm^2", "probes="),
        *("particles.spacing=100 nm", "domain.depth=3 um"),
    )
    case, solver = solver_of("dlip-steel", *settings)
    assert solver.recession is not None
    go(solver, 5.6e-8)
    assert solver.state.recession > 0.1
    arrays = {name: solver.backend.to_host(a).copy() for name, a in solver.fields.items()}
    _, again = solver_of("dlip-steel", *settings, backend=cpu(threads=1))
    again.restore(arrays, solver.checkpoint_scalars())
    for one in (solver, again):
        go(one, 5.9e-8)
    for name in ("enthalpy", "temperature", "evaporated_mass", "followed_mass"):
        assert np.array_equal(host(solver, name), host(again, name))
    lost = host(solver, "evaporated_mass")[solver.body.filling.surface]
    assert lost[0] > lost[5] > lost[-1] == 0.0
    # the sum of all energies closes, what the liquid took along included
    assert imbalance(case, solver) < 1e-9
    assert solver.state.energy["removed"] > 6.5e6 * np.mean(lost) * 2.525e-6


def test_step_is_limited_by_the_thickness_of_a_particle():
    """A quarter of it a step."""
    settings = ("solver.vaporization=flux", "particles.spacing=200 nm", "probes=")
    _, solver = solver_of("dlip-steel", *settings)
    assert "recession" not in solver.time_step_limits()
    solver.state.recession = 2.0
    thinnest = solver.body.filling.width[-1, 0]
    assert solver.time_step_limits()["recession"] == pytest.approx(0.25 * thinnest / 2.0)
