"""Volume that flows through the sides of the columns below a moving surface, per time."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lasersph.compute.array_types import Constants
from lasersph.compute.backend import Backend
from lasersph.particles.neighbor_lists import members_of
from lasersph.surface import loops
from lasersph.surface.height_field import HeightField
from lasersph.surface.surface import SurfaceStep

HostArray = NDArray[np.float64]


def volume_flux(
    backend: Backend, line: HeightField, bottom: float, now: SurfaceStep, ends: Constants
) -> HostArray:
    """Q = mean velocity of the particles around a side times the melt there (count + 1,) [m^2/s].

    Args:
        bottom: z of the wall below [m]. ends: start, inverse width and number of the columns, kinds
            of the ends.
    """
    # particles above the wall below, solid ones as well, by column
    key = backend.zeros(now.flows.shape[0], "index")
    grid = {"start": ends["start"], "inverse": ends["inverse"], "columns": float(line.count)}
    backend.pointwise(loops.column_above, {"x": now.position}, key, **grid, bottom=bottom)
    members = members_of(backend, key, line.count)

    # mean velocity around each side, and how thick the solid is there
    found = backend.zeros(line.count + 1), backend.zeros(line.count + 1)
    tables = {"row_start": members.row_start, "member": members.neighbor, "V": now.volume}
    tables |= {"x": now.position, "v": now.velocity, "flows": now.flows}
    places = {"k": backend.asarray(np.arange(line.count + 1), "index")}
    backend.pointwise(loops.mean_velocity, places, found, **tables, **ends)
    mean, solid = (backend.to_host(values) for values in found)

    # the melt stands from the wall, over the solid, to the mean height of both columns
    height = line.extend(line.height)[1:-1]
    return mean * np.maximum(0.5 * (height[1:] + height[:-1]) - bottom - solid, 0.0)


def flux_through(part: HeightField, columns: NDArray[np.int64], flux: HostArray) -> HostArray:
    """Q through the sides of a part of the line, none through ends that are no period [m^2/s]."""
    sides = flux[np.append(columns, columns[-1] + 1)]
    # an end that is a wall, a plane of symmetry or the edge of a pool lets nothing through
    if part.ends[0][0] != "periodic":
        sides[[0, -1]] = 0.0
    return sides
