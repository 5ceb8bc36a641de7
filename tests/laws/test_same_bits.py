"""Results do not depend on the number of threads, to the last bit."""

import numpy as np
import pytest
from law_runs import go, host, solver_of

from lasersph.compute.launch import SHARED


@pytest.mark.parametrize("scheme", ["implicit", "explicit"])
def test_threads(scheme):
    """One thread and two: the same fields, energies and steps. More pairs than one thread does."""
    results = []
    for threads in (1, 2):
        _, solver = solver_of("dlip-steel", "particles.spacing=20nm", f"solver.scheme={scheme}",
                              "solver.plateau=evaporate", "laser.fluence=1.2 J/cm^2",
                              threads=threads)  # fmt: skip
        assert solver.body.pairs.weights.size > SHARED
        solver.state.time = 4.8e-8
        steps = go(solver, 4.82e-8)
        results.append(
            (steps, solver.checkpoint_scalars(), [host(solver, name) for name in solver.fields])
        )
    (steps, numbers, fields), (steps_two, numbers_two, fields_two) = results
    assert steps == steps_two > 2
    assert numbers == numbers_two
    assert all(np.array_equal(a, b) for a, b in zip(fields, fields_two, strict=True))
