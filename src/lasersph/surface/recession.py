"""Recession of a surface by the vapor that leaves it: what has evaporated, below it is missing.

**A body at rest** (`Recession`). Particles stay where they are below the surface, and the metal
moves up through them, in each column by the thickness that its top loses in the step:

    m dh_i = dM (h_below - h_top),    h_top = h_i + (1 - dM/m)/2 slope_i

dM is the mass that passes through a face of the column in the step, h_top what the metal carries
through the upper face, with van Leer's slope of the column [vanLeer1974]: second order, and no new
extremes. The vapor takes h of the uppermost particle, at whose temperature it leaves, so that a
steady surface has exactly q = m (h + L_v). Nothing enters a column whose lowest particle is cold.
The surface lies at z = 0 all the time, so that light and losses meet it where it is. Left out:
conduction along x between columns that have receded by different lengths goes straight across, as
if slopes were small; of graded layers only those with the columns of the surface follow.

**Melt below a surface that moves** (`take_mass`). The vapor takes mass from the top of each column,
with the enthalpy and the velocity of the uppermost particle, at whose temperature it leaves. The
particles below share the loss: those within a reach shrink by one part s, sink with the surface,
and the melt moves up through their faces by what those below have lost,

    F = s sum of V below a face,    m' = m - rho (F_top - F_bottom)
    m' h' = m h + rho (F_bottom h_below - F_top h)

upwind, and the same for v. So all that leaves the fields is what leaves the surface, to rounding.

Particles that keep their volume would be too dense below a surface that recedes, and part again by
a flow of their own: a wave of mass flux over a film of steel was 2.5 % off after five times its
duration; so it is 0.5 %. Where more leaves, it is taken from deeper: taken from two rows at the
surface alone, particles of steel at 1 J/cm2, from which a spacing of metal evaporates, had nothing
left, and their flow burst.

Reference: [vanLeer1974] J. Comput. Phys. 14, 361.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from lasersph.compute.array_types import Array, Constants
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import same, vector
from lasersph.particles.filling import Filling
from lasersph.particles.neighbor_lists import members_of
from lasersph.particles.particles import Particles
from lasersph.surface import loops
from lasersph.surface.column_loops import thickness_of
from lasersph.surface.forcing import SurfaceForcing
from lasersph.surface.height_field import HeightField
from lasersph.surface.pools import SurfacePools
from lasersph.surface.segments import SurfaceSegments
from lasersph.surface.surface import SurfaceStep
from lasersph.surface.surface_fit import TEMPERATURE_DEPTH

SHARE = 8.0
"""Depth from which mass is taken, over the thickness that has left. Derived: a share of 1 / S of
the depth reached leaves with each further thickness, so that after g spacings the smallest particle
keeps (1.5 / (e S g))^(1/S) of its volume: with 8 it has 0.6 (where layouts are renewed, see
`layout_renewal`) after 4 spacings, with 4 after one; 0.62 after three (tested)."""
CATCH_UP = 0.05
"""How much more a step takes, over its share, of what longer steps before it have evaporated.
Study: the least that ends a delay; with 0.1 steps of a third of the length change the temperature
of steel under 1e11 W/m2 by 2.6 K, with 0.05 by 1.2 K."""
MIN_VOLUME_RATIO = 0.2
"""Part of its volume that a particle keeps in a step in which mass leaves, at least. Guard: mass
that leaves takes less than a thousandth of a row in a step."""
COURANT = 0.25
"""Share of a particle's thickness by which the metal may move in a step. Accuracy: stability needs
1; the temperature of the surface falls within a step by this share of its difference to the next
particle."""


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
    v_j,
    share,
    columns,
    inverse_area,
    density,
):
    """Place [m], volume [m^2], mass [kg/m], enthalpy [J/kg] and velocity [m/s] of a particle after
    its column has lost mass, and the heat that it has lost by that [J/m].

    Args:
        i, column: its number and that of its column. row_start, member: particles of each column
            within reach. depth, V_j, h_j, v_j: of all. share: s of each column. columns: their
            number; that of particles beyond reach. inverse_area: of a column [1/m^(d-1)].
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

    # it sinks by what has left below its middle
    sunk = s * inverse_area * (total - above - 0.5 * V)
    place = vector(*(x[k] for k in range(len(x) - 1)), x[-1] - sunk)
    return (
        place,
        left,
        mass,
        enthalpy,
        v + entering / left * (v_j[source] - v),
        m * h - mass * enthalpy,
    )


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


class MassLoss:
    """Mass that leaves the columns of a surface that moves: imposed, or evaporated by heat.

    Args:
        columns: their number. density: m/V of the particles [kg/m^3].

    Attributes:
        followed: (columns,) evaporated mass per area seen from above that has left [kg/m^2].
        lost: (columns,) thickness that leaves in the step [m]. volume: that has left so far
            [m^2], of rings [m^3]. delay: time in which what is still there has evaporated [s].
    """

    def __init__(self, columns: int, density: float, forcing: SurfaceForcing) -> None:
        self.density = density
        self.forcing = forcing
        self.followed = np.zeros(columns)
        self.lost = np.zeros(columns)
        self.volume = 0.0
        self.delay = 0.0

    def begin_step(
        self, backend: Backend, now: SurfaceStep, segments: SurfaceSegments | SurfacePools
    ) -> None:
        """Find what leaves each column that moves in a step."""
        whole, (begin, end) = segments.whole, now.interval
        self.lost = np.zeros(whole.count)
        due, self.delay = part_due(end - begin, self.delay)
        for columns, line in segments.parts:
            mass = np.zeros(columns.size)

            # what is imposed leaves through the true length of the surface
            if (wave := self.forcing.mass_flux) is not None:
                S = line.length_ratio
                mass = ((end - begin) * S * wave.mean_over(line.places, begin, end)).ravel()

            # the part due of what heat has evaporated before
            if self.forcing.recoil is not None:
                gone = backend.to_host(backend.head(now.evaporated, whole.count))
                vapor = due * (gone - self.followed)[columns]
                self.followed = self.followed.copy()
                self.followed[columns] += vapor
                mass = mass + vapor
            self.lost[columns] = mass / self.density
        self.volume += whole.volume_of(self.lost.reshape(whole.shape))


def take_mass(
    backend: Backend,
    now: SurfaceStep,
    depth: Array,
    line: HeightField,
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
    count = line.count
    # particles within reach of the surface, by column
    reach = backend.asarray(np.maximum(TEMPERATURE_DEPTH * spacing, SHARE * gone))
    grid: Constants = {"start": line.start, "inverse_width": line.inverse_widths}
    grid |= {"columns": tuple(map(float, line.shape))}
    fields = {"x": now.position, "depth": depth, "flows": now.flows}
    column, found = backend.zeros(now.flows.shape[0], "index"), backend.zeros(count)
    backend.pointwise(loops.at_column, fields, column, **grid, reach=reach)
    members = members_of(backend, column, count)

    # the part s of them that is lost, bounded
    places = {"k": backend.asarray(np.arange(count), "index")}
    tables: Constants = {"row_start": members.row_start, "member": members.neighbor}
    tables |= {"inverse_area": line.inverse_area}
    backend.pointwise(thickness_of, places, found, **tables, V=now.volume)
    thickness = np.maximum(backend.to_host(found), MIN_VOLUME_RATIO * spacing)
    share = np.clip(lost / thickness, 1.0 - 1.0 / MIN_VOLUME_RATIO, 1.0 - MIN_VOLUME_RATIO)
    # what particles have now, as fields and as tables of their neighbors in the column
    old = now.position, now.volume, now.mass, now.enthalpy, now.velocity
    new = tuple(backend.zeros(values.shape) for values in old)
    number = backend.asarray(np.arange(now.flows.shape[0]), "index")
    fields = {"i": number, "column": column} | dict(zip("xVmhv", old, strict=True))
    tables |= {"depth": depth, "V_j": now.volume, "h_j": now.enthalpy}
    tables |= {"v_j": now.velocity, "share": backend.asarray(share), "columns": float(count)}

    # m', h' and v' of every particle from the values before, and the heat that leaves in all
    tables |= {"density": density}
    sums = (*(None for _ in new), "sum")
    (heat,) = backend.pointwise(recede, fields, (*new, None), reduce=sums, **tables)
    for values, target in zip(new, old, strict=True):
        backend.copy(values, target)
    return heat


def van_leer_slope(up, down):
    """Harmonic mean of the differences to both neighbors, 0 at an extreme."""
    if up * down <= 0.0:
        return 0.0 * up
    return 2.0 * up * down / (up + down)


def carried_enthalpy(h, above, below, column, m, area, enthalpies, loss):
    """Enthalpy that the metal carries through the upper face of a particle [J/kg].

    Args:
        above, below: neighbors in the column, the particle itself at its ends. area: of its faces
            [m^(d-1)]. enthalpies: table of h. loss: table of the mass per area that the top of
            each column loses in the step [kg/m^2].
    """
    moved = loss[column] * area / m
    slope = van_leer_slope(enthalpies[above] - h, h - enthalpies[below])
    return h + 0.5 * (1.0 - moved) * slope


def followed_enthalpy(h, face, below, column, m, area, faces, loss):
    """Enthalpy after the step [J/kg], and the energy that the particle has lost by it [J]."""
    change = loss[column] * area / m * (faces[below] - face)
    return h + change, -m * change


def take_loss(evaporated, followed):
    """Mass per area that is to be followed [kg/m^2], and all that has been after it."""
    return evaporated - followed, evaporated


class Recession:
    """Columns of a body at rest whose metal follows its receding surface.

    Args:
        particles: of the body. filling: where they lie. density: of the metal [kg/m^3].
    """

    def __init__(self, particles: Particles, filling: Filling, density: float) -> None:
        backend = particles.backend
        # coarse columns stay as cold as not to evaporate
        self.particles, columns, count = particles, filling.fine_surface, filling.fine_count
        self._rows = whole_rows(filling.position[:-1, :count], filling.layer[:count], columns)
        number = np.arange(self._rows * columns)
        below = np.minimum(number + columns, number[-1] - columns + 1 + number % columns)
        self._index = {
            "above": backend.asarray(np.where(number < columns, number, number - columns), "index"),
            "below": backend.asarray(below, "index"),
            "column": backend.asarray(number % columns, "index"),
        }
        area = filling.cross_section[: number.size]
        self._fields = {
            "m": backend.head(particles["mass"], number.size),
            "area": backend.asarray(area),
        }
        particles.add("followed_mass")
        self._face, self._loss = backend.zeros(number.size), backend.zeros(columns)
        thickness = filling.width[-1, : number.size]
        self._thinnest = float(np.min(thickness))
        self._density = density

    def advance(self) -> float:
        """Let the columns follow what has evaporated in the last step.

        It comes before the next step of heat, so that temperatures at the end of a step are those
        at which its vapor has left.

        Returns:
            The energy that left with the liquid [J].
        """
        particles, columns = self.particles, self._loss.shape[0]
        backend = particles.backend

        # the mass that has evaporated in the last step leaves through the top of each column
        names = ("evaporated_mass", "followed_mass")
        evaporated, followed = (backend.head(particles[name], columns) for name in names)
        fields: dict[str, Any] = {"evaporated": evaporated, "followed": followed}
        backend.pointwise(take_loss, fields, (self._loss, followed))

        # enthalpy that the metal carries through the upper face of each particle
        h = backend.head(particles["enthalpy"], self._face.shape[0])
        fields = {"h": h, **self._index, **self._fields}
        tables = {"enthalpies": h, "loss": self._loss}
        backend.pointwise(carried_enthalpy, fields, self._face, **tables)

        # m dh = dM (h_below - h_top)
        del fields["above"]
        (left,) = backend.pointwise(
            followed_enthalpy,
            fields | {"face": self._face},
            (h, None),
            reduce=(None, "sum"),
            faces=self._face,
            loss=self._loss,
        )
        return left

    def speed(self, mass_flux: Array) -> float:
        """Largest speed of the surface [m/s], from (n,) fluxes of the particles at it."""
        backend = self.particles.backend
        fields = {"value": backend.head(mass_flux, self._loss.shape[0])}
        (fastest,) = backend.pointwise(same, fields, (None,), reduce=("max",))
        return fastest / self._density

    def longest_step(self, speed: float) -> float:
        """Limit of the next step at a speed of the surface [m/s]."""
        return COURANT * self._thinnest / speed if speed > 0.0 else np.inf


def whole_rows(lateral: np.ndarray, layer: np.ndarray, columns: int) -> int:
    """Number of layers from the surface on whose particles lie in its columns, in its order.

    Args:
        lateral: (dim - 1, n) places along the surface [m]. layer: (n,) number of the layer.
    """
    rows = 1
    while (rows + 1) * columns <= layer.size:
        part = slice(rows * columns, (rows + 1) * columns)
        inside = np.all(layer[part] == layer[part.start])
        if not inside or not np.allclose(lateral[:, part], lateral[:, :columns], rtol=1e-9):
            break
        rows += 1
    return rows
