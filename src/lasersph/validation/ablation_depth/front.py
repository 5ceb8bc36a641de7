"""Depth that a square pulse ablates: a front-fitted solution of the Stefan problem, as reference.

A half-space takes up a constant flux q at its surface. The surface warms to T_m, melts inward,
warms to T_v, and then recedes while it stays at T_v; the vapor is gone at once:

    rho c dT/dt = k d2T/dz2                     in the liquid a < z < m and the solid z > m
    T(m) = T_m,   rho L_m dm/dt = -k dT/dz(m-) + k dT/dz(m+)
    T(a) = T_v,   rho L_v da/dt = q + k dT/dz(a)       once the surface has reached T_v

Both fronts are fitted: the liquid is mapped onto 0 <= xi <= 1, the solid onto 0 <= y <= DEPTH with
z = m + sqrt(4 D t) y. Chebyshev collocation in space [Trefethen2000, Chapter 6] turns the problem
into stiff ordinary differential equations for `scipy.integrate.solve_ivp`. It starts from the exact
solution before melting and the first term of the expansion after it,

    m = 4/3 k r tau^(3/2) / (rho L_m sqrt(pi D)),   r = q/k sqrt(D/(pi t_m)),   tau = t - t_m

which follows from the solution r tau 4 i2erfc(z/sqrt(4 D tau)) and the flux 2 k r sqrt(tau/(pi D))
of a solid whose surface changes at a rate r, here taken away [Carslaw1959, 2.5].

This shares no code with the solvers: no particles, no enthalpy curve. Left out: a melting range,
properties that differ between solid and liquid, kinetics (T_v does not depend on the recoil), what
flows or is expelled.

[Carslaw1959] Carslaw & Jaeger, Conduction of Heat in Solids. [Trefethen2000] Trefethen, Spectral
Methods in MATLAB.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.special import erfc

from lasersph.analytic.half_space import step_rise

Array = NDArray[np.float64]
LIQUID_NODES, SOLID_NODES = 12, 30
DEPTH = 6.0
"""Depth of the computed solid below the melt, in units of sqrt(4 D t): erfc(6) = 2e-17."""
FIRST_STEP = 3e-3
"""Time from the onset of melting to the start of the integration, over the time of the onset."""
TOLERANCE = 1e-7
"""Relative, of the integration in time; depths are then good to 1e-5 of themselves (tested)."""


@dataclass(frozen=True)
class Metal:
    """Constant properties, SI; the defaults are Table 1 and the text of [Alshaer2017], with the
    latent heat of melting of pure aluminium."""

    density: float = 2705.0
    specific_heat: float = 896.0
    conductivity: float = 167.0
    melting: float = 933.0
    melting_heat: float = 397e3
    vaporization: float = 2730.0
    vaporization_heat: float = 10.53e6
    initial: float = 300.0

    @property
    def diffusivity(self) -> float:
        """D = k/(rho c) [m^2/s]."""
        return self.conductivity / (self.density * self.specific_heat)

    @property
    def full_heat(self) -> float:
        """Heat that turns the cold metal into vapor, c (T_v - T_0) + L_m + L_v [J/kg]."""
        warming = self.specific_heat * (self.vaporization - self.initial)
        return warming + self.melting_heat + self.vaporization_heat


@dataclass(frozen=True)
class Ablation:
    """State of the metal at the end of a pulse.

    Attributes:
        depth: of the ablated layer [m]. melt_depth: of the melting front below the original
            surface [m]. melting_time, boiling_time: onsets [s], None where there is none.
        depths: (p,) below the original surface [m], from the surface that is left downward.
        temperatures: (p,) there [K].
        times, fronts: (s,) [s] and (s,) [m], the ablated depth over time from its onset.
        imbalance: |absorbed - stored - carried away| / absorbed of the numerical solution.
    """

    depth: float
    melt_depth: float
    melting_time: float | None
    boiling_time: float | None
    depths: Array
    temperatures: Array
    times: Array
    fronts: Array
    imbalance: float


def onset(rise: float, flux: float, metal: Metal) -> float:
    """Time at which a constant flux [W/m^2] has warmed the surface by `rise` [K] [s].

    2 q sqrt(D t/pi)/k = rise    [Alshaer2017, (A.1) at z = 0]
    """
    return pi / metal.diffusivity * (metal.conductivity * rise / (2.0 * flux)) ** 2


def ablate(flux: float, duration: float, metal: Metal | None = None) -> Ablation:
    """Ablation by an absorbed flux [W/m^2] that lasts for a duration [s].

    Args:
        flux: (1 - R) F / duration.
        duration: of the square pulse.
        metal: its properties; those of [Alshaer2017] if not given.

    Raises:
        ValueError: flux or duration is not positive, or the metal takes no heat to melt.
        ArithmeticError: the integration failed.
    """
    metal = metal or Metal()
    if not (flux > 0.0 and duration > 0.0 and metal.melting_heat > 0.0):
        raise ValueError("the flux, the duration and the latent heat of melting must be positive")
    # 1. Warm until the surface reaches T_m.
    melting = onset(metal.melting - metal.initial, flux, metal)
    if melting * (1.0 + FIRST_STEP) >= duration:
        return _only_warm(flux, duration, metal)
    # 2. Melt until the surface reaches T_v, or the pulse ends.
    problem = _Problem(flux, metal)
    warm = problem.integrate(problem.start(melting), melting * (1.0 + FIRST_STEP), duration)
    boiling = None
    fronts = warm
    # 3. Recede at T_v until the pulse ends.
    if warm.t_events[0].size:
        boiling = float(warm.t_events[0][0])
        fronts = problem.integrate(warm.y_events[0][0], boiling, duration, ablating=True)
    return problem.result(fronts, melting, boiling)


def _only_warm(flux: float, duration: float, metal: Metal) -> Ablation:
    """A pulse that ends before the surface melts."""
    depths = sqrt(4.0 * metal.diffusivity * duration) * np.linspace(0.0, DEPTH, SOLID_NODES + 1)
    k, diffusivity = metal.conductivity, metal.diffusivity
    rise = step_rise(depths, duration, flux=flux, conductivity=k, diffusivity=diffusivity)
    none = np.zeros(0)
    return Ablation(0.0, 0.0, None, None, depths, metal.initial + rise, none, none, 0.0)


class _Problem:
    """The equations in the unknowns a, m, T inside the liquid, T inside the solid (SI)."""

    def __init__(self, flux: float, metal: Metal) -> None:
        self.flux, self.metal = flux, metal
        # Nodes and derivatives on both mapped intervals.
        self.xi, self.d_liquid = chebyshev(LIQUID_NODES, 1.0)
        self.y, self.d_solid = chebyshev(SOLID_NODES, DEPTH)
        self.d2_liquid = self.d_liquid @ self.d_liquid
        self.d2_solid = self.d_solid @ self.d_solid

    def start(self, melting: float) -> Array:
        """The unknowns `FIRST_STEP` after the onset of melting."""
        # r = q/k sqrt(D/(pi t_m)), the rate at which the surface would go on to warm.
        metal, tau = self.metal, FIRST_STEP * melting
        k, diffusivity = metal.conductivity, metal.diffusivity
        rate = self.flux / k * sqrt(diffusivity / (pi * melting))
        # m = 2/3 (2 k r sqrt(tau/(pi D))) tau / (rho L_m), which is the m of above.
        lack = 2.0 * k * rate * sqrt(tau / (pi * diffusivity))
        front = 2.0 / 3.0 * lack * tau / (metal.density * metal.melting_heat)
        # In the solid: the exact rise, less r tau 4 i2erfc(x) of the surface that is held at T_m.
        depths = self.y[1:-1] * sqrt(4.0 * diffusivity * (melting + tau))
        rise = step_rise(
            depths, melting + tau, flux=self.flux, conductivity=k, diffusivity=diffusivity
        )
        x = depths / sqrt(4.0 * diffusivity * tau)
        missing = rate * tau * ((1.0 + 2.0 * x**2) * erfc(x) - 2.0 * x * np.exp(-(x**2)) / sqrt(pi))
        # In the thin liquid: linear, with the slope q/k.
        liquid = metal.melting + self.flux * front * (1.0 - self.xi[1:-1]) / k
        return np.concatenate([[0.0, front], liquid, metal.initial + rise - missing])

    def profiles(self, unknowns: Array, *, ablating: bool) -> tuple[float, float, Array, Array]:
        """a, m and the temperatures of all nodes of the liquid and of the solid."""
        # Temperatures at the fronts are known, those in between are unknowns.
        metal, inner = self.metal, LIQUID_NODES - 1
        a, m = unknowns[:2]
        liquid = np.concatenate([[metal.vaporization], unknowns[2 : 2 + inner], [metal.melting]])
        if not ablating:  # -k dT/dz = q at the surface says how hot it is
            slope = -self.flux * (m - a) / metal.conductivity
            liquid[0] = (slope - self.d_liquid[0, 1:] @ liquid[1:]) / self.d_liquid[0, 0]
        solid = np.concatenate([[metal.melting], unknowns[2 + inner :], [metal.initial]])
        return float(a), float(m), liquid, solid

    def rates(self, time: float, unknowns: Array, *, ablating: bool) -> Array:
        """Time derivatives of the unknowns."""
        metal = self.metal
        k, diffusivity = metal.conductivity, metal.diffusivity
        a, m, liquid, solid = self.profiles(unknowns, ablating=ablating)
        thickness, scale = m - a, sqrt(4.0 * diffusivity * time)
        # Slopes on both sides of the melting front, dT/dxi / (m - a) and dT/dy / sqrt(4 D t).
        liquid_slope = self.d_liquid @ liquid / thickness
        solid_slope = self.d_solid @ solid / scale
        # Stefan condition at both fronts.
        m_rate = k * (solid_slope[0] - liquid_slope[-1]) / (metal.density * metal.melting_heat)
        a_rate = 0.0
        if ablating:
            a_rate = (self.flux + k * liquid_slope[0]) / (metal.density * metal.vaporization_heat)
        # Nodes move with the fronts: dT/dt at a node is D d2T/dz2 + (speed of the node) dT/dz.
        node_speed = a_rate + self.xi * (m_rate - a_rate)
        of_liquid = diffusivity * self.d2_liquid @ liquid / thickness**2 + node_speed * liquid_slope
        node_speed = m_rate + self.y * 0.5 * scale / time
        of_solid = diffusivity * self.d2_solid @ solid / scale**2 + node_speed * solid_slope
        return np.concatenate([[a_rate, m_rate], of_liquid[1:-1], of_solid[1:-1]])

    def integrate(self, unknowns: Array, start: float, end: float, *, ablating: bool = False):
        """Solution from `start` to `end`, or to the moment at which the surface reaches T_v."""

        def superheat(time: float, values: Array) -> float:
            surface = self.profiles(values, ablating=False)[2][0]
            return float(surface - self.metal.vaporization)

        superheat.terminal = True  # pyright: ignore[reportFunctionMemberAccess]
        superheat.direction = 1.0  # pyright: ignore[reportFunctionMemberAccess]
        # Absolute tolerances of temperatures and of both depths.
        smallest = np.full(unknowns.size, 1e-3 * TOLERANCE * self.metal.vaporization)
        smallest[:2] = 1e-3 * TOLERANCE * sqrt(self.metal.diffusivity * end)

        def rates(time: float, values: Array) -> Array:
            return self.rates(time, values, ablating=ablating)

        events = None if ablating else superheat
        tolerances = {"rtol": TOLERANCE, "atol": smallest}
        found = solve_ivp(rates, (start, end), unknowns, "BDF", events=events, **tolerances)
        if not found.success:
            raise ArithmeticError(f"the fronts could not be followed: {found.message}")
        return found

    def result(self, found, melting: float, boiling: float | None) -> Ablation:
        """Depths, temperatures and energies at the end of a solution."""
        ablating, metal = boiling is not None, self.metal
        a, m, liquid, solid = self.profiles(found.y[:, -1], ablating=ablating)
        # Profile of both phases, the front once.
        time = float(found.t[-1])
        scale = sqrt(4.0 * metal.diffusivity * time)
        depths = np.concatenate([a + (m - a) * self.xi, m + scale * self.y[1:]])
        temperatures = np.concatenate([liquid, solid[1:]])
        # Energy: what is stored in both phases, and what the vapor took along.
        absorbed = self.flux * time
        stored = (m - a) * weights(self.xi) @ (liquid - metal.initial)
        stored += scale * weights(self.y) @ (solid - metal.initial)
        stored = metal.density * (metal.specific_heat * stored + metal.melting_heat * (m - a))
        gone = metal.density * metal.full_heat * a
        return Ablation(
            depth=a if ablating else 0.0,
            melt_depth=m,
            melting_time=melting,
            boiling_time=boiling,
            depths=depths,
            temperatures=temperatures,
            times=found.t if ablating else np.zeros(0),
            fronts=found.y[0] if ablating else np.zeros(0),
            imbalance=float(abs(absorbed - stored - gone)) / absorbed,
        )


def chebyshev(count: int, length: float) -> tuple[Array, Array]:
    """Nodes 0..length, (count + 1,), and the matrix of the first derivative there.

    x_j = length (1 - cos(pi j/count))/2    [Trefethen2000, Chapter 6]
    """
    # Nodes x_j, weights c_j; the diagonal makes each row sum to 0, as the derivative of 1 is 0.
    j = np.arange(count + 1)
    x = 0.5 * length * (1.0 - np.cos(pi * j / count))
    c = np.where((j == 0) | (j == count), 2.0, 1.0) * (-1.0) ** j
    apart = x[:, None] - x[None, :] + np.eye(count + 1)
    matrix = np.outer(c, 1.0 / c) / apart
    np.fill_diagonal(matrix, matrix.diagonal() - matrix.sum(axis=1))
    return x, matrix


def weights(nodes: Array) -> Array:
    """Weights of the integral over Chebyshev nodes 0..length (Clenshaw-Curtis), (n,).

    They solve sum_j w_j T_k(x_j) = integral of T_k for every Chebyshev polynomial T_k.
    """
    count, length = nodes.size - 1, float(nodes[-1])
    # Chebyshev polynomials at their nodes, and their integrals: 2/(1 - k^2) for even k.
    k = np.arange(count + 1)
    values = np.cos(np.outer(k, pi * k / count))
    integrals = np.where(k % 2 == 0, 2.0 / (1.0 - k.astype(float) ** 2 + (k == 1)), 0.0)
    return 0.5 * length * np.linalg.solve(values, integrals)
