"""Half-space heated at its surface by pulses of constant flux.

    rho c dT/dt = k d2T/dz2,   -k dT/dz (surface) = q while the light is on, else 0

The equation is linear, so a train of pulses is a superposition of steps switched on at the start
and off at the end of each pulse. [Alshaer2017] prints this superposition as A.1 and A.2 (one
pulse) and A.3 and A.4 (trains); its A.3 and A.4 agree with the plain superposition when N is the
index of the current pulse (the paper says the total number). Their terms in `a` are the solution
on the axis of a uniform disc of *radius* a (the paper says diameter).

Left out: phase change, losses, properties that depend on temperature.

Alshaer, Rogers & Li, Computational Materials Science 127 (2017) 161-179, Appendix A;
Carslaw & Jaeger, Conduction of Heat in Solids (1959), 2.9 and 10.5.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def ierfc(x: ArrayLike) -> Array:
    """First integral of erfc: ierfc(x) = exp(-x^2)/sqrt(pi) - x erfc(x)."""
    from scipy.special import erfc  # takes as long to load as all else that reads a case

    x = np.asarray(x, dtype=float)
    return np.exp(-(x**2)) / np.sqrt(np.pi) - x * erfc(x)


def thermal_penetration(diffusivity: float, time: float) -> float:
    """Depth that heat travels in a time [m], z = sqrt(D t) [Alshaer2017, eq. 34]."""
    return float(np.sqrt(diffusivity * time))


def ablated_depth(
    absorbed: float,
    duration: float,
    *,
    density: float,
    heat_capacity: float,
    diffusivity: float,
    rise: float,
    latent_heat: float,
) -> float:
    """Estimated depth [m] that a pulse evaporates, from its balance of energy; 0 below threshold.

        d = (F - rho c dT sqrt(4 D t / pi)) / (rho (c dT + L))

    What is conducted is that of a half-space held at the boiling point. For aluminum and pulses of
    10 ns it is 5 to 7 % less than the Stefan problem of the front, from 5 to 20 J/cm2.

    Args:
        absorbed: fluence F of the pulse [J/m^2]. duration: t [s]. rise: up to the boiling point
            dT [K]. latent_heat: L of melting and evaporation [J/kg].
    """
    # what is left of the fluence after conduction heats and evaporates the depth
    heat = density * heat_capacity * rise
    conducted = heat * float(np.sqrt(4.0 * diffusivity * duration / np.pi))
    return max(0.0, absorbed - conducted) / (heat + density * latent_heat)


def step_rise(
    depth: ArrayLike,
    time: ArrayLike,
    *,
    flux: float,
    conductivity: float,
    diffusivity: float,
    disc_radius: float | None = None,
) -> Array:
    """Temperature rise [K] a time after a constant flux was switched on; 0 for time <= 0.

        2 q sqrt(D t)/k { ierfc(z / 2 sqrt(D t)) - ierfc(sqrt(z^2 + a^2) / 2 sqrt(D t)) }

    Args:
        depth: z [m], broadcast against time. time: t since switching on [s].
        flux: absorbed q [W/m^2]. conductivity: k [W/(m K)]. diffusivity: D [m^2/s].
        disc_radius: radius a of a uniformly heated disc [m], on whose axis the point lies;
            None heats the whole surface.
    """
    depth, time = np.broadcast_arrays(np.asarray(depth, float), np.asarray(time, float))
    # before the switching on any time does: the result is 0 there
    on = time > 0.0
    root = 2.0 * np.sqrt(diffusivity * np.where(on, time, 1.0))
    # on the axis of a disc: less what an endless surface adds from beyond its rim
    shape = ierfc(depth / root)
    if disc_radius is not None:
        shape = shape - ierfc(np.hypot(depth, disc_radius) / root)
    return np.where(on, flux / conductivity * root * shape, 0.0)


def step_rate(
    depth: ArrayLike,
    time: ArrayLike,
    *,
    flux: float,
    conductivity: float,
    diffusivity: float,
    disc_radius: float | None = None,
) -> Array:
    """Heating rate [K/s], the time derivative of `step_rise`; 0 for time <= 0.

    q/k sqrt(D / (pi t)) { exp(-z^2 / 4 D t) - exp(-(z^2 + a^2) / 4 D t) };
    infinite at the surface at the moment of switching.
    """
    depth, time = np.broadcast_arrays(np.asarray(depth, float), np.asarray(time, float))
    on = time > 0.0
    four_dt = 4.0 * diffusivity * np.where(on, time, 1.0)
    shape = np.exp(-(depth**2) / four_dt)
    if disc_radius is not None:
        shape = shape - np.exp(-(depth**2 + disc_radius**2) / four_dt)
    return np.where(
        on, 2.0 * flux / conductivity * diffusivity / np.sqrt(np.pi * four_dt) * shape, 0
    )


def pulse_train_temperature(
    depth: ArrayLike,
    time: ArrayLike,
    *,
    flux: float,
    pulse_duration: float,
    conductivity: float,
    diffusivity: float,
    initial_temperature: float = 0.0,
    off_time: float = 0.0,
    count: int = 1,
    disc_radius: float | None = None,
) -> Array:
    """Temperature [K] under `count` square pulses, the first starting at t = 0 [A.1-A.4].

    Args:
        depth, time: z [m] and t [s], broadcast against each other.
        flux: absorbed (1 - R) I_0 [W/m^2]. pulse_duration: t_p [s]. off_time: t_r between the end
            of one pulse and the start of the next [s]. disc_radius: see `step_rise`.
    """
    train = pulse_duration, off_time, count
    body = {"conductivity": conductivity, "diffusivity": diffusivity, "disc_radius": disc_radius}
    rise = _superpose(step_rise, depth, time, *train, flux=flux, **body)
    return initial_temperature + rise


def pulse_train_rate(
    depth: ArrayLike,
    time: ArrayLike,
    *,
    flux: float,
    pulse_duration: float,
    conductivity: float,
    diffusivity: float,
    off_time: float = 0.0,
    count: int = 1,
    disc_radius: float | None = None,
) -> Array:
    """Heating rate dT/dt [K/s] under `count` square pulses; see `pulse_train_temperature`."""
    train = pulse_duration, off_time, count
    body = {"conductivity": conductivity, "diffusivity": diffusivity, "disc_radius": disc_radius}
    return _superpose(step_rate, depth, time, *train, flux=flux, **body)


def _superpose(step, depth, time, pulse_duration, off_time, count, **properties) -> Array:
    """Sum of steps switched on at each pulse's start and off at its end."""
    time = np.asarray(time, float)
    total = np.zeros(np.broadcast_shapes(np.shape(depth), time.shape))
    # a pulse is a step on at its start less the same step from its end
    for start in np.arange(count) * (pulse_duration + off_time):
        total = total + step(depth, time - start, **properties)
        total = total - step(depth, time - start - pulse_duration, **properties)
    return total
