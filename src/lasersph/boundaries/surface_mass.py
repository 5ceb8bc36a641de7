"""Mass that leaves a surface that moves: its volume, enthalpy and momentum, from the melt below.

The vapor takes mass from the top of each column, with the enthalpy and the velocity of the
uppermost particle, at whose temperature it leaves. The particles below share the loss: those within
a reach shrink by one part s, sink with the surface, and the melt moves up through their faces by
what those below have lost,

    F = s sum of V below a face,    m' = m - rho (F_top - F_bottom)
    m' h' = m h + rho (F_bottom h_below - F_top h)

upwind, and the same for v. So all that leaves the fields is what leaves the surface, to rounding.

Particles that keep their volume would be too dense below a surface that recedes, and part again by
a flow of their own: a wave of mass flux over a film of steel was 2.5 % off after five times its
duration; so it is 0.5 %. Where more leaves, it is taken from deeper: taken from two rows at the
surface alone, particles of steel at 1 J/cm2, from which a spacing of metal evaporates, had nothing
left, and their flow burst.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lasersph.boundaries import surface_loops as loops
from lasersph.boundaries.surface import SurfaceStep
from lasersph.boundaries.surface_line import SurfaceLine
from lasersph.compute.array_types import Array, Constants
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import vector
from lasersph.particles.neighbor_lists import members_of

SHARE = 8.0
"""Depth from which mass is taken, over the thickness that has left. Derived: a share of 1 / S of
the depth reached leaves with each further thickness, so that after g spacings the smallest particle
keeps (1.5 / (e S g))^(1/S) of its volume: with 8 it has 0.6 (`WORN`, where layouts are renewed)
after 4 spacings, with 4 after one; 0.62 after three (tested)."""
CATCH_UP = 0.05
"""How much more a step takes, over its share, of what longer steps before it have evaporated.
Study: the least that ends a delay; with 0.1 steps of a third of the length change the temperature
of steel under 1e11 W/m2 by 2.6 K, with 0.05 by 1.2 K."""
MIN_VOLUME_RATIO = 0.2
"""Part of its volume that a particle keeps in a step in which mass leaves, at least. Guard: mass
that leaves takes less than a thousandth of a row in a step."""


def recede(
    i,
    column,
    x,
    V,
    m,
    h,
    v,
    row_start,
    member,
    depth,
    V_j,
    h_j,
    u_j,
    w_j,
    share,
    columns,
    inverse,
    density,
):
    """Place [m], volume [m^2], mass [kg/m], enthalpy [J/kg] and velocity [m/s] of a particle after
    its column has lost mass, and the heat that it has lost by that [J/m].

    Args:
        i, column: its number and that of its column. row_start, member: particles of each column
            within reach. depth, V_j, h_j, u_j, w_j: of all. share: s of each column. columns: their
            number; that of particles beyond reach. inverse: 1 / width of a column [1/m].
    """
    if column >= columns:
        return 1.0 * x, 1.0 * V, 1.0 * m, 1.0 * h, 1.0 * v, 0.0
    # volume within reach, volume above the particle, and its upper and lower neighbor
    s, total, above, upper, lower = share[column], 0.0, 0.0, -1, -1
    for p in range(row_start[column], row_start[column + 1]):
        j = member[p]
        total += V_j[j]
        if depth[j] < depth[i] or (depth[j] == depth[i] and j < i):
            above += V_j[j]
            if upper < 0 or depth[j] >= depth[upper]:
                upper = j
        elif j != i and (lower < 0 or depth[j] < depth[lower]):
            lower = j
    # upwind: from below where mass leaves, from above where it arrives
    source, entering = lower, s * (total - above - V)
    if s < 0.0:
        source, entering = upper, s * (above - total)
    if source < 0:
        source = int(i)

    # the particle shrinks, and its enthalpy and velocity mix with those that enter, m' h'
    left = (1.0 - s) * V
    mass = m - density * s * V
    enthalpy = h + density * entering / mass * (h_j[source] - h)
    change = vector(u_j[source] - v[0], w_j[source] - v[1])

    # it sinks by what has left below its middle
    place = vector(x[0], x[1] - s * inverse * (total - above - 0.5 * V))
    return place, left, mass, enthalpy, v + entering / left * change, m * h - mass * enthalpy


def part_due(step: float, delay: float) -> tuple[float, float]:
    """Part of what has evaporated and is still in the melt that leaves in a step, and the time in
    which what is then still there has evaporated [s].

    Steps of one length take all that the one before has evaporated. A shorter one that took as much
    would cool the surface: steel under 1e11 W/m2 by 18 K. It takes what evaporates in its own time,
    and a little more, so that steps that stay short do not stay late.

    Args:
        step: [s]. delay: that time before the step [s].
    """
    taken = (1.0 + CATCH_UP) * step
    return (1.0, step) if taken >= delay else (taken / delay, delay - CATCH_UP * step)


def take_mass(
    backend: Backend,
    now: SurfaceStep,
    depth: Array,
    line: SurfaceLine,
    lost: NDArray[np.float64],
    gone: NDArray[np.float64],
    spacing: float,
    density: float,
) -> float:
    """Take what has left each column from the particles below; returns the heat it had [J/m].

    Args:
        depth: (n,) below the line [m]. lost: (columns,) thickness that has left in the step [m].
        gone: (columns,) since the start [m]. spacing: of the particles [m]. density: [kg/m^3].
    """
    count, inverse = line.count, 1.0 / line.width
    # particles within reach of the surface, by column
    reach = backend.asarray(np.maximum(loops.TEMPERATURE_DEPTH * spacing, SHARE * gone))
    grid: Constants = {"start": line.start, "inverse": inverse, "columns": float(count)}
    fields = {"x": now.position, "depth": depth, "flows": now.flows}
    column, found = backend.zeros(now.flows.shape[0], "index"), backend.zeros(count)
    backend.pointwise(loops.at_column, fields, column, **grid, reach=reach)
    members = members_of(backend, column, count)

    # the part s of them that is lost, bounded
    places = {"k": backend.asarray(np.arange(count), "index")}
    tables: Constants = {"row_start": members.row_start, "member": members.neighbor}
    backend.pointwise(loops.thickness_of, places, found, **tables, V=now.volume, inverse=inverse)
    thickness = np.maximum(backend.to_host(found), MIN_VOLUME_RATIO * spacing)
    share = np.clip(lost / thickness, 1.0 - 1.0 / MIN_VOLUME_RATIO, 1.0 - MIN_VOLUME_RATIO)
    # what particles have now, as fields and as tables of their neighbors in the column
    old = now.position, now.volume, now.mass, now.enthalpy, now.velocity
    new = tuple(backend.zeros(values.shape) for values in old)
    number = backend.asarray(np.arange(now.flows.shape[0]), "index")
    fields = {"i": number, "column": column} | dict(zip("xVmhv", old, strict=True))
    tables |= {"depth": depth, "V_j": now.volume, "h_j": now.enthalpy}
    tables |= {name: backend.component(now.velocity, k) for k, name in enumerate(("u_j", "w_j"))}
    tables |= {"share": backend.asarray(share), "columns": float(count)}

    # m', h' and v' of every particle from the values before, and the heat that leaves in all
    tables |= {"inverse": inverse, "density": density}
    sums = (*(None for _ in new), "sum")
    (heat,) = backend.pointwise(recede, fields, (*new, None), reduce=sums, **tables)
    for values, target in zip(new, old, strict=True):
        backend.copy(values, target)
    return heat
