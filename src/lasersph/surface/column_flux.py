"""Volume that flows through the sides of the columns below a moving surface, per time."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lasersph.compute.array_types import Array, Constants
from lasersph.compute.backend import Backend
from lasersph.particles.neighbor_lists import members_of
from lasersph.surface import column_loops, loops
from lasersph.surface.height_field import HeightField
from lasersph.surface.surface import SurfaceStep

HostArray = NDArray[np.float64]


def volume_flux(
    backend: Backend,
    line: HeightField,
    bottom: float,
    now: SurfaceStep,
    columns: Constants,
    ends: Constants,
) -> tuple[HostArray, ...]:
    """Q = mean velocity of the particles around a side times the melt there [m^2/s], for each axis,
    along which there is one side more than columns.

    Args:
        bottom: z of the wall below [m]. columns: start, inverse width and number of the columns.
            ends: kinds of the ends.
    """
    # particles above the wall below, solid ones as well, by column
    key = backend.zeros(now.flows.shape[0], "index")
    backend.pointwise(loops.column_above, {"x": now.position}, key, **columns, bottom=bottom)
    members = members_of(backend, key, line.count)
    tables: Constants = {"row_start": members.row_start, "member": members.neighbor}
    tables |= {"V": now.volume, "x": now.position, "v": now.velocity, "flows": now.flows}

    found = []
    for axis in range(len(line.shape)):
        # mean velocity around each side, and how thick the solid is there
        shape = tuple(n + (other == axis) for other, n in enumerate(line.shape))
        sides = int(np.prod(shape))
        along = tuple(float(other == axis) for other in range(len(shape)))
        out = backend.zeros(sides), backend.zeros(sides)
        places: dict[str, Array] = {"k": backend.asarray(np.arange(sides), "index")}
        loop = column_loops.mean_velocity
        backend.pointwise(loop, places, out, **tables, along=along, **columns, **ends)
        mean, solid = (backend.to_host(values).reshape(shape) for values in out)

        # the melt stands from the wall, over the solid, to the mean height of both columns
        height = np.moveaxis(line.extend(line.height, axis=axis), axis, 0)[1:-1]
        between = np.moveaxis(0.5 * (height[1:] + height[:-1]), 0, axis)
        found.append(mean * np.maximum(between - bottom - solid, 0.0))
    return tuple(found)
