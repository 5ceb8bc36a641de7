"""A uniform beam on a slab is the same problem in 1-D, 2-D and 3-D."""

import numpy as np
import pytest
from law_runs import go, host, solver_of

UNIFORM = ("laser.beam={kind='uniform'}", "probes=", "domain.width=600nm", "domain.extent=full",
           "domain.depth=3um", "particles.spacing=100nm", "time.step=0.25ns")  # fmt: skip
END = 6e-8


def profile(dimensions, *settings):
    """Temperature of each layer, after a check that a layer is even."""
    _, solver = solver_of("dlip-steel", *UNIFORM, f"solver.dimensions={dimensions}", *settings)
    go(solver, END)
    layer = solver.body.filling.layer[: solver.body.count]
    T = host(solver, "temperature")
    mean = np.bincount(layer, T) / np.bincount(layer)
    return mean, np.abs(T - mean[layer]).max(), solver.body.filling


@pytest.mark.parametrize("arrangement", ["graded", "uniform"])
def test_same_temperatures(arrangement):
    """Corrected weights: layers agree within 0.5 % of the rise of the surface, and are even."""
    settings = (f"particles.arrangement={arrangement}",)
    settings += ("particles.ratio=",) if arrangement == "uniform" else ()
    line, *_ = profile(1, *settings)
    rise = line[0] - 298.15
    assert rise > 1000.0
    for dimensions in (2, 3):
        found, uneven, _ = profile(dimensions, *settings)
        assert found == pytest.approx(line, abs=5e-3 * rise)
        assert uneven < (1e-3 if arrangement == "uniform" else 5e-3) * rise
