"""Flows between two parallel planes, from rest: driven by a moving wall, a force or a stress.

The planes lie at y = 0 (at rest) and y = H; one velocity component u(y, t) along them:

    du/dt = g + nu d2u/dy2,    u(y, 0) = 0

Couette     u(H) = U:              u -> U y/H
Poiseuille  u(H) = 0, force g:     u -> g y (H - y)/(2 nu)
Shear       eta du/dy = tau at H:  u -> tau y/eta

The transients are sums over decaying sine modes, exact at every t >= 0 but for the number of modes.
`return_flow` is the steady flow of a closed channel whose surface is sheared: no net flux.

Morris, Fox & Zhu, J. Comput. Phys. 136 (1997) 214-226, Section 3 (Couette and Poiseuille);
Birikh, J. Appl. Mech. Tech. Phys. 7 (1966) 43-44 (return flow).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
MODES = 400


def couette(y: ArrayLike, time: float, *, gap: float, speed: float, viscosity: float) -> Array:
    """u [m/s] at y [m] after the wall y = gap was set in motion with `speed`.

    viscosity: kinematic [m^2/s]. y of any shape; the result has it too.
    """
    y = np.asarray(y, float)
    n = np.arange(1, MODES + 1).reshape((-1,) + (1,) * y.ndim)
    decay = np.exp(-viscosity * (n * np.pi / gap) ** 2 * time)
    modes = 2.0 / (n * np.pi) * (-1.0) ** n * np.sin(n * np.pi * y / gap) * decay
    return speed * (y / gap + modes.sum(axis=0))


def poiseuille(y: ArrayLike, time: float, *, gap: float, force: float, viscosity: float) -> Array:
    """u [m/s] at y [m] after a force per mass [m/s^2] was switched on between walls at rest."""
    y = np.asarray(y, float)
    # odd modes alone: the flow is symmetric about the middle
    n = 2.0 * np.arange(MODES).reshape((-1,) + (1,) * y.ndim) + 1.0
    decay = np.exp(-viscosity * (n * np.pi / gap) ** 2 * time)
    modes = 4.0 * force * gap**2 / (viscosity * (n * np.pi) ** 3)
    modes = modes * np.sin(n * np.pi * y / gap) * decay
    return 0.5 * force / viscosity * y * (gap - y) - modes.sum(axis=0)


def sheared(
    y: ArrayLike, time: float, *, gap: float, stress: float, viscosity: float, density: float
) -> Array:
    """u [m/s] at y [m] after a stress [Pa] began to pull the free plane y = gap."""
    y = np.asarray(y, float)
    n = np.arange(MODES).reshape((-1,) + (1,) * y.ndim)
    # a quarter of a wave more: no stress of the modes at the free plane
    rate = (n + 0.5) * np.pi / gap
    decay = np.exp(-viscosity * rate**2 * time)
    modes = 2.0 * (-1.0) ** n / (gap * rate**2) * np.sin(rate * y) * decay
    return stress / (viscosity * density) * (y - modes.sum(axis=0))


def return_flow(y: ArrayLike, *, gap: float, stress: float, viscosity: float) -> Array:
    """Steady u [m/s] at y [m] in a long closed channel whose surface y = gap a stress [Pa] pulls.

        u = tau H/(4 eta) (3 (y/H)^2 - 2 y/H),  surface tau H/(4 eta),  net flux 0

    viscosity: dynamic, eta [Pa s].
    """
    s = np.asarray(y, float) / gap
    return stress * gap / (4.0 * viscosity) * (3.0 * s**2 - 2.0 * s)
