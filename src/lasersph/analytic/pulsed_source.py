"""Half-space heated by a Gaussian pulse absorbed in its volume, under an interference pattern.

    rho c dT/dt = k lap(T) + A F [1 + C cos(K x)] g(t) alpha exp(-alpha z),   dT/dz (surface) = 0

This is direct laser interference patterning without phase change, [Demuth2020, eqs. 3 and 8] at
constant properties. One joule per square meter deposited at once as alpha exp(-alpha z) has after
a time s spread to (a = alpha sqrt(D s), b = z / 2 sqrt(D s))

    G(z, s) = alpha/2 { exp(a^2 - alpha z) erfc(a - b) + exp(a^2 + alpha z) erfc(a + b) }   [1/m]

and a lateral mode cos(K x) decays as exp(-K^2 D s) meanwhile; the rise is the convolution of both
with the pulse. The products are evaluated with erfcx, where exp(a^2) alone would overflow. The
mean of G over a cell is in closed form too. The convolution is a composite Gauss-Legendre rule in
sqrt(s), good to better than 1e-9 of the rise.

Left out: phase change, losses, properties that depend on temperature.

Demuth & Lasagni, Computation 8 (2020) 9; Carslaw & Jaeger, Conduction of Heat in Solids (1959).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import erf, erfcx

Array = NDArray[np.float64]

FWHM_PER_SIGMA = 2.0 * np.sqrt(2.0 * np.log(2.0))


def impulse_density(
    depth: ArrayLike, elapsed: ArrayLike, alpha: float, diffusivity: float
) -> Array:
    """Share of a deposited energy per depth, G(z, s) [1/m], a time s > 0 after deposition.

    alpha = inf deposits in the surface: G = exp(-b^2) / sqrt(pi D s).
    """
    depth, elapsed = np.broadcast_arrays(np.asarray(depth, float), np.asarray(elapsed, float))
    # a = alpha sqrt(D s), b = z / 2 sqrt(D s); erfcx(x) = exp(x^2) erfc(x)
    root = np.sqrt(diffusivity * elapsed)
    b = depth / (2.0 * root)
    if np.isinf(alpha):
        return np.exp(-(b**2)) / (np.sqrt(np.pi) * root)
    down, up = _mirror_terms(depth, alpha, alpha * root, b)
    return 0.5 * alpha * (down + up)


def impulse_share(depth: ArrayLike, elapsed: ArrayLike, alpha: float, diffusivity: float) -> Array:
    """Share of a deposited energy lying above a depth, the integral of G from 0 to z.

    erf(b) - 1/2 { exp(a^2 - alpha z) erfc(a - b) - exp(a^2 + alpha z) erfc(a + b) }
    """
    depth, elapsed = np.broadcast_arrays(np.asarray(depth, float), np.asarray(elapsed, float))
    root = np.sqrt(diffusivity * elapsed)
    b = depth / (2.0 * root)
    if np.isinf(alpha):
        return erf(b)
    down, up = _mirror_terms(depth, alpha, alpha * root, b)
    return erf(b) - 0.5 * (down - up)


def _mirror_terms(depth: Array, alpha: float, a: Array, b: Array) -> tuple[Array, Array]:
    """exp(a^2 - 2ab) erfc(a - b) and exp(a^2 + 2ab) erfc(a + b) with 2ab = alpha z, no overflow."""
    # exp(a^2 + 2ab) erfc(a + b) = exp(-b^2) erfcx(a + b)
    damping = np.exp(-(b**2))
    up = damping * erfcx(a + b)
    # for a < b by erfc(-x) = 2 - erfc(x), so that erfcx has no negative argument
    ahead = damping * erfcx(np.abs(a - b))
    behind = 2.0 * np.exp(np.where(a < b, a**2 - alpha * depth, -np.inf)) - ahead
    return np.where(a < b, behind, ahead), up


def gaussian_pulse_rise(
    depth: ArrayLike,
    time: ArrayLike,
    *,
    fluence: float,
    fwhm: float,
    center: float,
    conductivity: float,
    volumetric_heat_capacity: float,
    absorption_coefficient: float = np.inf,
    wavenumber: float = 0.0,
    depth_bottom: ArrayLike | None = None,
    thickness: float | None = None,
) -> Array:
    """Temperature rise [K] of one lateral mode, shape (times, depths).

    Args:
        depth: z [m], 1-D. depth_bottom: if given, the rise is averaged over the cells from
            `depth` to `depth_bottom`. time: t [s], 1-D, any times, also before the pulse.
        fluence: *absorbed* energy per area of the mode, (1 - R) F [J/m^2].
        fwhm, center: duration at half maximum and time of the maximum [s].
        conductivity: k [W/(m K)]. volumetric_heat_capacity: rho c [J/(m^3 K)].
        absorption_coefficient: alpha [1/m]; inf absorbs in the surface.
        wavenumber: K of the mode cos(K x) [1/m]; 0 is the laterally uniform part.
        thickness: depth of an insulated bottom [m], by images; None is the half-space.
    """
    top = np.atleast_1d(np.asarray(depth, float))
    bottom = None if depth_bottom is None else np.atleast_1d(np.asarray(depth_bottom, float))
    diffusivity = conductivity / volumetric_heat_capacity
    sigma = fwhm / FWHM_PER_SIGMA
    times = np.atleast_1d(np.asarray(time, float))
    rise = np.zeros((times.size, top.size))
    for row, t in enumerate(times):
        # convolution of the pulse with the decaying mode, at the nodes of the elapsed time
        elapsed, weight = _quadrature(t - center, sigma, diffusivity, absorption_coefficient)
        if elapsed.size == 0:
            continue
        pulse = np.exp(-0.5 * ((t - center - elapsed) / sigma) ** 2) / (sigma * np.sqrt(2 * np.pi))
        weight = weight * pulse * np.exp(-(wavenumber**2) * diffusivity * elapsed)
        # the half-space, or its images in an insulated bottom
        for image_top, image_bottom, sign in _images(top, bottom, thickness, diffusivity, elapsed):
            rise[row] += (
                sign
                * weight
                @ _impulse_response(
                    image_top, image_bottom, elapsed[:, None], absorption_coefficient, diffusivity
                )
            )
    return fluence / volumetric_heat_capacity * rise


def interference_rise(
    x: ArrayLike,
    depth: ArrayLike,
    time: ArrayLike,
    *,
    period: float,
    contrast: float = 1.0,
    **pulse,
) -> Array:
    """Rise [K] under the pattern F [1 + C cos(2 pi x / period)], shape (times, points).

    x and depth (and depth_bottom) are paired: one point each. `fluence` is the absorbed *mean*.
    The other arguments are those of `gaussian_pulse_rise`.
    """
    wavenumber = 2.0 * np.pi / period
    mean = gaussian_pulse_rise(depth, time, **pulse)
    mode = gaussian_pulse_rise(depth, time, wavenumber=wavenumber, **pulse)
    return mean + contrast * np.cos(wavenumber * np.atleast_1d(np.asarray(x, float))) * mode


def _impulse_response(top, bottom, elapsed, alpha, diffusivity) -> Array:
    """G at the depths, or its cell mean, shape (elapsed, depths)."""
    if bottom is None:
        return impulse_density(np.abs(top), elapsed, alpha, diffusivity)
    # mean over a cell: difference of the integral of G, which is odd in z
    above_bottom = np.sign(bottom) * impulse_share(np.abs(bottom), elapsed, alpha, diffusivity)
    above_top = np.sign(top) * impulse_share(np.abs(top), elapsed, alpha, diffusivity)
    return (above_bottom - above_top) / (bottom - top)


def _images(top, bottom, thickness, diffusivity, elapsed):
    """Shifted copies of the depths whose half-space solutions add up to an insulated slab.

    G is even in z, so the slab is the sum over G(z + 2 n H) for all whole n.
    """
    yield top, bottom, 1.0
    if thickness is None:
        return
    # images further away than heat has come add nothing
    farthest = 14.0 * np.sqrt(diffusivity * elapsed.max()) + 2.0 * thickness
    for n in range(1, int(np.ceil(farthest / (2.0 * thickness))) + 1):
        shift = 2.0 * n * thickness
        for s in (shift, -shift):
            yield top + s, None if bottom is None else bottom + s, 1.0


def _quadrature(delay: float, sigma: float, diffusivity: float, alpha: float):
    """Nodes s and weights of the convolution over the elapsed time, Gauss-Legendre in sqrt(s).

    The pulse is cut 9 sigma from its maximum (1e-19 of the energy). Panels end at multiples of
    sigma and halve toward s = 0, where the response varies over times down to 1/(alpha^2 D).
    """
    last, first = delay + 9.0 * sigma, max(0.0, delay - 9.0 * sigma)
    if last <= 0.0:
        return np.empty(0), np.empty(0)
    # panels end at multiples of sigma, and at powers of 1/4 of the longest time
    edges = [e for e in delay + sigma * np.arange(-9.0, 10.0) if first < e < last]
    edges += [last * 0.25**k for k in range(1, 18) if last * 0.25**k > first]
    edges = np.sqrt(np.array(sorted({first, last, *edges})))
    x, w = np.polynomial.legendre.leggauss(20)
    # s = u^2, ds = 2 u du
    half = 0.5 * np.diff(edges)[:, None]
    u = (edges[:-1, None] + half * (x + 1.0)).ravel()
    return u * u, (half * w).ravel() * 2.0 * u
