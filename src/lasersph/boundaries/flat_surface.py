"""`FlatSurface`: a free surface that stays flat, as what it gives a step of the flow.

    normal velocity       v . n = 0, which also the ghosts beyond it show
    tangential stress     eta d(v . t)/dn = t . grad_s gamma(T)         [Demuth2020, eq. (15)]
                          with the mean eta of the pairs across, which pass on all of it
    pressure              dp/dn = 0
    heat                  none crosses, unless the case holds the face's temperature or its flux

The pressure under a flat surface replaces the curvature of one that is free to move; so it has
neither capillary waves nor recoil that moves it, and no limits of the step. Particles within one
spacing lie at the surface; those deeper take the stress of the surface particles within their
support.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import cos

import numpy as np
from numpy.typing import NDArray

from lasersph.boundaries.settings import TemperatureWave
from lasersph.boundaries.surface import (
    PressureCondition,
    SurfaceGhosts,
    SurfaceNeighbors,
    SurfaceStep,
    upward,
)
from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import dot, interpolate
from lasersph.materials import Material
from lasersph.sph.tangential import (
    extend_from_surface,
    extension_terms,
    tangential_gradient,
    tangential_terms,
)

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
    wave: TemperatureWave | None = None


def mark_surface(x, n, plane, near, far):
    """1 for a particle at the surface, 1 for one within its support of it, and its depth [m]."""
    depth = plane - dot(x, n)
    return (1.0 if depth < near else 0.0), (1.0 if depth < far else 0.0), depth


def depth_below(x, n, plane):
    """Depth of a particle below the surface [m]."""
    return plane - dot(x, n)


def mark_of(mark):
    """The mark itself, for its sum."""
    return 1.0 * mark


def both(mark, active):
    """1 where both are."""
    return mark * active


def surface_tension(T, T_nodes, gamma_nodes):
    """Surface tension [N/m] up to a constant."""
    return interpolate(T, T_nodes, gamma_nodes)


def imposed_temperature(x, along, mean, amplitude, wave_number):
    """Given temperature of the surface above a particle [K]."""
    return mean + amplitude * cos(wave_number * dot(x, along))


def component(g, along):
    """Part of a vector along the surface."""
    return dot(g, along)


def velocity_jump(tau, depth, fluidity, eta):
    """2 d tau fluidity / eta [m/s]: by how much a ghost beyond is faster than its source.

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


class FlatSurface:
    """The surface z = `plane`, see `Surface`.

    Args:
        count: particles of the whole body. spacing, support: of the particles at it [m].
        material: gamma(T) or its slope. viscosity: eta at the liquidus [Pa s]. has_stress: whether
            gamma drives the flow. given: the surface's own temperature, where the case gives it.
    """

    def __init__(
        self,
        backend: Backend,
        count: int,
        *,
        plane: float,
        spacing: float,
        support: float,
        material: Material,
        viscosity: float,
        has_stress: bool,
        given: ImposedTemperature | None,
    ) -> None:
        self.backend, self.viscosity, self.given = backend, viscosity, given
        self.normal, self.tangent, self.has_stress = upward(2), (1.0, 0.0), has_stress
        self.normal_velocity = self.heat_flux = 0.0
        self.pressure: PressureCondition | None = None
        self.ghosts: SurfaceGhosts | None = None
        self.arrays: dict[str, Array] = {}
        self._place = {"n": self.normal, "plane": plane, "near": spacing, "far": support}
        self.at_surface, self.near_surface, self.depth = (backend.zeros(count) for _ in range(3))
        self.temperature, self.gradient, self.stress = (backend.zeros(count) for _ in range(3))
        self.ghost_velocity_jump, self._gamma = backend.zeros(count), backend.zeros(count)
        self._slope, self._fluidity = backend.zeros((2, count)), backend.asarray(np.ones(count))
        if has_stress:
            T, gamma = surface_tension_table(material)
            self.table = {"T_nodes": backend.asarray(T), "gamma_nodes": backend.asarray(gamma)}

    def reset(self) -> None:
        """Nothing outlives the flow below."""

    def find(self, position: Array) -> None:
        """Set marks and depths of the particles at `position`, shape (2, n) [m]."""
        out = (self.at_surface, self.near_surface, self.depth)
        self.backend.pointwise(mark_surface, {"x": position}, out, **self._place)

    def length_ratio(self) -> Array | None:
        """A plane is seen at its true length."""
        return None

    def find_depth(self, position: Array, out: Array) -> None:
        """Depth below the surface along the beam [m] of particles at `position` [m]."""
        place = {"n": self.normal, "plane": self._place["plane"]}
        self.backend.pointwise(depth_below, {"x": position}, out, **place)

    def update_stress(self, now: SurfaceStep, neighbors: SurfaceNeighbors, active: Array) -> None:
        """Set temperature, gradient, stress and jump from temperatures (n,) [K]; see `Surface`."""
        backend = self.backend
        rows = self._rows(self.at_surface, active)
        # temperature of the surface: that of the particles at it, or a given one
        backend.copy(now.T, self.temperature)
        if self.given is not None:
            wave = self.given.wave
            amplitude = wave.share_of(*now.interval) * wave.amplitude if wave else 0.0
            backend.pointwise(
                imposed_temperature,
                {"x": now.position},
                self.temperature,
                along=self.tangent,
                mean=self.given.mean,
                amplitude=amplitude,
                wave_number=2.0 * np.pi / wave.period if wave else 0.0,
            )
        mark = neighbors.gather(self.at_surface)
        self._find_slope(self.temperature, self.gradient, rows, neighbors, mark)
        if not self.has_stress:
            return
        # stress tau = d gamma/dx at the surface, extended to the particles near it
        backend.pointwise(surface_tension, {"T": self.temperature}, self._gamma, **self.table)
        self._find_slope(self._gamma, self.stress, rows, neighbors, mark)
        near = self._rows(self.near_surface, active)
        found = backend.zeros(self.stress.shape[0])
        fields = {"f": neighbors.gather(self.stress), "s": mark}
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
        backend.pointwise(velocity_jump, fields, self.ghost_velocity_jump, eta=self.viscosity)

    def hold_thin_melt(self, position: Array, volume: Array, flows: Array) -> float:
        """All that is molten flows; their number."""
        (count,) = self.backend.pointwise(mark_of, {"mark": flows}, (None,), reduce=("sum",))
        return count

    def advance_first_half(self, now: SurfaceStep) -> None:
        """It stays where it is."""

    def advance_second_half(self, now: SurfaceStep) -> float:
        """It stays where it is, and keeps its mass."""
        return 0.0

    def confine(self, position: Array, flows: Array) -> None:
        """The domain's face does that."""

    def save(self) -> None:
        """There is nothing to remember."""

    def go_back(self) -> None:
        """There is nothing to take back."""

    def restore_arrays(self, arrays: Mapping[str, np.ndarray]) -> None:
        """There is nothing to restore."""

    def validity_error(self) -> str:
        """Nothing can be wrong with it."""
        return ""

    def time_step_limits(self) -> dict[str, float]:
        """None: it has no waves."""
        return {}

    def checkpoint_scalars(self) -> dict[str, float]:
        """None: what it has follows from the particles."""
        return {}

    def restore(self, numbers: Mapping[str, float]) -> None:
        """There is nothing to restore."""

    def _rows(self, mark: Array, active: Array) -> Rows:
        """Index array of marked particles that are active."""
        found = self.backend.zeros(self.stress.shape[0])
        self.backend.pointwise(both, {"mark": mark, "active": active}, found)
        return self.backend.rows_where(found, 1.0)

    def _find_slope(
        self, f: Array, out: Array, rows: Rows, neighbors: SurfaceNeighbors, mark: Array
    ) -> None:
        """Derivative of f along the surface, 0 elsewhere; mark: `at_surface` with ghosts."""
        backend, finish = self.backend, tangential_gradient
        # corrected gradient from the particles at the surface alone, then its part along it
        backend.fill(self._slope, 0.0)
        fields, n = {"V": neighbors.V, "s": mark, "f": neighbors.gather(f)}, self.normal
        backend.pair_sum(
            tangential_terms, neighbors.pairs, fields, self._slope, rows=rows, finish=finish, n=n
        )
        backend.pointwise(component, {"g": self._slope}, out, along=self.tangent)


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
