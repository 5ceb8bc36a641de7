"""Every step runs where NumPy cannot touch the particles' arrays."""

import numpy as np
import pytest
from law_runs import host, solver_of

from lasersph import compute

SETTINGS = ("particles.spacing=250nm", "particles.coarsest=1um", "solver.plateau=evaporate",
            "boundaries.convection=1e5 W/(m^2 K)", "boundaries.bottom=wall")  # fmt: skip


@pytest.mark.parametrize(
    "solver", ["scheme=implicit", "scheme=explicit", "iteration=published", "plateau=clip"]
)
def test_step_on_strict_arrays(solver):
    """One step in the light gives the bits of the ordinary backend."""
    results = []
    for backend in (compute.cpu(threads=2), compute.strict(threads=2)):
        _, found = solver_of("dlip-steel", *SETTINGS, f"solver.{solver}", backend=backend)
        found.state.time = 5e-8
        limits = found.time_step_limits()
        assert limits["end"] > 0.0
        found.step(1e-11)
        found.step(1e-11)
        results.append([host(found, name) for name in found.fields])
    assert results[0][0].max() > 0.0
    assert all(np.array_equal(a, b) for a, b in zip(*results, strict=True))


def test_pool_beside_coarse_columns():
    """Steps of a spot that melts and flows, with coarse columns beside it."""
    results = []
    for backend in (compute.cpu(threads=1), compute.strict(threads=1)):
        settings = ("particles.spacing=64nm", "particles.fine_width=3.4um", "domain.width=20um",
                    "particles.coarsest=3um", "solver.geometry=planar",
                    "solver.kind=melt-pool", "initial_temperature=1640 K")  # fmt: skip
        _, found = solver_of("spot-steel", *settings, backend=backend)
        found.state.time = 1.9e-8
        for _ in range(8):
            found.step(1e-10)
        assert found.fluid_count > 0.0
        results.append([backend.to_host(values) for values in found.fields.values()])
    assert all(np.array_equal(a, b) for a, b in zip(*results, strict=True))
