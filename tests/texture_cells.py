"""A made-up table of cells with a closed form, and the settings of a coarse texture."""

import numpy as np

from lasersph.lasers import GaussianBeam, SpotFluence
from lasersph.studies.texture.table import CellTable

PERIOD, LEAST, HIGHEST, AMBIENT = 5e-6, 2000.0, 6000.0, 300.0
COARSE = (
    "solver.flow.surface=moving",
    "material.base=steel-304-demuth",
    "material.surface_tension=1.6 N/m",
    "particles.spacing=100 nm",
    "time.step=400 ps",
    "time.end=90 ns",
    "output.snapshots.interval=4 ns",
    'laser.spot={diameter="30 um", definition="1/e^2"}',
)
"""Of dlip-steel."""


def relief(fluence, x):
    """Pits at the bright lines and rims beside them [m], whose depth grows with the square of the
    fluence above what melts."""
    above = np.maximum(np.asarray(fluence, float) - LEAST, 0.0) / (HIGHEST - LEAST)
    phase = 2.0 * np.pi * np.asarray(x, float) / PERIOD
    return -40e-9 * above**2 * (np.cos(phase) + 0.4 * np.cos(2.0 * phase))


def half_width(fluence):
    """From a bright line to the edge of its melt [m], of `pools`."""
    above = np.maximum(np.asarray(fluence, float) - LEAST, 0.0) / (HIGHEST - LEAST)
    return 0.3 * PERIOD * np.sqrt(above)


def pools(fluence, x):
    """Lines that end at the edges of their melt [m]: a pit and rims of the same volume."""
    fluence, x = np.broadcast_arrays(np.asarray(fluence, float), np.asarray(x, float))
    place = (x - PERIOD * np.round(x / PERIOD)) / np.maximum(half_width(fluence), 1e-12)
    shape = (1.0 - place**2) * (1.0 - 5.0 * place**2)  # whose integral from -1 to 1 is 0
    above = np.maximum(fluence - LEAST, 0.0) / (HIGHEST - LEAST)
    return np.where(np.abs(place) < 1.0, -40e-9 * above * shape, 0.0)


def table(cells=24, columns=200, relief=relief):
    """Cells evenly in fluence, from that which does not melt yet."""
    fluence = np.linspace(LEAST, HIGHEST, cells)
    x = (np.arange(columns) + 0.5) * PERIOD / columns
    above = np.maximum(fluence - LEAST, 0.0)[:, None] / HIGHEST * np.ones(columns)
    values = {
        "height": relief(fluence[:, None], x[None, :]),
        "melt_depth": 1e-6 * above,
        "temperature": AMBIENT + 0.3 * fluence[:, None] + np.zeros(columns),
        "speed": 10.0 * above,
    }
    return CellTable(fluence, x, PERIOD, values, AMBIENT)


def spot(diameter=50e-6, center=HIGHEST):
    """A Gaussian spot with this fluence at its center."""
    beam = GaussianBeam(diameter_1e2=diameter)
    return SpotFluence(beam, center * beam.area, diameter, "Gaussian", PERIOD)
