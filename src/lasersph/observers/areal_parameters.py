"""Areal parameters of a height map [ISO25178]: Sa, Sq, Sz, Ssk, Sdr.

Heights z count from the least-squares plane through the map, over which means are taken; those of
whole periods from their mean, as a plane through a wave that ends where it begins is level but for
where it was cut:

    Sa = mean |z|,  Sq = sqrt(mean z^2),  Sz = max z - min z,  Ssk = mean z^3 / Sq^3
    Sdr = mean over cells of (area of the surface / area of the cell) - 1

[ISO25178, 4.1, 4.4]. A cell lies between four points; its area is the mean of its two divisions
into triangles. No filter is applied. Points that are missing count in none of them.

Reference: [ISO25178] ISO 25178-2:2021, Geometrical product specifications, Surface texture: Areal,
Part 2: Terms, definitions and surface texture parameters.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class ArealParameters(NamedTuple):
    """Of ISO 25178-2: Sa, Sq, Sz [m], Ssk and Sdr [1]; Ssk of a plane is 0."""

    Sa: float
    Sq: float
    Sz: float
    Ssk: float
    Sdr: float


def areal_parameters(
    z: np.ndarray, dx: float, dy: float, *, repeats: bool = False
) -> ArealParameters:
    """Areal parameters of heights z (ny, nx) [m] at steps dx, dy [m].

    Args:
        repeats: whether the map is whole periods along x and y; then its cells count that lie
            between its last and its first heights, too.

    Raises:
        ValueError: fewer than three heights along x or y, or fewer than three in all.
    """
    if min(z.shape) < 3 or np.count_nonzero(np.isfinite(z)) < 3:
        raise ValueError("areal parameters need three heights or more along x and y")
    level = z - (np.nanmean(z) if repeats else least_squares_plane(z))
    developed = np.pad(level, (0, 1), mode="wrap") if repeats else level
    known = level[np.isfinite(level)]
    Sq = float(np.sqrt(np.mean(known**2)))
    # heights of rounding, some 1e-15 of the largest, have no skewness
    is_plane = Sq <= 1e-12 * float(np.nanmax(np.abs(z)))
    return ArealParameters(
        Sa=float(np.mean(np.abs(known))),
        Sq=Sq,
        Sz=float(np.ptp(known)),
        Ssk=0.0 if is_plane else float(np.mean(known**3)) / Sq**3,
        Sdr=developed_area_ratio(developed, dx, dy),
    )


def least_squares_plane(z: np.ndarray) -> np.ndarray:
    """The plane through heights (ny, nx) that leaves the least squares, at the same places."""
    ny, nx = z.shape
    # places scaled to -1 ... 1, so that the three unknowns are of one size
    rows, columns = np.mgrid[-1.0 : 1.0 : ny * 1j, -1.0 : 1.0 : nx * 1j]
    terms = np.stack([np.ones_like(rows), columns, rows], axis=-1)
    known = np.isfinite(z)
    return terms @ np.linalg.lstsq(terms[known], z[known], rcond=None)[0]


def developed_area_ratio(z: np.ndarray, dx: float, dy: float) -> float:
    """Sdr: by how much the area of a surface exceeds that of its projection."""
    # corners of the cells, each cut along both of its diagonals
    a, b, c, d = z[:-1, :-1], z[:-1, 1:], z[1:, 1:], z[1:, :-1]
    areas = []
    for along, up in ((b - a, c - b), (c - d, d - a), (b - a, d - a), (c - d, c - b)):
        # of the triangle with these rises along x and y: half of |(dx, 0, along) x (0, dy, up)|
        areas.append(0.5 * np.sqrt((dx * dy) ** 2 + (along * dy) ** 2 + (up * dx) ** 2))
    # half of the four triangles: the mean of both cuts
    cell = 0.5 * np.sum(areas, axis=0)
    return float(np.nanmean(cell)) / (dx * dy) - 1.0
