"""Images of moving particles beyond flat faces: mirrored, or one period away.

A closed box whose faces mirror (or repeat) the particles inside gives every particle a full
support, so that no sum is cut. Image k of particle s lies at

    x_k = sign_k x_s + offset_k            (axis by axis)

and follows its source. Particles closer to a face than `reach` have images; those of one axis are
imaged again across the faces of the next, which fills the corners. What an image's velocity or
temperature is follows from the faces that it crossed and is not known here.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
MIRROR, PERIODIC, OPEN = "mirror", "periodic", "open"
LOWER, UPPER = 1, 2


@dataclass(frozen=True)
class FacePair:
    """Faces of the box along one axis: kinds MIRROR, PERIODIC (both) or OPEN, and places [m]."""

    lower_kind: str
    upper_kind: str
    lower: float
    upper: float


@dataclass(frozen=True)
class Images:
    """Host arrays of k images.

    Attributes:
        source: (k,) particle imaged. sign, offset: (dim, k) [1], [m]. crossed: (dim, k) which face
            of each axis lies between, 0, LOWER or UPPER.
    """

    source: NDArray[np.int64]
    sign: Array
    offset: Array
    crossed: NDArray[np.uint8]

    @property
    def count(self) -> int:
        """Number of images."""
        return self.source.size


def images_of(position: Array, reach: float, faces: Sequence[FacePair]) -> Images:
    """Images of all particles within `reach` [m] of a face.

    Args:
        position: (dim, n) [m]. faces: one pair for each axis.
    """
    dimension, count = position.shape
    source = np.arange(count)
    place = position
    sign, offset = np.ones((dimension, count)), np.zeros((dimension, count))
    crossed = np.zeros((dimension, count), np.uint8)
    for axis, pair in enumerate(faces):
        found: tuple[list[Any], ...] = [source], [place], [sign], [offset], [crossed]
        for side, kind, plane in (
            (LOWER, pair.lower_kind, pair.lower),
            (UPPER, pair.upper_kind, pair.upper),
        ):
            if kind == OPEN:
                continue
            # the image beyond one face of a period belongs to a particle near the other
            near = plane if kind == MIRROR else pair.lower + pair.upper - plane
            chosen = np.flatnonzero(np.abs(place[axis] - near) < reach)
            new_sign, new_offset = sign[:, chosen].copy(), offset[:, chosen].copy()
            new_crossed, new_place = crossed[:, chosen].copy(), place[:, chosen].copy()
            if kind == MIRROR:
                new_sign[axis], new_offset[axis] = -1.0, 2.0 * plane
            else:
                new_offset[axis] = plane - near
            new_crossed[axis] = side
            new_place[axis] = new_sign[axis] * new_place[axis] + new_offset[axis]
            for kept, new in zip(
                found,
                (source[chosen], new_place, new_sign, new_offset, new_crossed),
                strict=True,
            ):
                kept.append(new)
        source, place, sign, offset, crossed = (np.concatenate(part, axis=-1) for part in found)
    return Images(
        source[count:], sign[:, count:].copy(), offset[:, count:].copy(), crossed[:, count:].copy()
    )
