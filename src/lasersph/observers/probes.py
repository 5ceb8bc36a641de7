"""Temperature over time at named points.

`nearest` takes the particle closest to the point and reports where that particle lies; `linear`
combines the closest particles with weights w_j that reproduce every linear field,

    sum_j w_j = 1,  sum_j w_j x_j = x,

the smallest such weights in the norm sum_j w_j^2 |x_j - x|^4, and so also extrapolates to the
surface, half a cell above the first particle (moving least squares: Lancaster and Salkauskas,
Math. Comp. 37 (1981) 141). `even` reproduces a + b x + c z^2 instead, as at a surface that no heat
crosses and light heats from within: a straight line would overshoot there. Neither passes the
vaporization temperature where no particle does.
"""

from __future__ import annotations

import numpy as np

from lasersph.observers.observer import Observer, Row
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View
from lasersph.output.settings import Probe

SUPPORT = {1: 2, 2: 6, 3: 12}
"""Particles that a linear probe combines, by dimension."""


class Probes(Observer):
    """Observes the temperature at probes."""

    title = "probes"
    note = (
        "A probe above the first particles is extrapolated to its place, unless it takes the"
        " nearest, and may be hotter than any particle."
    )
    columns = (
        Quantity(
            "probe_<name>_K",
            "K",
            "temperature",
            largest="probes.<name>.temperature_max_K",
            end="probes.<name>.temperature_end_K",
            is_main=True,
        ),
    )
    results = (
        Quantity("probes.<name>.method", "", "method"),
        Quantity("probes.<name>.depth_m", "m", "depth asked for"),
        Quantity("probes.<name>.x_m", "m", "x asked for"),
        Quantity("probes.<name>.y_m", "m", "y asked for"),
        Quantity("probes.<name>.depth_used_m", "m", "depth used"),
        Quantity("probes.<name>.lateral_used_m", "m", "x and y used"),
    )
    kept = ("where",)

    def __init__(self, probes: tuple[Probe, ...]) -> None:
        """Raises ValueError where two probes have the same name."""
        self.probes = probes
        if len({probe.name for probe in probes}) < len(probes):
            raise ValueError("two probes have the same name")
        (temperature,) = type(self).columns
        self.columns = tuple(temperature.of(probe.name) for probe in probes)
        super().__init__()
        self.where: list[list[float]] = [[] for _ in probes]
        self._found: list[tuple[np.ndarray, np.ndarray, np.ndarray] | None] = [None] * len(probes)

    def observe(self, view: View) -> Row:
        """Temperature of each probe [K]."""
        values = []
        # weights of each probe, and the temperature and place that they give
        for k, probe in enumerate(self.probes):
            particles, weights = self._weights(k, probe, view)
            values.append(limited_mean(view.temperature[particles], weights, view.vaporization))
            self.where[k] = mean_place(view.position[:, particles], weights, probe.method)
        return self.record(view.time, values)

    def _weights(self, k: int, probe: Probe, view: View) -> tuple[np.ndarray, np.ndarray]:
        """Particles and weights of a probe, found again only when the particles have moved."""
        found = self._found[k]
        # particles that do not move keep their weights
        if found is not None:
            particles, weights, place = found
            if np.array_equal(view.position[:, particles], place):
                return particles, weights
        particles, weights = weights_at(view.position, probe.place(view.dimension), probe.method)
        self._found[k] = (particles, weights, view.position[:, particles].copy())
        return particles, weights

    def values(self) -> dict[str, object]:
        """Asked and used place and method of each, and when it was first hottest."""
        found: dict[str, object] = {}
        for probe, where, column in zip(self.probes, self.where, self.columns, strict=True):
            stem = f"probes.{probe.name}"
            found |= {
                f"{stem}.method": probe.method,
                f"{stem}.depth_m": probe.depth,
                f"{stem}.x_m": probe.x,
                f"{stem}.y_m": probe.y,
                f"{stem}.depth_used_m": -where[-1] if where else None,
                f"{stem}.lateral_used_m": where[:-1],
                f"{stem}.temperature_max_at_s": self.peak[column.key].first,
            }
        return found


def mean_place(position: np.ndarray, weights: np.ndarray, method: str) -> list[float]:
    """Place that a probe stands for, from particles at `position` (dim, k), (dim,) [m].

    `even` combines z^2, not z.
    """
    place = position @ weights
    # a field even in z is linear in z^2, so the depth too is a mean of squares
    if method == "even" and weights.size > 1:
        place[-1] = -np.sqrt(max(float(position[-1] ** 2 @ weights), 0.0))
    return [float(value) for value in place]


def limited_mean(temperature: np.ndarray, weights: np.ndarray, vaporization: float | None) -> float:
    """Weighted temperature [K], which does not pass T_v where no particle does.

    Beside a plateau at T_v a straight line would overshoot it.
    """
    value = float(weights @ temperature)
    # no mean of solid and liquid may pass the boiling point of a metal that does not boil there
    if vaporization is not None and float(np.max(temperature)) <= vaporization:
        value = min(value, vaporization)
    return value


def weights_at(
    position: np.ndarray, place: np.ndarray, method: str
) -> tuple[np.ndarray, np.ndarray]:
    """Particles and weights that give a field at a place.

    Args:
        position: (dim, n) [m].
        place: (dim,) [m].
        method: "nearest", "linear" or "even".

    Returns:
        Indices (k,) and weights (k,), which add up to 1.
    """

    # the nearest alone where asked for, or where too few particles span a plane
    offset = position - place[:, None]
    square = np.sum(offset * offset, axis=0)
    dimension, count = position.shape
    if method == "nearest" or count <= dimension:
        return np.array([np.argmin(square)]), np.ones(1)
    # the closest ones, in order of their numbers where they are as close
    wanted = min(SUPPORT[dimension], count)
    particles = np.argpartition(square, wanted - 1)[:wanted]
    particles = particles[np.lexsort((particles, square[particles]))]

    # linear weights, those near the probe most, over the distance of the farthest
    scale = float(np.sqrt(square[particles[-1]]))
    near = offset[:, particles] / scale
    closeness = 1.0 / (np.sum(near * near, axis=0) + 1e-12) ** 2
    linear = np.vstack([np.ones(wanted), near])
    if method == "even":
        linear[-1] = (position[-1, particles] ** 2 - place[-1] ** 2) / scale**2
    # normal equations of a plane through them, solved by the pseudo-inverse
    moments = (linear * closeness) @ linear.T
    target = np.zeros(dimension + 1)
    target[0] = 1.0
    weights = closeness * (linear.T @ (np.linalg.pinv(moments, hermitian=True) @ target))
    return particles, weights / np.sum(weights)
