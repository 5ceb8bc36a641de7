"""`ParticleState`: the particles of a run that moves, at the start of a step and in its middle."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import interpolate
from lasersph.materials import Material
from lasersph.materials.caloric_curve import CaloricCurve
from lasersph.particles.fields import FIELDS
from lasersph.particles.kinds import INTERIOR, LEAVING, WALL
from lasersph.particles.particles import Particles
from lasersph.physics.equation_of_state import condensed_pressure
from lasersph.physics.phase_change import state
from lasersph.solvers.ablation.equations import conducting_volume
from lasersph.solvers.ablation.geometry import Geometry, InitialState

HOTTEST = 5e4
"""End of the table of conductivities [K]. Format: far above any metal; its last law goes on."""
DERIVED = (
    "temperature",
    "melt_fraction",
    "vapor_fraction",
    "conductivity",
    replace(FIELDS["pressure"], symbol="P", is_kept=False),
    "volume",
    "acting_volume",
)
"""Results of `evaluate_state`, in its order."""
LEVEL = ("position", "velocity", "density", "enthalpy", *DERIVED)
"""Fields that change within a step."""
OTHERS = (
    "mass",
    "support",
    replace(FIELDS["kind"], storage="real", is_kept=True),
    "conducts",
    "opaque",
    "absorbed_light",
    "leaving_time",
    "vapor_pressure",
    "listed_position",
)


def evaluate_state(
    h,
    rho,
    m,
    kind,
    conducts,
    h_nodes,
    T_nodes,
    P_nodes,
    m_nodes,
    v_nodes,
    k_T,
    k_nodes,
    melts_at,
    rho_0,
    c_0,
    has_tension,
):
    """Quantities that follow from enthalpy, density and kind.

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
    """Fields of the particles; the first `count` of them are material, the others walls.

    Attributes:
        now, half: at the start and in the middle of the step; the latter has the fields of `LEVEL`
            alone. conducts_alike: whether the conductivity is one number at all temperatures.
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
        self.count, total = geometry.count, geometry.total
        size = (backend, self.count, geometry.dimension)

        # levels of a step: its start, with all fields, and its middle, with what changes
        T, k = material.table("conductivity", 1.0, HOTTEST)
        self.conducts_alike = float(np.ptp(k)) == 0.0
        level = (*LEVEL, *(["conducting_volume"] if self.conducts_alike else []))
        self.now = Particles(*size, (*level, *OTHERS), capacity=total)
        self.half = Particles(*size, level, capacity=total)

        # tables of the caloric curve and of k(T), constants of the equation of state
        nodes = curve.tables | {"k_T": T, "k_nodes": k}
        self._tables = {name: backend.asarray(values) for name, values in nodes.items()} | {
            "melts_at": melts_at,
            "rho_0": material.density_reference,
            "c_0": sound_speed,
            "has_tension": float(has_tension),
        }

        # fields at the start, and what follows from them
        start = {
            "position": initial.position,
            "velocity": initial.velocity,
            "density": initial.density,
            "enthalpy": enthalpy,
            "mass": initial.density * geometry.volume,
            "support": np.full(total, support),
            "kind": np.where(np.arange(total) < self.count, INTERIOR, WALL),
            "conducts": initial.conducts,
        }
        for name, values in start.items():
            self.now.set(name, values)
        self.refresh(self.now)

    def fields(self, level: Particles | None = None) -> dict[str, Array]:
        """Arrays by symbol, those of `level` or of the start of the step."""
        fields = self.now.by_symbol()
        return fields if level is None or level is self.now else fields | level.by_symbol()

    def refresh(self, level: Particles, rows: Rows | None = None) -> None:
        """Set what follows from enthalpy, density and kind."""
        # T(h), fractions, k(T), P(rho) and volumes in one loop
        names = [name if isinstance(name, str) else name.name for name in DERIVED]
        out = (*(level[name] for name in names), self.now["opaque"])
        fields = self.fields(level)
        self.backend.pointwise(evaluate_state, fields, out, rows=rows, **self._tables)
        if self.conducts_alike:
            out = level["conducting_volume"]
            self.backend.pointwise(conducting_volume, fields, out, rows=rows)

    def add_to_half(self, rows: Rows | None) -> None:
        """Let the middle of the step know particles that take part from now on."""
        for name in self.half:
            value = {"value": self.now[name]}
            self.backend.pointwise(copy_value, value, self.half[name], rows=rows)


def copy_value(value):
    """A copy of a field, in chosen rows."""
    return 1.0 * value
