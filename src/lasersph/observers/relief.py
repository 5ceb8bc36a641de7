"""`Relief`: the heights of a surface that moves, by columns; host arrays, SI."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from lasersph.observers.even_places import WHOLE, value_at_zero


@dataclass(frozen=True, eq=False)
class Relief:
    """Heights of a surface, by columns of equal width.

    Attributes:
        x: (columns,) centers, rising [m]; distances from the axis in a section (r, z). height:
            (columns,) z [m]. beyond: what lies beyond both ends: its mirror image, itself again, or
            a wall at which it is pinned. is_section: whether columns are rings. mirror_images: how
            many times the columns make up the whole, see `View`.
    """

    x: np.ndarray
    height: np.ndarray
    beyond: Literal["mirror", "periodic", "pinned"] = "mirror"
    is_section: bool = False
    mirror_images: int = 1

    def __post_init__(self) -> None:
        """Raises ValueError where the columns are fewer than three, or not equally wide."""
        # three columns or more, all of one width
        if self.x.size < 3 or self.x.shape != self.height.shape:
            raise ValueError("a relief needs three columns or more, each with its height")
        if np.ptp(np.diff(self.x)) > WHOLE * abs(self.spacing):
            raise ValueError("the columns of a relief must be equally wide")

    @property
    def spacing(self) -> float:
        """Width of a column [m]."""
        return float(self.x[-1] - self.x[0]) / (self.x.size - 1)

    @property
    def width(self) -> float:
        """Of all columns [m]."""
        return self.spacing * self.x.size

    @property
    def area(self) -> np.ndarray:
        """Surface that each column covers, (columns,), with its mirror images: of rings 2 pi r dr
        [m^2], in a plane its width [m]. Sums over columns are weighted with it."""
        if self.is_section:
            return 2.0 * np.pi * self.x * self.spacing
        return np.full(self.x.size, self.mirror_images * self.spacing)

    @property
    def center(self) -> float:
        """Height at x = 0 [m], on the axis of a section, by four columns around it.

        A relief that begins at x = 0 goes on as its mirror image: (9 z_1 - z_2) / 8.
        """
        return float(value_at_zero(self.x, self.height))

    def volumes(self) -> tuple[float, float]:
        """Volume that is missing below z = 0 and that which stands above it [m^3]; in a plane per
        length [m^2]."""
        z = self.height
        return float(np.maximum(-z, 0.0) @ self.area), float(np.maximum(z, 0.0) @ self.area)

    def highest(self) -> tuple[float, float]:
        """Place and height of the highest point [m]."""
        return self._vertex(int(np.argmax(self.height)))

    def lowest(self) -> tuple[float, float]:
        """Place and height of the lowest point [m]."""
        return self._vertex(int(np.argmin(self.height)))

    def _vertex(self, column: int) -> tuple[float, float]:
        """Vertex of the parabola through a column and its neighbors [m]."""
        z, last = self.height, self.x.size - 1
        # neighbors of the ends: as the kind of the end says
        beyond = {"mirror": (z[0], z[-1]), "periodic": (z[-1], z[0])}.get(self.beyond)
        if beyond is None and column in (0, last):
            return float(self.x[column]), float(z[column])
        left = z[column - 1] if column > 0 else beyond[0] if beyond else z[0]
        right = z[column + 1] if column < last else beyond[1] if beyond else z[-1]
        # vertex of the parabola through three heights, inside the column
        bend, rise = left - 2.0 * z[column] + right, 0.5 * (right - left)
        share = float(np.clip(-rise / bend, -0.5, 0.5)) if bend else 0.0
        height = z[column] + share * rise + 0.5 * share**2 * bend
        return float(self.x[column]) + share * self.spacing, float(height)
