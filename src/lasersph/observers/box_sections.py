"""Sections through a closed box of liquid: center lines, stream function, sides.

Everything is interpolated from particles by moving least squares. The stream function counts from
the bottom,

    psi(x, z) = int_bottom^z u dz',    u = dpsi/dz,  w = -dpsi/dx,

by the trapezoidal rule, so that psi = 0 along the bottom and, where no liquid crosses the sides,
along all walls: a clockwise eddy has psi < 0 (below a lid that moves to the right, for example).
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from lasersph.observers.interpolation import interpolate
from lasersph.particles.faces import BACK, ENDS, FRONT

FINER = 3


@dataclass(frozen=True)
class Box:
    """Edges of a box [m], and its section: that of a block lies half way between front and back,
    or in the one of them about which the block is mirrored."""

    left: float
    right: float
    bottom: float
    top: float
    front: float = 0.0
    back: float = 0.0
    mirror: str = field(default="", kw_only=True)

    @classmethod
    def around(cls, position: np.ndarray, width: np.ndarray, mirror: str = "") -> Box:
        """The box that particles on a lattice fill; position and width (d, n) [m]."""
        low = np.min(position - 0.5 * width, axis=1).tolist()
        high = np.max(position + 0.5 * width, axis=1).tolist()
        across = (low[1], high[1]) if len(low) == 3 else ()
        return cls(low[0], high[0], low[-1], high[-1], *across, mirror=mirror)

    @property
    def edges(self) -> list[float]:
        """All of them: left, right, bottom, top, front and back [m]."""
        return [self.left, self.right, self.bottom, self.top, self.front, self.back]

    @property
    def width(self) -> float:
        """Along x [m]."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """Along z [m]."""
        return self.top - self.bottom

    @property
    def breadth(self) -> float:
        """Along y [m]; 0 of a section."""
        return self.back - self.front

    @property
    def middle(self) -> float:
        """y of the section of a block [m]."""
        return {FRONT: self.front, BACK: self.back}.get(self.mirror, 0.5 * (self.front + self.back))

    def in_section(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Points (d, m) of the section at some x and z (m,) [m]."""
        y = np.full(x.shape, self.middle)
        return np.stack([x, y, z] if self.breadth else [x, z])

    def with_images(
        self, position: np.ndarray, velocity: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Particles (d, n) [m], [m/s], and their images across the mirror."""
        if not self.mirror:
            return position, velocity
        turned = np.array([[1.0], [-1.0], [1.0]])
        images = turned * position + np.array([[0.0], [2.0 * self.middle], [0.0]])
        return np.hstack([position, images]), np.hstack([velocity, turned * velocity])

    def across(self, shares: np.ndarray) -> np.ndarray:
        """x at some shares of the width, counted from the left [m]."""
        return self.left + self.width * shares

    def up(self, shares: np.ndarray) -> np.ndarray:
        """z at some shares of the height, counted from the bottom [m]."""
        return self.bottom + self.height * shares

    def along(self, side: str, shares: np.ndarray) -> np.ndarray:
        """Points (d, m) of a side, counted from the left or from the bottom [m].

        Of a block those of all pairs of shares, (d, m^2).
        """
        if self.breadth:
            return self._over(side, shares)
        if side in ("left", "right"):
            x = self.left if side == "left" else self.right
            return np.stack([np.full(shares.size, x), self.up(shares)])
        z = self.bottom if side == "bottom" else self.top
        return np.stack([self.across(shares), np.full(shares.size, z)])

    def _over(self, side: str, shares: np.ndarray) -> np.ndarray:
        """Points (3, m^2) of a side of a block [m]."""
        axis, end = ENDS[side]
        places = [
            self.across(shares),
            self.front + self.breadth * shares,
            self.up(shares),
        ]
        places[axis] = np.array([self.edges[2 * (0, 2, 1)[axis] + end]])
        return np.stack([one.ravel() for one in np.meshgrid(*places, indexing="ij")])


@dataclass(frozen=True)
class CenterLines:
    """u over z at half the width, and w over x at half the height; arrays (m,) [m], [m/s]."""

    z: np.ndarray
    u: np.ndarray
    x: np.ndarray
    w: np.ndarray


def center_lines(
    position: np.ndarray, velocity: np.ndarray, box: Box, shares: np.ndarray
) -> CenterLines:
    """Velocity along the two lines through the middle of a box.

    Args:
        position, velocity: (d, n) [m], [m/s].
        shares: (m,) of the height and of the width, from 0 to 1.
    """
    # both lines in one call: half the width upright, half the height level
    middle = np.full(shares.size, 0.5)
    x, z = box.across(shares), box.up(shares)
    upward = box.in_section(box.across(middle), z)
    across = box.in_section(x, box.up(middle))
    places = np.concatenate([upward, across], axis=1)
    found = interpolate(*box.with_images(position, velocity), places, degree=2)
    return CenterLines(z, found[0, : shares.size], x, found[-1, shares.size :])


def stream_function(
    position: np.ndarray, velocity: np.ndarray, box: Box, count: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Stream function on a grid of `count` by `count` nodes from wall to wall.

    It is integrated in steps `FINER` times as fine as the grid.

    Args:
        position, velocity: (2, n) [m], [m/s].

    Returns:
        x (count,), z (count,) [m] and psi (count, count) [m^2/s], rows along z.
    """

    # psi counts from the bottom: trapezoidal rule on a finer grid upward
    x = box.across(np.linspace(0.0, 1.0, count))
    z = box.up(np.linspace(0.0, 1.0, FINER * (count - 1) + 1))
    nodes = np.array([grid.ravel() for grid in np.meshgrid(x, z)])
    u = interpolate(position, velocity[0], nodes, degree=2).reshape(z.size, count)
    steps = 0.5 * (u[1:] + u[:-1]) * np.diff(z)[:, None]
    psi = np.concatenate([np.zeros((1, count)), np.cumsum(steps, axis=0)])
    return x, z[::FINER], psi[::FINER]


def wall_temperature(
    position: np.ndarray, temperature: np.ndarray, box: Box, side: str, count: int
) -> float:
    """Mean temperature of a side [K], extrapolated from particles.

    Args:
        position: (d, n) [m]. temperature: (n,) [K]. count: points along the side.
    """
    # places in the middle of equal parts of the side
    points = box.along(side, (np.arange(count) + 0.5) / count)
    return float(np.mean(interpolate(position, temperature, points, degree=2)))


def extremum(places: np.ndarray, values: np.ndarray, sign: float) -> tuple[float, float]:
    """Place and value of the largest (sign 1) or smallest (-1) of sampled values.

    Within the samples the parabola through the three next to it is taken.

    Args:
        places, values: (m,), places evenly spaced.
    """
    k = int(np.argmax(sign * values))
    if not 0 < k < values.size - 1:
        return float(places[k]), float(values[k])
    # vertex of the parabola through three samples
    before, here, after = (float(values[k + i]) for i in (-1, 0, 1))
    bend = before - 2.0 * here + after
    shift = 0.5 * (before - after) / bend if bend else 0.0
    return (
        float(places[k] + shift * (places[1] - places[0])),
        here - 0.25 * (before - after) * shift,
    )
