"""What is said of a flow that has become unstable."""

from types import SimpleNamespace

import numpy as np
import pytest

from lasersph import compute
from lasersph.solvers.melt_pool.instability import refuse_unstable
from lasersph.solvers.step_control import NotConverged


@pytest.mark.parametrize("place, words", [
    ([1e-6, -2e-8], r"at x = 1 um, z = -20 nm;"),
    ([1e-6, 3e-7, -2e-8], r"at x = 1 um, y = 300 nm, z = -20 nm;"),
])  # fmt: skip
def test_place_of_the_fastest_particle_has_as_many_numbers_as_axes(place, words):
    """Of two particles the second is beyond what can be."""
    velocity = np.zeros((len(place), 2))
    velocity[0, 1] = 2e3
    backend = compute.cpu(1)
    flow = SimpleNamespace(largest_speed=2e3, velocity=velocity, backend=backend)
    domain = SimpleNamespace(surface=SimpleNamespace(largest_speed=1e3), support=1e-7)
    position = np.stack([np.zeros(len(place)), place], axis=1)
    with pytest.raises(NotConverged, match=words):
        refuse_unstable(flow, domain, position, 1e-9)
