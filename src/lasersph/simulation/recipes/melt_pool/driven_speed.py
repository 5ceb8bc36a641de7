"""The speed to expect of the surface of a pool, from how hot light makes it along x.

Between two columns of the estimate of the melt (`analytic.melt_depth`) the surface is drawn by the
gradient of surface tension, tau = dgamma/dT dT/dx, and pushed by that of the recoil, -dp/dx. A half
space at rest answers to a stress by Stokes' first problem, one above a bottom at the depth d of the
melt with a time d^2/(c nu), so that it ends at tau d/(sqrt(c) eta):

    u(t) = int tau(t') exp(-c nu (t - t')/d^2) / (rho sqrt(pi nu (t - t'))) dt'

c = 16 below a lid, whose pressure drives all the liquid back at once, and 1 below a surface that
moves, which has to rise first. To a pressure that reaches through it the layer answers by

    du/dt = -dp/dx / rho - pi^2 nu u/(4 d^2),

the decay of flow over a bottom without slip. Left out: heat and momentum that the flow itself takes
along.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from lasersph.analytic.melt_depth import SurfaceHistory

Array = NDArray[np.float64]
BELOW_LID, BELOW_MOVING_SURFACE = 16.0, 1.0
"""Rate over nu/d^2 at which a layer above a bottom gives way, c of above. Derived: from the speed
over a closed layer, tau d/(4 eta), and over an open one, tau d/eta."""


def driven_speed(
    surface: SurfaceHistory,
    *,
    length: float,
    cold: float,
    density: float,
    viscosity: Callable[[Array], Array],
    slope: Callable[[Array], Array],
    pressure: Callable[[Array], Array],
    confinement: float,
) -> float:
    """Largest speed of the surface [m/s]; 0 where nothing melts.

    Args:
        surface: of the estimate; of one column the liquid reaches from its temperature to `cold`.
        length: over which it does so [m]. cold: lowest temperature of the liquid [K].
        density: [kg/m^3]. viscosity: kinematic [m^2/s], slope: dgamma/dT [N/(m K)], pressure: of
            the recoil [Pa], all at temperatures [K]. confinement: c.
    """
    T = surface.temperature
    depth = surface.depth
    width = surface.column_width
    # A single column: the liquid next to it is as cold as its melting point.
    if T.shape[1] == 1 or width is None:
        beside = np.minimum(T, cold)
        T = np.hstack([T, beside])
        depth = np.hstack([depth, depth])
        width = length
    # Stress and push between two columns, where both are molten: tau = dgamma/dT dT/dx, -dp/dx /
    # rho.
    middle = 0.5 * (T[:, 1:] + T[:, :-1])
    molten = np.minimum(depth[:, 1:], depth[:, :-1])
    stress = np.where(molten > 0.0, slope(middle) * np.diff(T, axis=1) / width, 0.0)
    push = np.where(molten > 0.0, -np.diff(pressure(T), axis=1) / (width * density), 0.0)
    speed = _drawn(surface.time, stress / density, viscosity(middle), molten, confinement)
    speed += _pushed(surface.time, push, viscosity(middle), molten)
    return float(np.abs(speed).max())


def _drawn(time: Array, stress: Array, nu: Array, depth: Array, confinement: float) -> Array:
    """(n, places) speed under a stress over density [m^2/s^2], by the integral of above."""
    from scipy.special import erf  # loads as long as all else that reads a case

    # Stress is constant from one time of the estimate to the next.
    speed = np.zeros_like(stress)
    start = np.concatenate([time[:1], time[:-1]])
    for step in np.flatnonzero((depth > 0.0).any(axis=1)):
        decay = confinement * nu[step] / np.where(depth[step] > 0.0, depth[step], np.inf) ** 2
        # The integral needs a decay above zero; deep melt has none of its own.
        decay = np.maximum(decay, 1e-12 / time[step])
        # the integral of exp(-decay s)/sqrt(s) over each earlier step, in closed form
        near, far = (
            erf(np.sqrt(decay * np.maximum(time[step] - then[: step + 1, None], 0.0)))
            for then in (time, start)
        )
        sums = np.sum(stress[: step + 1] * (far - near) / np.sqrt(nu[: step + 1]), axis=0)
        speed[step] = np.where(depth[step] > 0.0, sums / np.sqrt(decay), 0.0)
    return speed


def _pushed(time: Array, push: Array, nu: Array, depth: Array) -> Array:
    """(n, places) speed under an acceleration [m/s^2] of a layer that rubs on its bottom."""
    speed = np.zeros_like(push)
    for step in range(1, time.size):
        dt = time[step] - time[step - 1]
        # Implicit Euler: u_n = (u_(n-1) + dt a_n) / (1 + dt pi^2 nu / (4 d^2)).
        is_liquid = depth[step] > 0.0
        decay = 0.25 * np.pi**2 * nu[step] / np.where(is_liquid, depth[step], np.inf) ** 2
        changed = (speed[step - 1] + dt * push[step]) / (1.0 + dt * decay)
        speed[step] = np.where(is_liquid, changed, 0.0)
    return speed
