"""Size of a crater from the height of its columns: depth, width, area, volume, taper.

A column belongs to the crater where its surface lies deeper than half a column's width below the
original one. With A(d) the area of the columns deeper than d and r(d) = sqrt(A(d)/pi) its
equivalent radius (in 2-D half the width), the taper is that of the walls between a tenth and nine
tenths of the largest depth D:

    tan(taper) = (r(D/10) - r(9 D/10)) / (4/5 D),    0 for vertical walls

Where the beam's axis lies at an edge of the computed part (half or quarter of a spot), volume,
areas and widths are those of the whole crater: `mirror_images` says how many times the part was
taken.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

RIM = 0.5
"""Depth from which a column belongs to the crater, in columns' widths."""
UPPER, LOWER = 0.1, 0.9
"""Parts of the largest depth between which the taper is taken."""
DISTANCE_TOLERANCE = 1e-6
"""Distances that differ by less than this part of a column's width are equal."""


@dataclass(frozen=True)
class CraterShape:
    """Sizes of a crater; all 0 where there is none.

    Attributes:
        depth: at the beam's axis, below the original surface [m].
        depth_mean, depth_max: mean over the crater's area and largest [m].
        width: along x through the axis, at the original surface [m]; 0 in 1-D.
        diameter: of the circle of the same area [m]; in 2-D the width, in 1-D 0.
        volume: below the original surface [m^3] (2-D: m^2, 1-D: m).
        taper: of the walls from the vertical [rad]; 0 in 1-D.
        mirror_images: how many times the computed part makes up the crater.
    """

    depth: float = 0.0
    depth_mean: float = 0.0
    depth_max: float = 0.0
    width: float = 0.0
    diameter: float = 0.0
    volume: float = 0.0
    taper: float = 0.0
    mirror_images: int = 1


def crater_shape(
    center: np.ndarray, width: float, top: np.ndarray, axis: np.ndarray, bottom: float
) -> CraterShape:
    """Sizes of the crater below the original surface z = 0.

    Args:
        center: (dim - 1, m) lateral places of the columns [m]. width: of each [m].
        top: (m,) upper face of the condensed matter [m]; NaN where nothing is left.
        axis: (dim - 1,) where the beam's axis meets the surface [m].
        bottom: depth of the body [m], which stands for columns where nothing is left.
    """
    lateral = center.shape[0]
    # columns without condensed matter are holes through the body
    depth = np.where(np.isnan(top), bottom, np.maximum(-top, 0.0))
    is_open = depth > RIM * width
    images = mirror_counts(center, width, axis)
    at_axis = float(np.mean(depth[nearest_columns(center, width, axis)]))
    if not np.any(is_open):
        return CraterShape(depth=at_axis, mirror_images=int(np.prod(images)))
    largest = float(np.max(depth))
    # sizes that any dimension has, the mirrored half included
    shape = {
        "depth": at_axis,
        "depth_mean": float(np.mean(depth[is_open])),
        "depth_max": largest,
        "volume": float(np.sum(depth[is_open])) * width**lateral * int(np.prod(images)),
        "mirror_images": int(np.prod(images)),
    }
    if lateral == 0:
        return CraterShape(**shape)
    # width of the row through the axis, in columns that stand there
    row = is_open if lateral == 1 else is_open & in_row(center, width, axis)
    across = width * np.unique(np.round((center[0, row] - center[0, 0]) / width)).size

    def radius(level: float) -> float:
        area = np.count_nonzero(depth > level) * width**lateral * float(np.prod(images))
        return 0.5 * area if lateral == 1 else float(np.sqrt(area / np.pi))

    # radii of the areas that lie deeper than both levels: the taper between them
    fall = radius(UPPER * largest) - radius(LOWER * largest)
    return CraterShape(
        **shape,
        width=float(across * images[0]),
        diameter=2.0 * radius(RIM * width),
        taper=float(np.arctan2(fall, (LOWER - UPPER) * largest)),
    )


def mirror_counts(center: np.ndarray, width: float, axis: np.ndarray) -> np.ndarray:
    """For each lateral axis 2 where the beam's axis lies at an edge of the columns, else 1."""
    # ends of the columns; without lateral axes there are none
    low = np.min(center, axis=1, initial=np.inf) - 0.5 * width
    high = np.max(center, axis=1, initial=-np.inf) + 0.5 * width
    near = DISTANCE_TOLERANCE * width
    return np.where((np.abs(axis - low) < near) | (np.abs(axis - high) < near), 2, 1)


def nearest_columns(center: np.ndarray, width: float, axis: np.ndarray) -> np.ndarray:
    """Which columns (m,) lie closest to the axis, all of equal distance."""
    distance = np.sqrt(np.sum((center - axis[:, None]) ** 2, axis=0))
    return distance <= np.min(distance) + DISTANCE_TOLERANCE * width


def in_row(center: np.ndarray, width: float, axis: np.ndarray) -> np.ndarray:
    """Which columns (m,) of a surface lie in the row along x closest to the axis."""
    distance = np.abs(center[1] - axis[1])
    first = center[1, np.argmin(distance)]
    return np.abs(center[1] - first) < 0.5 * width
