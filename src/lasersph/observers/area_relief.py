"""`AreaRelief`: the heights of a surface that moves over x and y, by columns; host arrays, SI."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from lasersph.observers.areal_parameters import ArealParameters, areal_parameters
from lasersph.observers.even_places import WHOLE, refuse_parts, value_at_zero

Beyond = Literal["mirror", "periodic", "pinned"]
PADDING: dict[Beyond, Literal["symmetric", "wrap", "edge"]] = {
    "mirror": "symmetric",
    "periodic": "wrap",
    "pinned": "edge",
}
"""How NumPy goes on with an array beyond an end of each kind."""
FLAT = 1e-9
"""Curvature over the largest one, below which a direction does not bend. Rounding: of heights."""


@dataclass(frozen=True, eq=False)
class AreaRelief:
    """Heights of a surface in 3-D, by columns of equal area.

    Attributes:
        x: (nx,), y: (ny,) centers of the columns, rising [m]. height: (nx, ny) mean heights of the
            columns [m], x first. beyond: what lies beyond both ends of x, and of y: the mirror
            image, the heights again, or a wall at which they are pinned. mirror_images: how many
            times the columns make up the whole, see `View`.
    """

    x: np.ndarray
    y: np.ndarray
    height: np.ndarray
    beyond: tuple[Beyond, Beyond] = ("mirror", "mirror")
    mirror_images: int = 1

    def __post_init__(self) -> None:
        """Raises ValueError where an axis has fewer than three columns, or not equally wide."""
        shape = (self.x.size, self.y.size)
        if min(shape) < 3 or self.height.shape != shape:
            raise ValueError("a relief needs three columns or more along x and y, with heights")
        for axis, step in zip((self.x, self.y), self.steps, strict=True):
            if np.ptp(np.diff(axis)) > WHOLE * abs(step):
                raise ValueError("the columns of a relief must be equally wide")

    @property
    def steps(self) -> tuple[float, float]:
        """Widths of a column along x and y [m]."""
        dx, dy = (float(axis[-1] - axis[0]) / (axis.size - 1) for axis in (self.x, self.y))
        return dx, dy

    @property
    def widths(self) -> tuple[float, float]:
        """Of all columns along x and y [m]."""
        dx, dy = self.steps
        return dx * self.x.size, dy * self.y.size

    @property
    def center(self) -> float:
        """Height at x = y = 0 [m], by four columns around it along each axis."""
        return float(value_at_zero(self.y, value_at_zero(self.x, self.height)))

    def volumes(self) -> tuple[float, float]:
        """Volume that is missing below z = 0 and that which stands above it, of the whole [m^3]."""
        dx, dy = self.steps
        area = self.mirror_images * dx * dy
        missing, raised = np.maximum(-self.height, 0.0), np.maximum(self.height, 0.0)
        return area * float(np.sum(missing)), area * float(np.sum(raised))

    def first_harmonic(self, period: float, period_y: float | None = None) -> float:
        """a11 = 4/(Lx Ly) times the integral of z cos(2 pi x/Lx) cos(2 pi y/Ly) over a period [m].

        The mean of the cosines over each column is taken exactly, as the heights are those of
        columns.

        Args:
            period: Lx [m]. period_y: Ly [m]; None where nothing repeats along y, of which the mean
                is taken then: (2/Lx) times the integral over x.

        Raises:
            ValueError: the columns hold no whole half periods.
        """
        found = self.height
        lengths = (period, period_y)
        for places, step, width, length in zip(
            (self.x, self.y), self.steps, self.widths, lengths, strict=True
        ):
            if length is None:
                found = np.mean(found, axis=0)
                continue
            refuse_parts(width, length)
            # twice the mean over this axis, which is then gone
            cosine = np.cos(2.0 * np.pi * places / length) * np.sinc(step / length)
            found = 2.0 * np.tensordot(cosine, found, axes=1) / places.size
        return float(found)

    def parameters(self) -> ArealParameters:
        """Parameters of ISO 25178 over whole periods, about the mean height; where an end is
        pinned nothing repeats, and heights count from their least-squares plane."""
        z = self.height
        # the mirror image completes half a period
        for axis, beyond in enumerate(self.beyond):
            if beyond == "mirror":
                z = np.concatenate([z, np.flip(z, axis)], axis)
        return areal_parameters(z.T, *self.steps, repeats="pinned" not in self.beyond)

    def highest(self) -> tuple[tuple[float, float], float]:
        """Place (x, y) and height of the highest point [m]."""
        return self._vertex(int(np.argmax(self.height)))

    def lowest(self) -> tuple[tuple[float, float], float]:
        """Place (x, y) and height of the lowest point [m]."""
        return self._vertex(int(np.argmin(self.height)))

    def _vertex(self, column: int) -> tuple[tuple[float, float], float]:
        """Vertex of the paraboloid z0 + g.s + s.H s/2 through a column and its eight neighbors."""
        i, j = np.unravel_index(column, self.height.shape)
        z = self.height
        for axis, beyond in enumerate(self.beyond):
            ends = [(1, 1) if k == axis else (0, 0) for k in range(2)]
            z = np.pad(z, ends, mode=PADDING[beyond])
        around = z[i : i + 3, j : j + 3]

        # central differences in units of a column; at a pinned end the column itself
        g = 0.5 * np.array([around[2, 1] - around[0, 1], around[1, 2] - around[1, 0]])
        bend = [around[2, 1] + around[0, 1], around[1, 2] + around[1, 0]] - 2.0 * around[1, 1]
        twist = 0.25 * (around[2, 2] - around[2, 0] - around[0, 2] + around[0, 0])
        H = np.array([[bend[0], twist], [twist, bend[1]]])
        for axis, (number, size) in enumerate(zip((i, j), self.height.shape, strict=True)):
            if self.beyond[axis] == "pinned" and number in (0, size - 1):
                g[axis], H[axis], H[:, axis] = 0.0, 0.0, 0.0
        # along directions that do not bend the vertex stays at the column
        share = np.clip(-np.linalg.pinv(H, rcond=FLAT, hermitian=True) @ g, -0.5, 0.5)
        height = float(around[1, 1] + g @ share + 0.5 * share @ H @ share)
        dx, dy = self.steps
        return (float(self.x[i] + share[0] * dx), float(self.y[j] + share[1] * dy)), height
