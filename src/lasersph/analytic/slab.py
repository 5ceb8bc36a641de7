"""Layer of finite depth H, insulated at its bottom, under square pulses of constant flux.

    rho c dT/dt = k d2T/dz2,  -k dT/dz = q at z = 0 (light on),  dT/dz = 0 at z = H

Compared with `half_space` it says what a finite domain depth changes. Two exact forms are used,
each where it converges at once (Carslaw & Jaeger 1959, 3.8):

    early  (D t < 0.2 H^2)   sum over all n of the half-space rise at |z + 2 n H|      (images)
    late                     q H/k { Fo + (3 (1-z/H)^2 - 1)/6
                               - 2/pi^2 sum_n (-1)^n/n^2 exp(-n^2 pi^2 Fo) cos(n pi (1-z/H)) }

with Fo = D t/H^2. A pulse absorbed in the volume of a slab: `pulsed_source`, argument `thickness`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lasersph.analytic.half_space import step_rise

Array = NDArray[np.float64]


def slab_step_rise(
    depth: ArrayLike,
    time: ArrayLike,
    *,
    thickness: float,
    flux: float,
    conductivity: float,
    diffusivity: float,
) -> Array:
    """Temperature rise [K] a time after a constant flux was switched on; 0 for time <= 0.

    depth in [0, thickness]; depth and time broadcast against each other; SI units as in
    `half_space.step_rise`.
    """
    depth, time = np.broadcast_arrays(np.asarray(depth, float), np.asarray(time, float))
    fourier = diffusivity * np.maximum(time, 0.0) / thickness**2
    # images at z + 2 n H
    early = np.zeros(depth.shape)
    for n in range(-3, 4):
        early = early + step_rise(
            np.abs(depth + 2 * n * thickness),
            time,
            flux=flux,
            conductivity=conductivity,
            diffusivity=diffusivity,
        )
    # mean rise, parabola, and decaying modes
    y = 1.0 - depth / thickness
    late = fourier + (3.0 * y**2 - 1.0) / 6.0
    for n in range(1, 8):
        mode = (-1) ** n / n**2 * np.exp(-((n * np.pi) ** 2) * fourier) * np.cos(n * np.pi * y)
        late = late - 2.0 / np.pi**2 * mode
    late = flux * thickness / conductivity * late
    return np.where(fourier < 0.2, early, late)
