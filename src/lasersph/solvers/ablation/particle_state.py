"""`ParticleState`: the particles of a run that moves, at the start of a step and in its middle."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from lasersph.compute.backend import Backend
from lasersph.compute.vectors import interpolate
from lasersph.materials import Material
from lasersph.materials.caloric_curve import CaloricCurve
from lasersph.particles.kinds import INTERIOR, LEAVING, WALL
from lasersph.physics.equation_of_state import condensed_pressure
from lasersph.physics.phase_change import state
from lasersph.solvers.ablation.geometry import Geometry, InitialState

HOTTEST = 5e4
"""End of the table of conductivities [K]; its last law goes on."""


@dataclass(frozen=True)
class TimeLevel:
    """Fields at one time, (N,) and (dim, N): x, v, rho, h, and what follows from them.

    V_a: acting volume, see `rates`.
    """

    x: Any
    v: Any
    rho: Any
    h: Any
    T: Any
    f_m: Any
    f_v: Any
    k: Any
    P: Any
    V: Any
    V_a: Any

    @classmethod
    def empty(cls, backend: Backend, dimension: int, total: int) -> TimeLevel:
        """All zero."""
        vectors = [backend.zeros((dimension, total)) for _ in range(2)]
        return cls(*vectors, *(backend.zeros(total) for _ in range(9)))


def evaluate_state(
    h, rho, m, kind, conducts,
    h_nodes, T_nodes, P_nodes, m_nodes, v_nodes, k_T, k_nodes, melts_at, rho_0, c_0, has_tension,
):  # fmt: skip
    """What follows from enthalpy, density and kind.

    Returns temperature [K], melt and vapor fraction [1], conductivity [W/(m K)], pressure [Pa],
    volume and acting volume [m^d], and 1 for what has not been ejected.

    Args:
        conducts: 1, or 0 for walls that let no heat pass. h_nodes ... v_nodes: of
        `phase_change.state`. k_T, k_nodes: table of the conductivity. melts_at: where matter
        without latent heat counts as molten [K]. Others as in `equation_of_state`.
    """
    T, _potential, f_m, f_v = state(h, h_nodes, T_nodes, P_nodes, m_nodes, v_nodes)
    is_wall = kind == WALL
    acts = 1.0 if kind == INTERIOR or is_wall else 0.0
    opaque = 1.0 if kind <= LEAVING or is_wall else 0.0
    melted = max(f_m, 1.0 if melts_at <= T else 0.0)
    k = opaque * conducts * interpolate(T, k_T, k_nodes)
    P = acts * condensed_pressure(rho, rho_0, c_0, has_tension)
    V = m / rho
    return T, melted, f_v, k, P, V, acts * V, opaque


class ParticleState:
    """Fields of the particles; the first `count` of N are material, the others walls.

    Attributes:
        now, half: fields at the start and in the middle of the step. m: mass [kg per (3 - d)
            lengths]. support: [m]. kind: of the life of each particle.
        conducts: 1, or 0 of walls without heat. opaque: 1 of what has not been ejected.
        E: light absorbed in the step [J]. left_at: time of leaving [s], 0 before. p_v: vapor
            pressure at leaving [Pa].
    """

    def __init__(
        self,
        backend: Backend,
        geometry: Geometry,
        initial: InitialState,
        material: Material,
        curve: CaloricCurve,
        *,
        enthalpy: np.ndarray,
        support: float,
        sound_speed: float,
        has_tension: bool,
        melts_at: float,
    ) -> None:
        self.backend, self.geometry, self.material, self.curve = backend, geometry, material, curve
        self.count, self.total = geometry.count, geometry.total
        total, dimension = self.total, geometry.dimension
        self.now = TimeLevel.empty(backend, dimension, total)
        self.half = TimeLevel.empty(backend, dimension, total)
        self.m = backend.asarray(initial.density * geometry.volume)
        self.support = backend.asarray(np.full(total, support))
        kind = np.full(total, INTERIOR)
        kind[self.count :] = WALL
        self.kind = backend.asarray(kind)
        self.conducts = backend.asarray(initial.conducts)
        self.opaque, self.E, self.left_at, self.p_v = (backend.zeros(total) for _ in range(4))
        T, k = material.table("conductivity", 1.0, HOTTEST)
        self._tables = {
            "h_nodes": backend.asarray(curve.enthalpy),
            "T_nodes": backend.asarray(curve.temperature),
            "P_nodes": backend.asarray(curve.potential),
            "m_nodes": backend.asarray(curve.melt_fraction),
            "v_nodes": backend.asarray(curve.vapor_fraction),
            "k_T": backend.asarray(T),
            "k_nodes": backend.asarray(k),
        }
        self._constants = {
            "melts_at": melts_at,
            "rho_0": material.density_reference,
            "c_0": sound_speed,
            "has_tension": float(has_tension),
        }
        for array, target in (
            (initial.position, self.now.x),
            (initial.velocity, self.now.v),
            (initial.density, self.now.rho),
            (enthalpy, self.now.h),
        ):
            backend.copy(backend.asarray(array), target)
        self.refresh(self.now)

    def fields(self, level: TimeLevel | None = None) -> dict[str, Any]:
        """Arrays by symbol, those of `level` or of the start of the step."""
        return vars(level or self.now) | {
            "m": self.m, "l": self.support, "kind": self.kind,
            "opaque": self.opaque, "conducts": self.conducts, "E": self.E,
            "left_at": self.left_at, "p_v": self.p_v,
        }  # fmt: skip

    def refresh(self, level: TimeLevel, rows: Any = None) -> None:
        """Set what follows from enthalpy, density and kind."""
        fields = {
            "h": level.h, "rho": level.rho, "m": self.m, "kind": self.kind,
            "conducts": self.conducts,
        }  # fmt: skip
        out = (level.T, level.f_m, level.f_v, level.k, level.P, level.V, level.V_a, self.opaque)
        self.backend.pointwise(
            evaluate_state, fields, out, rows=rows, **self._tables, **self._constants
        )

    def enter(self, rows: Any) -> None:
        """Let the middle of the step know particles that take part from now on."""
        for name, array in vars(self.now).items():
            self.backend.pointwise(
                copy_value, {"value": array}, getattr(self.half, name), rows=rows
            )


def copy_value(value):
    """A copy of a field, in chosen rows."""
    return 1.0 * value
