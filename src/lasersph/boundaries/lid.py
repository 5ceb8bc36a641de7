"""`FlatLid`: a free surface that stays flat, as what it gives a step of the flow.

    normal velocity       v . n = 0, which also the images beyond it show
    tangential stress     eta d(v . t)/dn = t . grad_s gamma(T)         [Demuth2020, eq. (15)]
    pressure              dp/dn = 0: no row of the pressure equation has a pull or a flux
    heat                  none crosses, unless the case holds or heats the face

The pressure under a lid replaces the curvature of a surface that is free to move; so a lid has
neither capillary waves nor recoil, whose time-step limits are infinite here. Particles within one
spacing lie at the surface; those deeper take the stress of the surface particles in reach.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, inf
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lasersph.boundaries.settings import TemperatureWave
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import dot, interpolate
from lasersph.materials import Material
from lasersph.sph.tangential import spread, spread_terms, tangential_gradient, tangential_terms

Array = NDArray[np.float64]
LOWEST, HIGHEST = 1.0, 2.0e4
"""Range of temperatures of the table of surface tension [K]."""
NODES = 257


@dataclass(frozen=True)
class ImposedTemperature:
    """Temperature of a surface that is held: mean [K] and what varies along x."""

    mean: float
    wave: TemperatureWave | None = None


def marked(x, n, plane, near, far):
    """1 for a particle at the surface, 1 for one within reach of it, and its depth [m]."""
    depth = plane - dot(x, n)
    return (1.0 if depth < near else 0.0), (1.0 if depth < far else 0.0), depth


def both(mark, active):
    """1 where both are."""
    return mark * active


def tension(T, T_nodes, gamma_nodes):
    """Surface tension [N/m] up to a constant."""
    return interpolate(T, T_nodes, gamma_nodes)


def imposed(x, along, mean, amplitude, wave_number):
    """Temperature of the held surface above a particle [K]."""
    return mean + amplitude * cos(wave_number * dot(x, along))


def component(g, along):
    """Part of a vector along the surface."""
    return dot(g, along)


def distance_stress(tau, depth, eta):
    """2 d tau / eta [m/s]: by how much an image beyond the surface is faster than its source."""
    return 2.0 * depth * tau / eta


class FlatLid:
    """The lid z = `plane`.

    Args:
        count: particles of the whole body. spacing, support: of the particles at it [m].
        material: gamma(T) or its slope. has_stress: whether gamma drives the flow.
        held: the surface's own temperature, where it is held.

    Attributes:
        at_surface, near: (n,) 1 where a particle lies at the surface, within reach of it.
        depth: (n,) below the lid [m]. temperature: (n,) of the surface above a particle at it [K].
        gradient: (n,) dT/dx along the surface [K/m], 0 where nothing is active.
        stress: (n,) tau [Pa]. reach: (n,) 2 d tau / eta [m/s].
        normal_velocity: [m/s]. heat_flux: into the body [W/m^2]. pressure_pull, pressure_value,
            pressure_flux: (n,) a, p_b and f of `PressureEquation`, None for none.
        capillary_limit, recoil_limit: of the time step [s].
    """

    normal = (0.0, 1.0)
    tangent = (1.0, 0.0)
    normal_velocity = 0.0
    pressure_pull = pressure_value = pressure_flux = None
    heat_flux = 0.0
    capillary_limit = recoil_limit = inf

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
        held: ImposedTemperature | None,
    ) -> None:
        self.backend, self.plane, self.viscosity = backend, plane, viscosity
        self.spacing, self.support, self.held = spacing, support, held
        self.has_stress = has_stress
        self.at_surface, self.near, self.depth = (backend.zeros(count) for _ in range(3))
        self.temperature, self.gradient, self.stress = (backend.zeros(count) for _ in range(3))
        self.reach, self._gamma = backend.zeros(count), backend.zeros(count)
        self._slope = backend.zeros((2, count))
        if has_stress:
            T, gamma = tension_table(material)
            self.table = {"T_nodes": backend.asarray(T), "gamma_nodes": backend.asarray(gamma)}

    def find_surface(self, position: Any) -> None:
        """Mark the particles at the surface and near it, at `position`, shape (2, n) [m]."""
        self.backend.pointwise(
            marked, {"x": position}, (self.at_surface, self.near, self.depth), n=self.normal,
            plane=self.plane, near=self.spacing, far=self.support,
        )  # fmt: skip

    def drive(
        self,
        T: Any,
        position: Any,
        pairs: Any,
        volume: Any,
        gather: Callable[[Any], Any],
        active: Any,
    ) -> None:
        """Temperature gradient, stress and `reach` from the temperatures (n,) [K].

        Args:
            pairs: list with the rows of active particles. volume: (M,) [m^2].
            gather: from all particles to those of the list. active: (n,) 1 in reach of fluid;
                elsewhere there is no stress.
        """
        backend = self.backend
        rows = self._rows(self.at_surface, active)
        backend.copy(T, self.temperature)
        if self.held is not None:
            wave = self.held.wave
            backend.pointwise(
                imposed, {"x": position}, self.temperature, along=self.tangent,
                mean=self.held.mean, amplitude=wave.amplitude if wave else 0.0,
                wave_number=2.0 * np.pi / wave.period if wave else 0.0,
            )  # fmt: skip
        mark = gather(self.at_surface)
        fields = {"V": volume, "s": mark}
        self._along(self.temperature, self.gradient, rows, pairs, fields, gather)
        if not self.has_stress:
            return
        backend.pointwise(tension, {"T": self.temperature}, self._gamma, **self.table)
        self._along(self._gamma, self.stress, rows, pairs, fields, gather)
        near = self._rows(self.near, active)
        found = backend.zeros(self.stress.shape[0])
        fields = {"f": gather(self.stress), "s": mark}
        backend.pair_sum(spread_terms, pairs, fields, found, rows=near, finish=spread)
        backend.copy(found, self.stress)
        fields = {"tau": self.stress, "depth": self.depth}
        backend.pointwise(distance_stress, fields, self.reach, eta=self.viscosity)

    def _rows(self, mark: Any, active: Any) -> Any:
        """Index array of marked particles that are active."""
        found = self.backend.zeros(self.stress.shape[0])
        self.backend.pointwise(both, {"mark": mark, "active": active}, found)
        return self.backend.rows_where(found, 1.0)

    def _along(
        self, f: Any, out: Any, rows: Any, pairs: Any, fields: dict[str, Any],
        gather: Callable[[Any], Any],
    ) -> None:  # fmt: skip
        """Derivative of f along the surface, 0 elsewhere."""
        backend = self.backend
        backend.fill(self._slope, 0.0)
        backend.pair_sum(
            tangential_terms, pairs, fields | {"f": gather(f)}, self._slope, rows=rows,
            finish=tangential_gradient, n=self.normal,
        )  # fmt: skip
        backend.pointwise(component, {"g": self._slope}, out, along=self.tangent)


def tension_table(material: Material) -> tuple[Array, Array]:
    """Temperatures [K] and surface tension [N/m] up to a constant, from gamma(T) or its slope."""
    if material.surface_tension_slope is None:
        return material.table("surface_tension", LOWEST, HIGHEST, NODES)
    T, _ = material.table("surface_tension_slope", LOWEST, HIGHEST, NODES)
    if T.size > 2:  # the integral of a slope that varies is curved between its nodes
        T = np.union1d(T, np.linspace(LOWEST, HIGHEST, NODES))
    slope = material.surface_tension_slope_at(T)
    steps = np.diff(T) * 0.5 * (slope[1:] + slope[:-1])
    return T, np.concatenate([[0.0], np.cumsum(steps)])
