"""Width of a melt pool that finite volumes report, by the width of their columns.

The finite-volume reference of `sizes.csv` takes the edges of the pool at f_m > 0 and f_m = 1
from columns some 25 nm wide. Drawn between the centers of columns, f_m reaches 0 at the center of
the first solid column and 1 at that of the last fluid one: each edge is off by up to a column, out
at f_m > 0 and in at f_m = 1. At 0.5 both errors cancel. A program of a page shows it: explicit
steps of the enthalpy in cells, half a period, light and reflectivity of the case, until the pool is
widest. With 25 nm columns it repeats the reference; with fine columns the three levels close in on
each other (steel: up to its mushy zone) and on the particles' widths.

    rho dh/dt = div(k grad T(h)) + q,  dt <= 0.45 / (a (1/dx^2 + 1/dz^2))
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lasersph.case import Case
from lasersph.irradiation.light import COLDEST, HOTTEST
from lasersph.lasers import Laser
from lasersph.simulation.layers import caloric_curve

Array = NDArray[np.float64]
ROW = 8e-9
"""Height of the finest rows [m]; 4 nm changes the widths by 2 nm."""
FINE_DEPTH, DEPTH = 300e-9, 6e-6
GROWTH, HIGHEST_ROW = 1.0 / 0.9, 500e-9
BEGIN, END = 28e-9, 58e-9
"""Light before BEGIN warms by less than 1e-5 K; the pools are widest before END [s]."""
STABLE = 0.45
FULL = 1.0 - 1e-9


class Widths(NamedTuple):
    """Full widths [m] at f_m > 0, 0.5 and 1."""

    any: float
    half: float
    full: float


class Columns:
    """Explicit finite volumes of half a period of an interference pattern."""

    def __init__(self, case: Case, column: float) -> None:
        """Args: case: 2-D, with a laser. column: width of a column [m]."""
        if case.laser is None or case.domain.width is None:
            raise ValueError("finite volumes need a laser and a period")
        # Columns of half a period, rows that grow downward.
        half = 0.5 * case.domain.width
        count = round(half / column)
        self.dx = half / count
        self.dz = rows()
        self.faces = self.dx * np.arange(count + 1)
        self.curve, self.laser = caloric_curve(case), case.laser
        self.density = case.material.density_reference
        self.melting = float(case.material.melting.solidus) if case.material.melting else np.inf
        self.reflectivity = case.laser.reflectivity_table(case.material, COLDEST, HOTTEST)
        # Share of the light that each row absorbs, by Beer and Lambert.
        alpha = case.laser.absorption_coefficient(case.material)
        depth = np.concatenate([[0.0], np.cumsum(self.dz)])
        self.absorbed = -np.diff(np.exp(-alpha * depth)) / (self.density * self.dz)
        # Stability of explicit steps: dt <= 0.45 / (a (1/dx^2 + 1/dz^2)).
        diffusivity = case.material.diffusivity_reference
        self.step = STABLE / (diffusivity * (self.dx**-2 + self.dz[0] ** -2))
        self.enthalpy = np.zeros((self.dz.size, count))

    def widest(self) -> Widths:
        """Largest widths until END, with edges drawn between the centers of columns."""
        # Light of one whole pulse, of which each step brings its share.
        light = self.light(self.laser)
        steps = int(np.ceil((END - BEGIN) / self.step))
        # Some hundred looks at the widths are enough.
        every = max(1, steps // 300)
        times = BEGIN + self.step * np.arange(steps + 1)
        shares = np.diff([float(self.laser.pulse.delivered(-np.inf, t)) for t in times])
        found = Widths(0.0, 0.0, 0.0)
        for k, share in enumerate(shares):
            self.advance(share * light)
            if k % every == 0:
                found = Widths(*np.maximum(found, drawn(self.surface_fraction(), self.dx)))
        return found

    def light(self, laser: Laser) -> Array:
        """Fluence of one whole pulse on each column [J/m2]."""
        lower, upper = self.faces[None, :-1], self.faces[None, 1:]
        whole = float(laser.pulse.delivered(-np.inf, np.inf)) or 1.0
        return laser.energy_density(lower, upper, -np.inf, np.inf) / whole

    def advance(self, incident: Array) -> None:
        """One step with the light of that step on each column [J/m2]."""
        h = self.enthalpy
        dx = self.dx
        dz = self.dz[:, None]
        # Heat-flux potential Phi(h), whose differences are k dT.
        heat = np.interp(h, self.curve.enthalpy, self.curve.potential)
        change = np.zeros_like(h)
        # Fluxes across columns, then down the rows, each added to one cell and taken from the
        # other.
        across = np.diff(heat, axis=1) * (self.step / (self.density * dx**2))
        change[:, :-1] += across
        change[:, 1:] -= across
        down = np.diff(heat, axis=0) * (2.0 * self.step / (self.density * (dz[1:] + dz[:-1])))
        change[:-1] += down / dz[:-1]
        change[1:] -= down / dz[1:]
        # Light by the reflectivity of the surface at its temperature.
        T = np.interp(h[0], self.curve.enthalpy, self.curve.temperature)
        taken = (1.0 - np.interp(T, *self.reflectivity)) * incident
        h += change + self.absorbed[:, None] * taken

    def surface_fraction(self) -> Array:
        """f_m of the surface cells."""
        return np.interp(self.enthalpy[0], self.curve.enthalpy, self.curve.melt_fraction)


def rows() -> Array:
    """Heights of the rows from the surface down [m]."""
    # Fine rows first, then rows that grow.
    heights = [ROW] * round(FINE_DEPTH / ROW)
    while sum(heights) < DEPTH:
        heights.append(min(heights[-1] * GROWTH, HIGHEST_ROW))
    return np.array(heights)


def drawn(fraction: Array, dx: float) -> tuple[float, float, float]:
    """Full widths where a line between centers leaves f_m > 0, passes 0.5 and leaves f_m = 1 [m].

    Args:
        fraction: f_m of columns from x = 0 on, falling. dx: their width [m].
    """
    # Without half molten metal there is no pool to measure.
    if fraction[0] < 0.5:
        return 0.0, 0.0, 0.0
    solid, last = int(np.argmax(fraction <= 0.0)), int(np.argmax(fraction < FULL)) - 1
    beyond = int(np.argmax(fraction < 0.5))
    # f_m = 0.5 lies between the last column above it and the next one.
    inner, outer = fraction[beyond - 1], fraction[beyond]
    half = beyond - 0.5 + (inner - 0.5) / (inner - outer)
    return 2.0 * dx * (solid + 0.5), 2.0 * dx * half, 2.0 * dx * max(last + 0.5, 0.0)
