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
