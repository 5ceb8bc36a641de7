"""Heat that the surface loses in a step, by losses to the surroundings and by evaporation."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from lasersph.compute.array_types import Array, Rows
from lasersph.compute.vectors import same
from lasersph.input import format_quantity
from lasersph.physics.evaporation import vapor_constants
from lasersph.physics.knudsen_layer import outflow_tables
from lasersph.physics.losses import evaporation_loss, surface_loss
from lasersph.solvers.conduction.body import Body
from lasersph.solvers.step_control import StepFailed
from lasersph.surface.columns import OwnColumns, SurfaceColumns


def surface_power(T, area, surroundings):
    """Power lost by a surface particle [W] and its slope in T [W/K]."""
    loss, slope = surface_loss(T, surroundings)
    return area * loss, area * slope, area * loss


def evaporating_power(T, area, surroundings, p_b, T_b, L_b, T_c, R_s, p_e, ratio_nodes, flux_nodes):
    """As `surface_power` with evaporation; also its power [W] and the mass flux [kg/(m^2 s)]."""
    loss, slope = surface_loss(T, surroundings)
    heat, heat_slope, mass = evaporation_loss(
        T, p_b, T_b, L_b, T_c, R_s, p_e, ratio_nodes, flux_nodes
    )
    return area * (loss + heat), area * (slope + heat_slope), area * loss, area * heat, mass


def accumulate_evaporated_mass(evaporated, mass_flux, step):
    """Mass per area that has evaporated [kg/m^2]."""
    return evaporated + step * mass_flux


class SupercriticalSurface(StepFailed):
    """The surface is hotter than the critical temperature of the metal."""


class SurfaceExchange:
    """Losses of the particles at the surface, as power and slope in T.

    Attributes:
        rows: numbers of these particles. area: (n,) of the surface that each of them stands for
            [m^(d-1)].
        power: (n,) [W]. slope: (n,) d power/dT [W/K]. mass_flux: (n,) evaporating [kg/(m^2 s)].
        is_idle: no loss of any kind.
    """

    def __init__(self, body: Body, *, evaporates: bool, ambient_pressure: float = 0.0) -> None:
        """`ambient_pressure` [Pa]: against which vapor leaves, 0 for vacuum."""
        backend, count = body.backend, body.count
        self.body, self.evaporates = body, evaporates
        # rows at the surface: those of the lattice until particles move
        self.power, self.slope, self.mass_flux = (backend.zeros(count) for _ in range(3))
        self._lattice = backend.asarray(body.filling.surface, "index"), body.area
        self.rows, self.area = self._lattice
        self._columns: SurfaceColumns | OwnColumns | None = None

        # what losses depend on: surroundings, and the vapor's curves where it evaporates
        self._tables = {"surroundings": backend.asarray(body.surroundings.table)}
        self.is_idle = not evaporates and not body.surroundings.take_heat
        self.constants: dict[str, float] = {}
        vapor = body.material.vaporization
        if evaporates and vapor is not None:
            ratio, flux, _ = outflow_tables()
            self.constants = vapor_constants(vapor) | {"p_e": ambient_pressure}
            self._tables["ratio_nodes"] = backend.asarray(ratio)
            self._tables["flux_nodes"] = backend.asarray(flux)

    def use_lattice(self) -> None:
        """Let the surface be that of the particles on their lattice, as at the start."""
        self._set_surface(*self._lattice)
        self._columns = None

    def use_columns(self, columns: SurfaceColumns | OwnColumns, rows: Rows) -> None:
        """Let the surface be that of the particles `rows` that lie at it now (2-D)."""
        self._set_surface(rows, columns.area)
        self._columns = columns

    def _set_surface(self, rows: Rows, area: Array) -> None:
        """Surface particles and their areas (n,) [m^(d-1)]; those before lose nothing any more."""
        backend, nothing = self.body.backend, self.body.backend.zeros(self.rows.shape[0])
        for quantity in (self.power, self.slope, self.mass_flux):
            backend.scatter(nothing, self.rows, quantity)
        self.rows, self.area = rows, area

    def accumulate(self, evaporated: Array, step: float) -> None:
        """Add what `step` [s] evaporates to (n,) [kg/m^2]: by column, whose entry is that of the
        particle at its top on the lattice, since particles move on and the surface stays."""
        flux = self.mass_flux
        if self._columns is not None:
            flux = self._columns.mean_from_above(self.mass_flux)
            evaporated = self.body.backend.head(evaporated, flux.shape[0])
        fields = {"evaporated": evaporated, "mass_flux": flux}
        self.body.backend.pointwise(accumulate_evaporated_mass, fields, evaporated, step=step)

    def refuse_supercritical(self, temperature: Array, position: Callable[[], np.ndarray]) -> None:
        """Stop where the surface has no liquid any more.

        Args:
            temperature: (n,) [K]. position: returns those of the particles, (dim, n) [m].

        Raises:
            SupercriticalSurface: with the place.
        """
        backend, highest = self.body.backend, self.constants["T_c"]
        (hottest,) = backend.pointwise(
            same, {"value": temperature}, (None,), rows=self.rows, reduce=("max",)
        )
        if hottest <= highest:
            return
        # the hottest place, for the message
        rows = np.asarray(backend.to_host(self.rows), np.int64)
        place = rows[int(np.argmax(backend.to_host(temperature)[rows]))]
        x, where = "", position()
        if where.shape[0] > 1:
            x = f" at x = {format_quantity(float(where[0, place]), 'm')}"
        raise SupercriticalSurface(
            f"the surface{x} is at {hottest:.0f} K, above the critical temperature of "
            f"{highest:.0f} K, where no liquid is left for vapor to leave; give less light "
            "(laser.fluence) or longer pulses"
        )

    def evaluate(self, temperature: Array) -> tuple[float, float]:
        """Set power and slope; returns the power lost and the power removed by vapor [W]."""
        if self.is_idle:
            return 0.0, 0.0
        # q(T) A and its slope, with L_v m(T) where vapor leaves
        fields = {"T": temperature, "area": self.area}
        if not self.evaporates:
            function, out = surface_power, (self.power, self.slope, None)
            reduce = (None, None, "sum")
        else:
            function, out = evaporating_power, (self.power, self.slope, None, None, self.mass_flux)
            reduce = (None, None, "sum", "sum", None)
        lost, *removed = self.body.backend.pointwise(
            function,
            fields,
            out,
            rows=self.rows,
            reduce=reduce,
            **self.constants,
            **self._tables,
        )
        return lost, sum(removed)
