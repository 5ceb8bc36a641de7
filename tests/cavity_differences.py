"""Steady flow in a square cavity by finite differences, to hold tables and the flow solver against.

Stream function and vorticity at the nodes of an even grid, u = dpsi/dz, w = -dpsi/dx,

    laplace psi = -omega,    u domega/dx + w domega/dz = laplace omega / Re,

central differences of second order, Newton's method on both together. Three walls rest; the top
either moves (u = 1; Thom's vorticity) or is free under a given stress (omega = -du/dz).
"""

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu


class Cavity:
    """Unit square of `count` cells a side.

    Args:
        reynolds: 1/nu, of unit speed and side.
        shear: (count + 1,) du/dz at the nodes of the top; None: the top moves with u = 1.
    """

    def __init__(self, count, reynolds, shear=None):
        self.count, self.reynolds, self.shear = count, reynolds, shear
        self.node = np.arange((count + 1) ** 2).reshape(count + 1, count + 1)
        self.psi, self.omega = np.zeros((2, self.node.size))

    def solve(self, tolerance=1e-11):
        """Newton steps until psi changes by less than `tolerance`; returns self."""
        for _ in range(30):
            residual, jacobian = self._equations()
            change = splu(jacobian).solve(-residual)
            self.psi, self.omega = (
                old + part for old, part in zip((self.psi, self.omega), np.split(change, 2),
                                                strict=True)
            )  # fmt: skip
            if np.abs(change[: self.psi.size]).max() < tolerance:
                return self
        raise AssertionError("Newton's method does not converge")

    def velocity(self):
        """u, w at the nodes, (2, count + 1, count + 1), x along the first of the two."""
        h, psi = 1.0 / self.count, self.psi.reshape(self.node.shape)
        u, w = np.zeros((2, *self.node.shape))
        u[1:-1, 1:-1] = (psi[1:-1, 2:] - psi[1:-1, :-2]) / (2.0 * h)
        w[1:-1, 1:-1] = -(psi[2:, 1:-1] - psi[:-2, 1:-1]) / (2.0 * h)
        # one-sided, second order; psi is 0 along the top
        u[1:-1, -1] = (psi[1:-1, -3] - 4.0 * psi[1:-1, -2]) / (2.0 * h)
        if self.shear is None:
            u[:, -1] = 1.0
        return np.stack([u, w])

    def _equations(self):
        """Residual (2 n,) and Jacobian of psi's and omega's equations."""
        h, size, node = 1.0 / self.count, self.node.size, self.node
        psi, omega = self.psi, self.omega
        inner = node[1:-1, 1:-1].ravel()
        east, west, north, south = (node[i, j].ravel() for i, j in (
            (slice(2, None), slice(1, -1)), (slice(0, -2), slice(1, -1)),
            (slice(1, -1), slice(2, None)), (slice(1, -1), slice(0, -2))))  # fmt: skip
        around = (east, west, north, south)
        entries, residual = [], np.zeros(2 * size)

        def add(rows, columns, values):
            entries.append(np.broadcast_arrays(rows, columns, values))

        def laplace(values):
            return (sum(values[k] for k in around) - 4.0 * values[inner]) / h**2

        outer = np.setdiff1d(node, inner)
        residual[outer] = psi[outer]
        add(outer, outer, 1.0)
        residual[inner] = laplace(psi) + omega[inner]
        add(inner, size + inner, 1.0)
        add(inner, inner, -4.0 / h**2)
        u, w = (psi[north] - psi[south]) / (2.0 * h), -(psi[east] - psi[west]) / (2.0 * h)
        along_x = (omega[east] - omega[west]) / (2.0 * h)
        along_z = (omega[north] - omega[south]) / (2.0 * h)
        residual[size + inner] = u * along_x + w * along_z - laplace(omega) / self.reynolds
        add(size + inner, size + inner, 4.0 / h**2 / self.reynolds)
        for place, speed in ((east, u), (west, -u), (north, w), (south, -w)):
            add(inner, place, 1.0 / h**2)
            add(size + inner, size + place, speed / (2.0 * h) - 1.0 / h**2 / self.reynolds)
        for place, slope in ((north, along_x), (south, -along_x), (east, -along_z),
                             (west, along_z)):  # fmt: skip
            add(size + inner, place, slope / (2.0 * h))
        corners = node[[0, 0, -1, -1], [0, -1, 0, -1]]
        residual[size + corners] = omega[corners]
        add(size + corners, size + corners, 1.0)
        walls = [(node[0, 1:-1], node[1, 1:-1], 0.0), (node[-1, 1:-1], node[-2, 1:-1], 0.0),
                 (node[1:-1, 0], node[1:-1, 1], 0.0)]  # fmt: skip
        top = node[1:-1, -1]
        if self.shear is None:
            walls.append((top, node[1:-1, -2], 1.0))
        else:
            residual[size + top] = omega[top] + self.shear[1:-1]
            add(size + top, size + top, 1.0)
        for wall, next_to_it, speed in walls:
            residual[size + wall] = omega[wall] + 2.0 * psi[next_to_it] / h**2 + 2.0 * speed / h
            add(size + wall, size + wall, 1.0)
            add(size + wall, next_to_it, 2.0 / h**2)
        rows, columns, values = (np.concatenate(part) for part in zip(*entries, strict=True))
        return residual, csc_matrix((values, (rows, columns)), shape=(2 * size, 2 * size))


def extrapolated(fine, coarse):
    """Richardson value at the nodes of `coarse` from fields of order two, `fine` twice as fine."""
    return fine[..., ::2, ::2] + (fine[..., ::2, ::2] - coarse) / 3.0
