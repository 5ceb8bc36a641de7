"""Gradient with which the pressure accelerates the melt: symmetric, or of differences.

Below a plane, or in a box without a surface, it is the symmetric one, the adjoint of the
divergence. Nothing fixes the constant of the pressure there; it is such that the gradient sees none
below 0, since the symmetric gradient of p < 0 contracts the particles [Monaghan2000].

Below a surface that moves the pressure is given, and the gradient is that of its differences, exact
on linear fields: the symmetric one pushes where the kernel sums of neighbors differ. It is not
adjoint to the divergence. Nor are the forces of two particles on each other opposite: momentum does
not stay to rounding along a period, and no force on a wall can be told from it. Where all faces are
planes of symmetry there is neither, and vortices lose a third of the energy that the symmetric one
takes from them.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.sph import correction


def pressure_of(p):
    """The pressure itself, for its minimum [Pa]."""
    return 1.0 * p


def pressure_over_lowest(source, p, lowest):
    """Pressure of a particle or ghost over the lowest one [Pa]."""
    return p[source] - lowest


class GhostPressure(Protocol):
    """Particles with ghosts, `size` in all, by their `source` (size,)."""

    @property
    def size(self) -> int:
        """Particles and ghosts."""
        ...

    @property
    def source(self) -> Array:
        """(size,) particle behind each."""
        ...

    def extend_pressure(self, p: Array) -> Array:
        """(size,) pressure, carried on beyond a surface that moves."""
        ...


class SymmetricGradient:
    """Gradient of a pressure that is known but for a constant.

    Attributes:
        is_symmetric: whether the forces of two particles on each other are opposite, so that a sum
            over ghosts is what presses on a face.
    """

    is_symmetric = True

    @property
    def term(self) -> Callable[..., Any]:
        """Term of a pair, (p_i C_i + p_j C_j) G_ij."""
        return correction.corrected_symmetric_term

    def find_lowest(self, backend: Backend, p: Array, rows: Rows) -> None:
        """Reduce the lowest pressure of some rows [Pa], where the gradient sees p over that."""
        backend.pointwise(pressure_of, {"p": p}, (None,), rows=rows, reduce=("min",))

    def extend(self, backend: Backend, ghosts: GhostPressure, p: Array, lowest: float) -> Array:
        """(size,) pressure of particles and ghosts as the gradient sees it [Pa]: over the lowest
        one; ghosts mirror that of their source."""
        found, tables = backend.zeros(ghosts.size), {"p": p}
        fields = {"source": ghosts.source}
        backend.pointwise(pressure_over_lowest, fields, found, **tables, lowest=lowest)
        return found


class DifferenceGradient(SymmetricGradient):
    """Gradient of differences, which a constant of the pressure does not change."""

    is_symmetric = False

    @property
    def term(self) -> Callable[..., Any]:
        """(p_j - p_i) C_i G_ij."""
        return correction.corrected_difference_term

    def find_lowest(self, backend: Backend, p: Array, rows: Rows) -> None:
        """Nothing to reduce: the gradient sees the pressure as it is."""

    def extend(self, backend: Backend, ghosts: GhostPressure, p: Array, lowest: float) -> Array:
        """Pressure carried on through that of the surface."""
        return ghosts.extend_pressure(p)
