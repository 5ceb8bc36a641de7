"""A body at rest under a surface that recedes: what evaporates is followed by what lies below.

Particles stay where they are below the surface, and the metal moves up through them, in each column
by the thickness that its top loses in the step:

    m dh_i = dM (h_below - h_top),    h_top = h_i + (1 - dM/m)/2 slope_i

dM is the mass that passes through a face of the column in the step, h_top what the metal carries
through the upper face, with van Leer's slope of the column [vanLeer1974]: second order, and no new
extremes. The vapor takes h of the uppermost particle, at whose temperature it leaves, so that a
steady surface has exactly q = m (h + L_v). Nothing enters a column whose lowest particle is cold.

The surface lies at z = 0 all the time, so that light and losses meet it where it is. Left out:
conduction along x between columns that have receded by different lengths goes straight across, as
if slopes were small; of graded layers only those with the columns of the surface follow.
Reference: [vanLeer1974] J. Comput. Phys. 14, 361.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.vectors import same
from lasersph.solvers.conduction.body import Body

COURANT = 0.25
"""Share of a particle's thickness by which the metal may move in a step. Accuracy: stability needs
1; the temperature of the surface falls within a step by this share of its difference to the next
particle."""


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
    """Columns of a body that follow their receding surface."""

    def __init__(self, body: Body) -> None:
        backend, filling, count = body.backend, body.filling, body.count
        self.body, columns = body, filling.surface.size
        self._rows = whole_rows(filling.position[:-1, :count], filling.layer[:count], columns)
        number = np.arange(self._rows * columns)
        below = np.minimum(number + columns, number[-1] - columns + 1 + number % columns)
        self._index = {
            "above": backend.asarray(np.where(number < columns, number, number - columns), "index"),
            "below": backend.asarray(below, "index"),
            "column": backend.asarray(number % columns, "index"),
        }
        area = np.prod(filling.width[:-1, : number.size], axis=0)
        self._fields = {
            "m": backend.head(body.particles["mass"], number.size),
            "area": backend.asarray(area),
        }
        body.particles.add("followed_mass")
        self._face, self._loss = backend.zeros(number.size), backend.zeros(columns)
        thickness = filling.width[-1, : number.size]
        self._thinnest = float(np.min(thickness))
        self._density = body.material.density_reference

    def advance(self) -> float:
        """Let the columns follow what has evaporated in the last step.

        It comes before the next step of heat, so that temperatures at the end of a step are those
        at which its vapor has left.

        Returns:
            The energy that left with the liquid [J].
        """
        backend, columns, particles = self.body.backend, self._loss.shape[0], self.body.particles
        names = ("evaporated_mass", "followed_mass")
        evaporated, followed = (backend.head(particles[name], columns) for name in names)
        fields: dict[str, Any] = {"evaporated": evaporated, "followed": followed}
        backend.pointwise(take_loss, fields, (self._loss, followed))
        h = backend.head(self.body.particles["enthalpy"], self._face.shape[0])
        fields = {"h": h, **self._index, **self._fields}
        tables = {"enthalpies": h, "loss": self._loss}
        backend.pointwise(carried_enthalpy, fields, self._face, **tables)
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
        fields = {"value": self.body.backend.head(mass_flux, self._loss.shape[0])}
        (fastest,) = self.body.backend.pointwise(same, fields, (None,), reduce=("max",))
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
