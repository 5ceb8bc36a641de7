"""Particles of a 2-D pool or box, near a lattice, with their pairs: for tests of pressure solvers.

Spacing 1 / `rows`, box 0 < x < width, -1 < z < 0. Images beyond the faces are mirrored or one
period away, and folded onto their sources; plain NumPy, apart from what the package does itself.
"""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
from scipy.spatial import cKDTree

from lasersph.sph.kernels import kernel

RATIO = 3.75
LEFT, RIGHT, BOTTOM, TOP, NONE = range(5)


@dataclass(frozen=True)
class Scattered:
    """Pairs (i, j) with weights g; `face` is the face that a ghost lies beyond, else NONE.

    partner: (2, pairs) where j or its ghost lies [m].
    """

    position: np.ndarray
    spacing: float
    period: tuple
    i: np.ndarray
    j: np.ndarray
    g: np.ndarray
    face: np.ndarray
    partner: np.ndarray

    @property
    def count(self):
        return self.position.shape[1]

    @property
    def support(self):
        return RATIO * self.spacing

    @property
    def volume(self):
        return np.full(self.count, self.spacing**2)

    def neighbors(self, backend):
        """Folded list."""
        start = np.concatenate([[0], np.cumsum(np.bincount(self.i, minlength=self.count))])
        return SimpleNamespace(
            row_end=None,
            row_start=backend.asarray(start, "offset"),
            neighbor=backend.asarray(self.j, "index"),
            position=backend.asarray(self.position),
            support=backend.asarray(np.full(self.count, self.support)),
            kernel=None,
            mean=None,
            period=(0.0, 0.0),
        )

    def dense(self, mask=None, coefficient=0.0):
        """A = sum g (p_i - p_j) + a p on the particles of the mask, as a matrix of all."""
        mask = np.ones(self.count) if mask is None else mask
        A = np.zeros((self.count, self.count))
        g = self.g * mask[self.i] * mask[self.j]
        np.add.at(A, (self.i, self.j), -g)
        A[np.arange(self.count), np.arange(self.count)] += np.bincount(
            self.i, g, minlength=self.count
        )
        return A + np.diag(coefficient * mask)

    def arrays(self, backend, *arrays):
        """On the backend."""
        return [backend.asarray(array) for array in arrays]


def scattered(rows, width=1.0, *, jitter=0.0, seed=0, is_periodic=False, mirrors=range(4),
              inside=None):  # fmt: skip
    """Particles of the box, or of the part of it where `inside(x, z)`."""
    d = 1.0 / rows
    x, z = np.meshgrid((np.arange(round(width / d)) + 0.5) * d, -(np.arange(rows) + 0.5) * d)
    position = np.array([x.ravel(), z.ravel()])
    if inside is not None:
        position = position[:, inside(*position)]
    step = np.random.default_rng(seed).uniform(-jitter, jitter, position.shape)
    position = position + d * step
    places, sources, faces = [position], [np.arange(position.shape[1])], []
    faces = [np.full(position.shape[1], NONE)]
    for axis, (low, high), names in (
        (0, (0.0, width), (LEFT, RIGHT)),
        (1, (-1.0, 0.0), (BOTTOM, TOP)),
    ):
        every = [np.concatenate(v, axis=-1) for v in (places, sources, faces)]
        for face, plane, other in ((names[0], low, high), (names[1], high, low)):
            repeats = is_periodic and axis == 0
            if not repeats and face not in mirrors:
                continue
            near = np.abs(every[0][axis] - (other if repeats else plane)) < RATIO * d
            ghost = every[0][:, near].copy()
            ghost[axis] = ghost[axis] + plane - other if repeats else 2.0 * plane - ghost[axis]
            places.append(ghost)
            sources.append(every[1][near])
            faces.append(np.full(ghost.shape[1], face))
    place, source, face = (np.concatenate(v, axis=-1) for v in (places, sources, faces))
    pairs = cKDTree(position.T).sparse_distance_matrix(
        cKDTree(place.T), RATIO * d, output_type="coo_matrix"
    )
    used = pairs.data > 1e-9 * d
    i, k, r = pairs.row[used].astype(np.int64), pairs.col[used], pairs.data[used]
    order = np.lexsort((k, i))
    i, k, r = i[order], k[order], r[order]
    shape = kernel("quintic-spline", 2)
    nodes = np.linspace(0.0, RATIO, 4001)
    slope = np.interp(r / d, nodes, [shape.derivative(s, RATIO) for s in nodes]) / d**3
    g = -2.0 * d**4 * slope / r / _second_moment(shape)
    return Scattered(
        position, d, (width if is_periodic else 0.0, 0.0), i, source[k], g, face[k], place[:, k]
    )


def _second_moment(shape):
    """sum_j g_ij x_ij^2 / (2 V) on an endless lattice; 1 would be exact."""
    steps = np.arange(-4, 5)
    r = np.hypot(*np.meshgrid(steps, steps)).ravel()
    r = r[(r > 0.0) & (r < RATIO)]
    slope = np.vectorize(shape.derivative, otypes=[float])(r, RATIO)
    return 0.5 * np.sum(-2.0 * slope / r * r * r) / 2.0
