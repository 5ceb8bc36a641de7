"""How deep a pulse will melt: a cheap estimate, for laying out fine particles.

A few columns of finite volumes, implicit in depth and explicit across, solve

    rho dh/dt = d2(theta)/dz2 + d2(theta)/dx2 + (1 - R) F(x) g(t) alpha exp(-alpha z)

for the specific enthalpy h, with theta(h) = int k dT (Kirchhoff) piecewise linear between the
nodes of the caloric curve. One column at the peak fluence leaves the lateral heat flow out and so
is an upper bound; columns over half an interference period follow the pool within some percent.

What evaporates can be asked for: the grid follows the surface then, so that metal moves up through
it at m/rho, as in `steady_recession`, and m(T) and its heat leave at the temperature of the
uppermost cell.

Left out: flow, other surface losses, density changes. The reflectivity is taken at the surface
temperature of the step before (steps take at most 1 % of the pulse).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lasersph.analytic.extended_curve import ExtendedCurve

Array = NDArray[np.float64]
Delivered = Callable[[ArrayLike, ArrayLike], Array]
"""Share of one pulse's energy that arrives between times, or arrays of them [s]."""
Vapor = Callable[[Array], tuple[Array, Array]]
"""Mass [kg/(m^2 s)] and heat [W/m^2] that leave a surface at temperatures [K]."""


@dataclass(frozen=True)
class SurfaceHistory:
    """The surface of the columns after each step: `time` (n,) [s], `temperature` [K] and `depth` of
    the melt below [m], both (n, columns), which are `column_width` [m] wide; None: one column."""

    time: Array
    temperature: Array
    depth: Array
    column_width: float | None


@dataclass(frozen=True)
class MeltEstimate:
    """Depth of the melt [m] (0 where nothing melts), first and last time there is some [s], the
    highest surface temperature [K]; times are nan where nothing melts, as before any light. What
    evaporates, as a depth in the mean of the columns and where it is most [m], 0 where that was not
    asked for. What a plateau holds of the heat of vaporization, as the largest depth of metal that
    it would turn into vapor [m]. And the surface over time, None where there is no light."""

    depth: float
    start: float
    end: float
    temperature: float
    evaporated: float = 0.0
    evaporated_most: float = 0.0
    held: float = 0.0
    surface: SurfaceHistory | None = field(default=None, repr=False)

    @property
    def safe_depth(self) -> float:
        """Depth [m] with 10 % added, which covers what the coarse columns miss."""
        return 1.1 * self.depth


def melt_depth(
    *,
    enthalpy: ArrayLike,
    temperature: ArrayLike,
    potential: ArrayLike,
    melt_fraction: ArrayLike,
    density: float,
    absorption_coefficient: float,
    reflectivity: Callable[[Array, float, float], Array] | float,
    fluence: ArrayLike,
    delivered: Delivered,
    end_time: float,
    column_width: float | None = None,
    level: float = 0.0,
    vapor: Vapor | None = None,
    boiling: tuple[float, float] | None = None,
) -> MeltEstimate:
    """Deepest point where the melt fraction exceeds `level`, over the whole run.

    Args:
        enthalpy, temperature, potential, melt_fraction: nodes of the caloric curve [J/kg, K, W/m,
            1], from the initial state (h = 0) up; end segments are extended.
        density: rho [kg/m^3]. absorption_coefficient: alpha [1/m], inf for surface absorption.
        reflectivity: R, or a function of the surface temperatures and of begin and end of a step.
        fluence: incident energy per area of one pulse [J/m^2]: the peak, or one value for each
            column next to each other, symmetric at both ends, each `column_width` [m] wide.
        delivered: share of one pulse's energy arriving between two times [s].
        end_time: time to stop at [s]; the run ends earlier when the pool has solidified.
        vapor: what leaves the surface; nothing does by default.
        boiling: enthalpy at which a plateau begins, and the latent heat of vaporization [J/kg].

    Raises:
        ValueError: several columns without a width.
    """
    columns = np.atleast_1d(np.asarray(fluence, float))
    if columns.size > 1 and column_width is None:
        raise ValueError("several columns need a column_width")
    curve = ExtendedCurve(enthalpy, temperature, potential, melt_fraction)
    if not delivered(0.0, end_time) > 0.0:
        return MeltEstimate(0.0, np.nan, np.nan, float(curve.temperature(np.zeros(1))[0]))

    # times of the light, grid in depth, and the columns
    times = _light_times(delivered, end_time)
    light = times[-1] - times[0]
    diffusivity = curve.slope.max() / density
    faces = _cell_faces(light, end_time - times[0], absorption_coefficient, diffusivity)
    block = _Block(faces, columns.size, density, column_width, vapor)
    if not callable(reflectivity):
        constant = float(reflectivity)
        reflectivity = lambda T, begin, end: np.full_like(T, constant)  # noqa: E731
    absorbed_share = _share_of_light(faces, absorption_coefficient)

    # beyond its last node the curve would stay flat, and Newton's method would not end
    densest = float(np.max(absorbed_share / np.diff(faces))) / density
    most = float(columns.max()) * max(float(delivered(0.0, end_time)), 1.0) * densest
    if most > curve.nodes[-1]:
        curve = ExtendedCurve(enthalpy, temperature, potential, melt_fraction, most)

    h = np.zeros(block.shape)
    surface = curve.temperature(h[:, 0])
    deepest, start, end, hottest = 0.0, np.nan, np.nan, float(surface[0])
    # lateral conduction is explicit, stable up to 0.5 width^2 / D
    lateral_limit = np.inf if column_width is None else 0.4 * column_width**2 / diffusivity
    schedule = _Schedule(times, end_time, lateral_limit)
    held, steps = 0.0, []
    now = times[0]
    while now < end_time:
        step = schedule.step(now)
        # light by the reflectivity of the surface before the step, then one implicit step
        absorbed = columns * (1.0 - reflectivity(surface, now, now + step))
        heat = np.outer(absorbed * delivered(now, now + step), absorbed_share)
        h = block.advance(h.ravel(), heat.ravel(), step, curve).reshape(block.shape)
        now += step
        surface = curve.temperature(h[:, 0])

        # what the step has reached: surface, fronts, heat held on the boiling plateau
        hottest = max(hottest, float(surface.max()))
        fronts = _fronts(faces, curve.melt_fraction(h), level)
        steps.append((now, surface, fronts))
        if boiling is not None:
            above = np.maximum(h - boiling[0], 0.0) @ np.diff(faces)
            held = max(held, float(above.max()) / boiling[1])
        depth = float(fronts.max())
        if depth > 0.0:
            start = now if np.isnan(start) else start
            deepest, end = max(deepest, depth), now
        elif now >= times[-1]:
            # all has solidified and no light comes any more
            break
    gone = block.evaporated / density
    left = float(gone.mean()), float(gone.max())
    time, temperatures, depths = (np.array(each) for each in zip(*steps, strict=True))
    history = SurfaceHistory(time, temperatures, depths, column_width)
    return MeltEstimate(deepest, float(start), float(end), hottest, *left, held, history)


def _share_of_light(faces: Array, alpha: float) -> Array:
    """Share of the light that each cell between faces [m] absorbs: what is left at its upper face
    less that at its lower."""
    left = np.where(faces > 0.0, 0.0, 1.0) if np.isinf(alpha) else np.exp(-alpha * faces)
    left[-1] = 0.0  # the last cell keeps the rest
    return left[:-1] - left[1:]


class _Block:
    """Columns of cells; advance() takes one step, conserving energy to the solver's tolerance.

    The cells lie in one row, column after column, with no conductance from one to the next.

    Attributes:
        evaporated: (columns,) mass that has left [kg/m^2].
    """

    def __init__(
        self, faces: Array, columns: int, density: float, width: float | None, vapor: Vapor | None
    ):
        self.vapor, self.evaporated = vapor, np.zeros(columns)
        height = np.diff(faces)
        self.height, self.width, self.shape = height, width, (columns, height.size)
        self.mass = np.tile(density * height, columns)
        between = np.append(1.0 / np.diff(0.5 * (faces[1:] + faces[:-1])), 0.0)
        self.outward = np.tile(between + np.append(0.0, between[:-1]), columns)
        self.conductance = np.tile(between, columns)[:-1]
        self.flow = np.zeros(self.mass.size + 1)
        from scipy.linalg import get_lapack_funcs  # loads as long as all else that reads a case

        self.solve_tridiagonal: Any = get_lapack_funcs("gtsv", dtype=np.float64)

    def _outflow(self, theta: Array) -> Array:
        """Heat leaving each cell up and down [W/m^2]."""
        down = self.flow[1:-1]
        np.subtract(theta[:-1], theta[1:], out=down)
        down *= self.conductance
        return self.flow[1:] - self.flow[:-1]

    def _lateral_inflow(self, theta: Array) -> Array | float:
        """Heat entering each cell from the columns beside it [W/m^2 of surface]."""
        if self.width is None:
            return 0.0
        theta = theta.reshape(self.shape)
        inflow = np.zeros_like(theta)
        flow = np.diff(theta, axis=0) * self.height / self.width**2
        inflow[:-1] += flow
        inflow[1:] -= flow
        return inflow.ravel()

    def _evaporation(self, vapor: Vapor, h: Array, curve: ExtendedCurve) -> tuple[Array, Array]:
        """Mass flux (columns,), and power that cells lose by vapor and by the metal that moves up
        through them [W/m^2]."""
        h = h.reshape(self.shape)
        lost = np.zeros_like(h)
        m, q = vapor(curve.temperature(h[:, 0]))
        lost[:, :-1] = m[:, None] * (h[:, :-1] - h[:, 1:])
        lost[:, 0] += q
        return m, lost.ravel()

    def _evaporation_slopes(
        self, vapor: Vapor, h: Array, curve: ExtendedCurve
    ) -> tuple[Array, Array]:
        """Mass flux, and slope in h of the power that the uppermost cells lose, both (columns,)."""
        T = curve.temperature(h[:, 0])
        m, q = vapor(T)
        m_near, q_near = vapor(T + 1.0)
        change = q_near - q + (m_near - m) * (h[:, 0] - h[:, 1])
        return m, change * curve.temperature_slope(h[:, 0])

    def advance(
        self, h0: Array, heat: Array, step: float, curve: ExtendedCurve, halvings: int = 6
    ) -> Array:
        """Newton's method with a line search; where it cycles (isothermal melting makes theta(h)
        kinked), the step is taken as two halves."""
        # residual of the balance of energy, lateral heat and light from the start of the step
        capacity = self.mass / step
        gain = heat / step + self._lateral_inflow(curve.potential(h0))
        tolerance = 1e-5 * np.abs(gain).sum() + 1e-9 * np.abs(capacity * h0).sum()

        def residual(h):
            r = h - h0
            r *= capacity
            r += self._outflow(curve.potential(h))
            if self.vapor is not None:
                r += self._evaporation(self.vapor, h, curve)[1]
            r -= gain
            return r, np.abs(r).sum()

        h, (r, size) = h0, residual(h0)
        for _ in range(12):
            if size <= tolerance:
                break
            change = self._newton_change(h, capacity, r, curve)
            # line search: the first step that lowers the residual
            before = size
            for damping in (1.0, 0.5, 0.25, 0.1):
                trial = h + damping * change
                r, size = residual(trial)
                if size < before:
                    break
            h = trial
        else:
            if halvings > 0:
                # Newton's method has not converged
                half = self.advance(h0, 0.5 * heat, 0.5 * step, curve, halvings - 1)
                return self.advance(half, 0.5 * heat, 0.5 * step, curve, halvings - 1)
        if self.vapor is not None:
            self.evaporated += step * self._evaporation(self.vapor, h, curve)[0]
        # what is left of the residual goes into the cells, so that no energy is lost
        return h - r / capacity

    def _newton_change(self, h: Array, capacity: Array, r: Array, curve: ExtendedCurve) -> Array:
        """Solve (capacity + outflow slope) change = -r, all columns as one tridiagonal system."""
        # d(out)/dh of the cell itself and of those above and below
        slope = curve.potential_slope(h)
        diagonal = capacity + slope * self.outward
        beside = slope[:-1] * self.conductance
        lower, upper = -beside, -self.conductance * slope[1:]
        if self.vapor is not None:
            # metal that moves up and the vapor at the surface
            m, surface = self._evaporation_slopes(self.vapor, h.reshape(self.shape), curve)
            rising = np.zeros(self.shape)
            rising[:, :-1] = m[:, None]
            diagonal += rising.ravel()
            diagonal[:: self.shape[1]] += surface
            upper -= rising.ravel()[:-1]
        *_, change, info = self.solve_tridiagonal(lower, diagonal, upper, -r, 1, 1, 1, 1)
        if info != 0:
            raise ArithmeticError(f"tridiagonal solve failed (LAPACK dgtsv info {info})")
        return change


class _Schedule:
    """Steps that hit the given times of equal energy, then grow by 5 % a step."""

    def __init__(self, times: Array, end_time: float, limit: float):
        self.times, self.end, self.limit = times, end_time, limit
        self.last = np.diff(times).min()
        self.longest = (times[-1] - times[0]) / 20.0

    def step(self, now: float) -> float:
        k = np.searchsorted(self.times, now * (1.0 + 1e-12), side="right")
        if k < self.times.size:
            # up to the next time of light, in equal parts within the lateral limit
            wanted = self.times[k] - now
            step = wanted / max(1.0, np.ceil(wanted / self.limit))
        else:
            # after the light heat spreads ever more slowly
            step = min(1.05 * self.last, self.longest, self.limit)
        self.last = step
        return min(step, self.end - now)


def _light_times(delivered: Delivered, end_time: float) -> Array:
    """Times from the first light to the last, about 1 % of the energy (or of the span) apart."""
    grid = np.linspace(0.0, end_time, 4001)
    energy = delivered(0.0, grid)
    share = energy / energy[-1]
    # from 0.01 % of the energy to 99.99 %
    first = max(int(np.searchsorted(share, 1e-4, side="right")) - 1, 0)
    last = int(np.searchsorted(share, 1.0 - 1e-4, side="left"))
    last = max(last, first + 1)
    # marks at equal parts of energy and of time, so that pauses of the light have steps too
    progress = 0.5 * (share + (grid - grid[first]) / (grid[last] - grid[first]))
    inside = slice(first, last + 1)
    marks = np.linspace(progress[first], progress[last], 151)
    return np.unique(np.interp(marks, progress[inside], grid[inside]))


def _cell_faces(light: float, span: float, alpha: float, diffusivity: float, n: int = 160) -> Array:
    """Depths of the cell faces: a quarter absorption length (but not far below what diffuses in
    the pulse) at the surface, growing geometrically to five diffusion lengths of the whole run."""
    diffused = np.sqrt(diffusivity * light)
    finest = np.clip(0.25 / alpha, 2e-3 * diffused, 0.05 * diffused)
    deepest = 5.0 * np.sqrt(diffusivity * span) + 10.0 / alpha
    # bisection for the growth with which n cells reach the depth; none where even ones do
    low, high, growth = 1.0, 2.0, 1.0
    for _ in range(60 if n * finest < deepest else 0):
        growth = 0.5 * (low + high)
        total = finest * np.expm1(n * np.log(growth)) / (growth - 1.0)
        low, high = (growth, high) if total < deepest else (low, growth)
    return np.concatenate([[0.0], np.cumsum(finest * growth ** np.arange(n))])


def _fronts(faces: Array, fraction: Array, level: float) -> Array:
    """(columns,) depth of the deepest cell in which the fraction exceeds the level, that cell by
    its share [m]."""
    molten = fraction > level
    k = fraction.shape[1] - 1 - molten[:, ::-1].argmax(axis=1)
    share = 1.0 if level > 0.0 else fraction[np.arange(k.size), k]
    return np.where(molten.any(axis=1), faces[k] + share * (faces[k + 1] - faces[k]), 0.0)
