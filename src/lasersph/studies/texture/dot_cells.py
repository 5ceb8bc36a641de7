"""The unit cell of a run in 3-D: heights, depths, temperature and speed over x and y of a period.

Temperature and speed are the largest that surface.vtkhdf has at a column, ever; the depth of the
melt is found below each column as that of a line (`cells`).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from lasersph.lasers import InterferenceBeam
from lasersph.output import OutputError, Run
from lasersph.output.height_map import whole_map
from lasersph.studies.texture.cells import (
    PERIOD_FITS,
    Cell,
    depth_below,
    largest_of_particles,
    read_cell,
)

Array = NDArray[np.float64]


def read_any_cell(run: Run, period: float) -> Cell:
    """The cell of a complete run in 2-D or 3-D over one period [m]. Raises OutputError."""
    return read_dot_cell(run, period) if run.dimensions == 3 else read_cell(run, period)


def read_dot_cell(run: Run, period: float) -> Cell:
    """The cell of a complete run in 3-D over one period, its half or its quarter.

    Args:
        period: of the pattern along x [m]; that along y is of the beam of its case.

    Raises:
        OutputError: no surface that moved, no snapshots, or another width or breadth.
    """
    if not len(run.surface) or not len(run.snapshots):
        raise OutputError(f"{run.path} holds no surface that moved")
    shape = run.surface.shape
    x, y, z = (values.reshape(shape) for values in run.surface[-1]["position"])
    axes = x[:, 0], y[0]
    sides = [float(axis[1] - axis[0]) * axis.size for axis in axes]
    # one period along x and along y, with the mirror images of what was computed
    beam = InterferenceBeam.model_validate(run.case["laser"]["beam"])
    periods = (period, beam.lateral_period_y or period)
    names = ("wide", "long along y")
    for side, mirror, wanted, word in zip(sides, run.mirrored, periods, names, strict=True):
        whole = 2.0 * side if mirror else side
        if abs(whole - wanted) > PERIOD_FITS * wanted:
            raise OutputError(f"{run.path} is {whole:g} m {word}, not one period of {wanted:g} m")

    # largest values over the snapshots, of the surface and of particles
    steps = list(run.surface)
    values = {
        "height": np.asarray(z, float),
        "melt_depth": melt_depths(run, axes),
        "temperature": np.max([step["temperature"] for step in steps], axis=0).reshape(shape),
        "speed": np.max([step["speed"] for step in steps], axis=0).reshape(shape),
    }
    # the whole period, in the order of its phase
    every = {name: whole_map(*axes, one, run.mirrored) for name, one in values.items()}
    x, y, _ = every["height"]
    order = [
        np.argsort(axis % side, kind="stable") for axis, side in zip((x, y), periods, strict=True)
    ]
    ordered = {name: np.array(one, float)[np.ix_(*order)] for name, (*_, one) in every.items()}
    is_solid = not run.summary.get("melt", {}).get("molten_at_end", False)
    return Cell((x % periods[0])[order[0]], ordered, is_solid, (y % periods[1])[order[1]])


def melt_depths(run: Run, axes: tuple[Array, Array]) -> Array:
    """Depths (nx, ny) [m] down to which half has ever been molten, below columns at places (nx,),
    (ny,) [m]. Raises OutputError where particles come or go."""
    first: dict[str, Any] = run.snapshots[0]
    melted, hottest = largest_of_particles(run)
    # column of each particle, x slowest
    numbers = [
        np.floor((place - axis[0]) / (axis[1] - axis[0]) + 0.5).astype(int).clip(0, axis.size - 1)
        for place, axis in zip(first["position"][:2], axes, strict=True)
    ]
    shape = (axes[0].size, axes[1].size)
    column = numbers[0] * shape[1] + numbers[1]
    material = run.summary["material"]
    melting = 0.5 * (material["solidus_K"] + material["liquidus_K"])
    found = depth_below(column, shape[0] * shape[1], first, melted, hottest, melting)
    return found.reshape(shape)
