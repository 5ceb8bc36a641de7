"""The fluence of one pulse as maps: of a few periods of the pattern, and of the whole spot."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lasersph.lasers.laser import Laser

Array = NDArray[np.float64]
POINTS = 301
"""Pixels along each side of a map."""
PERIODS, DIAMETERS = 2.0, 1.5
"""Sides of the maps, over the period of the pattern and the diameter of the spot."""


@dataclass(frozen=True)
class FluenceMap:
    """Means over square pixels.

    Attributes:
        x, y: centers of the pixels [m]. fluence: (y, x) [J/m^2]. words: what it is.
    """

    x: Array
    y: Array
    fluence: Array
    words: str


def fluence_maps(laser: Laser) -> list[FluenceMap]:
    """Of some periods of the pattern at the place of the cell, and of the whole spot.

    Raises:
        ValueError: a uniform beam without a spot has nothing to draw.
    """
    maps, beam = [], laser.beam
    if beam.is_pattern:
        # a pattern without a period along x is drawn over some of its changes
        x = beam.lateral_period or beam.lateral_period_y or PERIODS * np.pi * beam.scale
        low, high, shape = _pixels(PERIODS * x, PERIODS * (beam.lateral_period_y or x))
        means = laser.unit_fluence * beam.cell_means(low, high, np.zeros(2))
        maps.append(_map(low, high, means.reshape(shape), "pattern"))
    if laser.spot is not None or beam.area is not None:
        local = laser.spot_fluence
        # the envelope scaled to the energy of the pulse, and the pattern on it
        low, high, shape = _pixels(*(2 * (DIAMETERS * local.diameter,)))
        means = (
            local.energy / local.envelope.area * local.envelope.cell_means(low, high, np.zeros(2))
        )
        if beam.is_pattern:
            means = means * beam.cell_means(low, high, np.zeros(2))
        maps.append(_map(low, high, means.reshape(shape), "spot"))
    if not maps:
        raise ValueError("a uniform beam without a spot is the same everywhere")
    return maps


def _pixels(width: float, breadth: float) -> tuple[Array, Array, tuple[int, int]]:
    """Corners of the pixels of a map around the axis, shapes (2, n), and its shape (y, x)."""
    edges = np.linspace(-0.5, 0.5, POINTS + 1)
    low, high = (
        np.stack([a.ravel() for a in np.meshgrid(width * side, breadth * side)])
        for side in (edges[:-1], edges[1:])
    )
    return low, high, (POINTS, POINTS)


def _map(low: Array, high: Array, fluence: Array, words: str) -> FluenceMap:
    x, y = (0.5 * (low + high)).reshape(2, *fluence.shape)
    return FluenceMap(x[0], y[:, 0], fluence, words)
