"""`FlatSurface`: a free surface that stays flat, as what it gives a step of the flow.

    normal velocity       v . n = 0, which also the ghosts beyond it show
    tangential stress     eta d(P v)/dn = tau = grad_s gamma(T)          [Demuth2020, eq. (15)]
                          with the mean eta of the pairs across, which pass on all of it,
                          P = 1 - n n
    pressure              dp/dn = 0
    heat                  none crosses, unless the case holds the face's temperature or its flux

The pressure under a flat surface replaces the curvature of one that is free to move; so it has
neither capillary waves nor recoil that moves it, and no limits of the step. Particles within one
spacing lie at the surface; those deeper take the stress of the surface particles within their
support.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, exp

import numpy as np
from numpy.typing import NDArray

from lasersph.boundaries.surface_drives import TemperatureBump, TemperatureWave
from lasersph.compute.array_types import Array, Constants, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import dot, interpolate, vector
from lasersph.materials import Material
from lasersph.sph.tangential import (
    extend_from_surface,
    extension_terms,
    tangential_gradient,
    tangential_terms,
)
from lasersph.surface.columns import product
from lasersph.surface.pressure_gradient import SymmetricGradient
from lasersph.surface.surface import Surface, SurfaceNeighbors, SurfaceStep

LOWEST, HIGHEST = 1.0, 2.0e4
"""Range of temperatures of the table of surface tension [K]. Format: it ends far above any metal.
"""
NODES = 257
"""Nodes of that table. Accuracy: 78 K from node to node; a surface tension that is linear is exact.
"""


@dataclass(frozen=True)
class ImposedTemperature:
    """Temperature that a case gives a surface: mean [K] and what varies along x."""

    mean: float
    drive: TemperatureWave | TemperatureBump | None = None


def mark_surface(x, n, plane, near, far):
    """1 for a particle at the surface, 1 for one within its support of it, and its depth [m]."""
    depth = plane - dot(x, n)
    return (1.0 if depth < near else 0.0), (1.0 if depth < far else 0.0), depth


def surface_tension(T, T_nodes, gamma_nodes):
    """Surface tension [N/m] up to a constant."""
    return interpolate(T, T_nodes, gamma_nodes)


def imposed_wave(x, mean, amplitude, wave_number):
    """Given temperature of the surface above a particle [K], with a wave in it.

    Args:
        wave_number: along each axis of the surface, 0 where nothing varies [1/m].
    """
    wave = cos(wave_number[0] * x[0])
    if len(wave_number) == 2:
        wave = wave * cos(wave_number[1] * x[1])
    return mean + amplitude * wave


def imposed_bump(x, center, mean, amplitude, radius):
    """Given temperature of the surface above a particle [K], with a bump in it.

    Args:
        center: of the bump, along each axis of the surface [m].
    """
    r = vector(*((x[k] - center[k]) / radius for k in range(len(center))))
    return mean + amplitude * exp(-dot(r, r))


def velocity_jump(tau, depth, fluidity, eta):
    """2 d tau fluidity / eta [m/s]: by how much a ghost beyond is faster than its source, a vector.

    Args:
        fluidity: eta, the viscosity at the liquidus [Pa s], over that of the pairs across.
    """
    return 2.0 * depth * tau / eta * fluidity


def across_terms(g_ij, w_ij, x_j, n, plane):
    """Weight g of a pair with a ghost beyond the surface, and w, with which viscosity counts."""
    across = 1.0 if dot(x_j, n) > plane else 0.0
    return across * g_ij, across * w_ij


def fluidity_across(total_0, total_1):
    """Viscosity at the liquidus over the mean of a particle's pairs across the surface."""
    return total_0 / total_1 if total_1 > 0.0 else 1.0 + total_1


class FlatSurface(Surface):
    """The surface z = `plane`, see `Surface`.

    Args:
        count: particles of the whole body. dimension: d. spacing, support: of the particles at it
            [m].
        material: gamma(T) or its slope. viscosity: eta at the liquidus [Pa s]. has_stress: whether
            gamma drives the flow. given: the surface's own temperature, where the case gives it.
            pressure_gradient: below it.

    Attributes:
        stress: (d, n) tau [Pa].
    """

    def __init__(
        self,
        backend: Backend,
        count: int,
        *,
        dimension: int,
        plane: float,
        spacing: float,
        support: float,
        material: Material,
        viscosity: float,
        has_stress: bool,
        given: ImposedTemperature | None,
        pressure_gradient: SymmetricGradient,
    ) -> None:
        super().__init__(backend, count, plane, dimension, pressure_gradient=pressure_gradient)
        self.viscosity = viscosity
        self.given = given
        self.has_stress = has_stress
        self.stress = backend.zeros((dimension, count))
        self._place = {"n": self.normal, "plane": plane, "near": spacing, "far": support}
        self._gamma = backend.zeros(count)
        self._fluidity = backend.asarray(np.ones(count))
        if has_stress:
            T, gamma = surface_tension_table(material)
            self.table = {"T_nodes": backend.asarray(T), "gamma_nodes": backend.asarray(gamma)}

    def shifted_along(self, dummy: Array) -> Array:
        """Particles at the surface are shifted along it only."""
        return self.at_surface

    def find(self, position: Array) -> None:
        """Set marks and depths of the particles at `position`, shape (d, n) [m]."""
        out = (self.at_surface, self.near_surface, self.depth)
        self.backend.pointwise(mark_surface, {"x": position}, out, **self._place)

    def update_stress(self, now: SurfaceStep, neighbors: SurfaceNeighbors, active: Array) -> None:
        """Set temperature, gradient, stress and jump from temperatures (n,) [K]; see `Surface`."""
        backend = self.backend
        rows = self._rows(self.at_surface, active)
        # temperature of the surface: that of the particles at it, or a given one
        backend.copy(now.T, self.temperature)
        if self.given is not None:
            self._impose_temperature(self.given, now)
        mark = neighbors.gather(self.at_surface)
        self._find_slope(self.temperature, self.gradient, rows, neighbors, mark)
        if not self.has_stress:
            return
        # stress tau = grad_s gamma at the surface, extended to the particles near it
        backend.pointwise(surface_tension, {"T": self.temperature}, self._gamma, **self.table)
        self._find_slope(self._gamma, self.stress, rows, neighbors, mark)
        near = self._rows(self.near_surface, active)
        found = backend.zeros(self.stress.shape)
        fields = {"f": neighbors.mirror(self.stress), "s": mark}
        terms, finish = extension_terms, extend_from_surface
        # particles near the surface take the mean stress of those at it
        backend.pair_sum(terms, neighbors.pairs, fields, found, rows=near, finish=finish)
        backend.copy(found, self.stress)

        # where viscosity varies, the pairs across pass on the whole stress with their mean eta
        if neighbors.viscous_weights is not neighbors.weights:
            fields = {"g_ij": neighbors.weights, "w_ij": neighbors.viscous_weights}
            place, finish = {name: self._place[name] for name in ("n", "plane")}, fluidity_across
            backend.pair_sum(
                across_terms,
                neighbors.pairs,
                fields,
                self._fluidity,
                rows=near,
                finish=finish,
                **place,
            )

        # v beyond the surface, which shows its pairs the stress
        fields = {"tau": self.stress, "depth": self.depth, "fluidity": self._fluidity}
        backend.pointwise(velocity_jump, fields, self.velocity_jump, eta=self.viscosity)

    def _impose_temperature(self, given: ImposedTemperature, now: SurfaceStep) -> None:
        """Set the temperature to what the case gives in the interval of the step."""
        drive, out = given.drive, self.temperature
        if drive is None:
            self.backend.fill(out, given.mean)
            return
        # a mean, and a wave or a bump while it acts
        fields, axes = {"x": now.position}, len(self.normal) - 1
        place: Constants = {"mean": given.mean}
        place["amplitude"] = drive.share_of(*now.interval) * drive.amplitude
        if isinstance(drive, TemperatureBump):
            place |= {"center": (0.0,) * axes, "radius": drive.radius}
            self.backend.pointwise(imposed_bump, fields, out, **place)
            return
        periods = (drive.period, drive.period_y)[:axes]
        place["wave_number"] = tuple(2.0 * np.pi / one if one else 0.0 for one in periods)
        self.backend.pointwise(imposed_wave, fields, out, **place)

    def _rows(self, mark: Array, active: Array) -> Rows:
        """Index array of marked particles that are active."""
        found = self.backend.zeros(mark.shape[0])
        self.backend.pointwise(product, {"a": mark, "b": active}, found)
        return self.backend.rows_where(found, 1.0)

    def _find_slope(
        self, f: Array, out: Array, rows: Rows, neighbors: SurfaceNeighbors, mark: Array
    ) -> None:
        """Gradient of f along the surface (d, n), 0 elsewhere; mark: `at_surface` with ghosts."""
        backend, finish = self.backend, tangential_gradient
        # corrected gradient from the particles at the surface alone, without a part along n
        backend.fill(out, 0.0)
        fields, n = {"V": neighbors.V, "s": mark, "f": neighbors.gather(f)}, self.normal
        backend.pair_sum(
            tangential_terms, neighbors.pairs, fields, out, rows=rows, finish=finish, n=n
        )


def surface_tension_table(material: Material) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Temperatures [K] and surface tension [N/m] up to a constant, from gamma(T) or its slope."""
    # gamma(T), or the integral of its slope by the trapezoidal rule
    if material.surface_tension_slope is None:
        return material.table("surface_tension", LOWEST, HIGHEST, NODES)
    T, _ = material.table("surface_tension_slope", LOWEST, HIGHEST, NODES)
    if T.size > 2:  # the integral of a slope that varies is curved between its nodes
        T = np.union1d(T, np.linspace(LOWEST, HIGHEST, NODES))
    slope = material.surface_tension_slope_at(T)
    steps = np.diff(T) * 0.5 * (slope[1:] + slope[:-1])
    return T, np.concatenate([[0.0], np.cumsum(steps)])
