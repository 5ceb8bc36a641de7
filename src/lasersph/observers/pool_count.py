"""Number of melt pools at the surface of a run in 3-D.

Two pools are one where they share a side of a surface cell; two that touch in a corner stay two, as
nothing flows from one into the other. Cells count that are half molten (f_m = 0.5), on a grid of
the narrowest ones, each place with the state of the nearest surface particle. A pool on a plane of
symmetry is one with its mirror image, any other one is two; sides that repeat are one side.
"""

from __future__ import annotations

import numpy as np

from lasersph.observers.melt_pool import HALF, remaining_fraction
from lasersph.observers.observer import Observer, Row
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View


class PoolCount(Observer):
    """Counts melt pools of the whole: of a period, or with the mirror images of what is computed.

    Args:
        periodic: whether x and y repeat beyond their ends.
    """

    title = "melt pools"
    note = "Pools that share a side of a surface cell are one; cells count at f_m = 0.5."
    columns = (
        Quantity("melt_pools", "", "number of melt pools at the surface", largest="melt.pools_max"),
    )

    def __init__(self, periodic: tuple[bool, bool] = (False, False)) -> None:
        super().__init__()
        self.periodic = periodic

    def observe(self, view: View) -> Row:
        """Number of pools at this step."""
        is_molten = remaining_fraction(view)[view.surface] >= HALF
        found = 0
        if np.any(is_molten):
            found = count_pools(surface_grid(view, is_molten), mirrored_axes(view), self.periodic)
        return self.record(view.time, (found,))

    def summary(self) -> dict[str, object]:
        """Nothing where nothing melted."""
        return super().summary() if self.peak["melt_pools"].value > 0.0 else {}


def mirrored_axes(view: View) -> tuple[bool, bool]:
    """Whether the mirror image along x, and along y, belongs to the whole."""
    if view.mirror_images == 4:
        return True, True
    is_half_of_x = view.symmetry_factor == 2 or any(view.halves_spot)
    is_half = view.mirror_images == 2
    return is_half and is_half_of_x, is_half and not is_half_of_x


def surface_grid(view: View, chosen: np.ndarray) -> np.ndarray:
    """Whether the surface particle nearest to each place of an even grid is chosen, (nx, ny).

    Args:
        view: the state in 3-D. chosen: (s,) of the particles of `view.surface`.
    """
    from scipy.spatial import KDTree

    place, half = view.position[:2, view.surface], 0.5 * view.width[:2, view.surface]
    low, high = np.min(place - half, axis=1), np.max(place + half, axis=1)
    step = 2.0 * np.min(half, axis=1)
    # middles of cells as wide as the narrowest one
    counts = np.maximum(np.round((high - low) / step).astype(int), 1)
    axes = [low[k] + (np.arange(counts[k]) + 0.5) * step[k] for k in range(2)]
    x, y = np.meshgrid(*axes, indexing="ij")
    _, nearest = KDTree(place.T).query(np.stack([x.ravel(), y.ravel()], axis=1))
    return chosen[nearest].reshape(x.shape)


def count_pools(
    is_molten: np.ndarray, mirrored: tuple[bool, bool], periodic: tuple[bool, bool]
) -> int:
    """Number of connected parts of the whole of a grid (nx, ny).

    Args:
        mirrored: whether the mirror image along x, and along y, belongs to the whole; a part at
            either end is then its own image. periodic: whether the ends of x, and of y, are one.
    """
    from scipy.ndimage import label

    names = np.zeros(is_molten.shape, np.int32)
    label(is_molten, output=names)
    count = int(np.max(names))
    # parts that are one across a side that repeats: a graph of their numbers
    same = np.arange(count + 1)
    for axis in np.flatnonzero(periodic):
        first, last = (np.take(names, end, axis=axis) for end in (0, -1))
        for a, b in np.unique(np.stack([first, last])[:, (first > 0) & (last > 0)], axis=1).T:
            same[same == same[a]] = same[b]
    parts = np.unique(same[1:])
    images = np.ones(count + 1, int)
    # two of each that no plane of symmetry cuts
    for axis in np.flatnonzero(mirrored):
        ends = np.concatenate([np.take(names, end, axis=axis) for end in (0, -1)])
        images[parts[~np.isin(parts, same[ends[ends > 0]])]] *= 2
    return int(np.sum(images[parts]))
