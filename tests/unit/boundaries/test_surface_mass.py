"""Mass that leaves a surface is taken from particles that can spare it."""

import numpy as np

from lasersph import compute
from lasersph.boundaries.surface import SurfaceStep
from lasersph.boundaries.surface_line import SurfaceLine
from lasersph.boundaries.surface_mass import take_volume

SPACING, COLUMNS, ROWS = 1e-8, 6, 30


def test_no_particle_is_used_up():
    """Three spacings leave one column, a fiftieth in each step: of no particle more than half, from
    no other column, and in sum just these."""
    backend = compute.cpu(threads=1)
    x = (np.arange(COLUMNS * ROWS) % COLUMNS + 0.5) * SPACING
    depth = (np.arange(COLUMNS * ROWS) // COLUMNS + 0.5) * SPACING
    volume = backend.asarray(np.full(x.size, SPACING**2))
    now = SurfaceStep(
        T=volume,
        position=backend.asarray(np.array([x, -depth])),
        velocity=backend.zeros((2, x.size)),
        volume=volume,
        flows=backend.asarray(np.ones(x.size)),
        interval=(0.0, 1.0),
        evaporated=volume,
    )
    line = SurfaceLine(0.0, SPACING, COLUMNS, ("mirror", "mirror"), 30 * SPACING)
    gone = np.zeros(COLUMNS)
    lost = np.where(np.arange(COLUMNS) == 2, 0.02 * SPACING, 0.0)
    for _ in range(150):
        gone += lost
        take_volume(backend, now, backend.asarray(depth), line, lost, gone, SPACING)
    left = backend.to_host(volume).reshape(ROWS, COLUMNS) / SPACING**2
    assert np.all(left[:, np.arange(COLUMNS) != 2] == 1.0)
    assert abs(ROWS - left[:, 2].sum() - 3.0) < 1e-9
    assert left.min() > 0.5
    assert np.all(np.diff(left[:, 2]) >= 0.0)
