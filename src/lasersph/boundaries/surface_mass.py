"""Volume of what leaves a surface that moves, taken from the particles at it.

Else they would be too dense below a surface that recedes, and part again by a flow of their own: a
wave of mass flux over a film of steel was 2.5 % off after five times its duration; so it is 0.5 %.

Where more leaves, it is taken from deeper: taken from two rows at the surface alone, particles of
steel at 1 J/cm2, from which a spacing of metal evaporates, had nothing left, and their flow burst.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lasersph.boundaries import surface_loops as loops
from lasersph.boundaries.surface import SurfaceStep
from lasersph.boundaries.surface_line import SurfaceLine
from lasersph.compute.array_types import Array, Constants
from lasersph.compute.backend import Backend
from lasersph.particles.neighbor_lists import members_of

SHARE = 8.0
"""Depth from which mass is taken, over the thickness that has left: where three spacings have, no
particle has lost more than half."""
LEAST_ROW = 0.2
"""Part of its volume that a particle keeps in a step in which mass leaves, at least."""


def take_volume(
    backend: Backend,
    now: SurfaceStep,
    depth: Array,
    line: SurfaceLine,
    lost: NDArray[np.float64],
    gone: NDArray[np.float64],
    spacing: float,
) -> None:
    """Take what has left each column from the volume of its particles at the surface.

    Args:
        depth: (n,) below the line [m]. lost: (columns,) thickness that has left in the step [m].
        gone: (columns,) since the start [m]. spacing: of the particles [m].
    """
    count, inverse = line.count, 1.0 / line.width
    reach = backend.asarray(np.maximum(loops.ROW * spacing, SHARE * gone))
    grid: Constants = {"start": line.start, "inverse": inverse, "columns": float(count)}
    grid |= {"reach": reach}
    fields = {"x": now.position, "depth": depth, "flows": now.flows}
    key, found = backend.zeros(now.flows.shape[0], "index"), backend.zeros(count)
    backend.pointwise(loops.at_column, fields, key, **grid)
    members = members_of(backend, key, count)
    places = {"k": backend.asarray(np.arange(count), "index")}
    tables = {"row_start": members.row_start, "member": members.neighbor, "V": now.volume}
    backend.pointwise(loops.thickness_of, places, found, **tables, inverse=inverse)
    thickness = np.maximum(backend.to_host(found), LEAST_ROW * spacing)
    kept = backend.asarray(np.clip(1.0 - lost / thickness, LEAST_ROW, 1.0 / LEAST_ROW))
    fields["V"] = now.volume
    backend.pointwise(loops.thinner, fields, now.volume, **grid, kept=kept)
