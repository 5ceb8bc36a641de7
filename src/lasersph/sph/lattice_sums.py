"""Sums over the neighbors of a particle of a cubic lattice, in units of its spacing dx.

They tell how far a kernel on a lattice is from the continuum, and how fast its fastest modes decay:

    second_moment      sum_j V_j |dW| r / d                 1 where gradients of lines are exact;
                       its d-fold is the divergence of positions inside a body
    kernel_sum         sum_j V_j W                          1 less the part of the particle itself
    surface_threshold  mean of that divergence in the first and the second layer of a half space
    diffusive_rate     L = max over k of dx^2 sum_j 2 V_j |dW| / r (1 - cos(k . r_ij))
    viscous_rate       N = h dx sum_j V_j |dW| / r z^2 / (r^2 + s h^2) (1 - cos(pi z / dx))

N belongs to layers that alternate, L to values that alternate along as many axes as decay fastest;
s softens an artificial viscosity. Weights of conduction divided by the second moment conduct
exactly inside a body (0.98765 in 1-D, 1.01012 in 3-D for the cubic spline with h = 1.5 dx).
"""

from __future__ import annotations

from itertools import product

import numpy as np
from numpy.typing import NDArray

from lasersph.sph.kernels import Kernel

Array = NDArray[np.float64]


def lattice_neighbors(kernel: Kernel, ratio: float) -> tuple[Array, Array]:
    """Offsets (dim, k) of the neighbors in spacings, and |dW| dx^(d+1) of each (k,).

    Args:
        ratio: support radius over spacing.
    """
    offsets = range(-int(np.ceil(ratio)), int(np.ceil(ratio)) + 1)
    # all lattice points of a box around the support, then those within it
    offset = np.array(list(product(offsets, repeat=kernel.dimension)), float).T
    r = np.sqrt(np.sum(offset * offset, axis=0))
    is_near = (r > 0.0) & (r < ratio)
    offset, r = offset[:, is_near], r[is_near]
    return offset, np.array([-kernel.derivative(float(value), ratio) for value in r])


def second_moment(kernel: Kernel, ratio: float) -> float:
    """Second moment of the weights inside a body [1]."""
    offset, slope = lattice_neighbors(kernel, ratio)
    return float(np.sum(slope * _distance(offset))) / kernel.dimension


def kernel_sum(kernel: Kernel, ratio: float) -> float:
    """Sum of the kernel over the neighbors inside a body [1]."""
    offset, _ = lattice_neighbors(kernel, ratio)
    return sum(kernel.value(float(r), ratio) for r in _distance(offset))


def surface_threshold(kernel: Kernel, ratio: float) -> float:
    """Divergence of positions below which a particle lies in the top layer [1]."""
    offset, slope = lattice_neighbors(kernel, ratio)
    terms = slope * _distance(offset)
    # neighbors at or below a particle of the top layer, and with one layer above it
    first, second = (float(np.sum(terms[offset[-1] <= above])) for above in (0.0, 1.0))
    return 0.5 * (first + second)


def diffusive_rate(kernel: Kernel, ratio: float) -> float:
    """L: fastest rate of decay over D / dx^2 [1]."""
    offset, slope = lattice_neighbors(kernel, ratio)
    weight = 2.0 * slope / _distance(offset)
    # k alternates along the first 1, 2, ..., d axes: the fastest is one of them
    phases = np.pi * np.cumsum(offset, axis=0)
    return max(float(np.sum(weight * (1.0 - np.cos(phase)))) for phase in phases)


def viscous_rate(kernel: Kernel, ratio: float, softening: float) -> float:
    """N: rate at which alternating layers stop over alpha c_0 / dx [1], h half the support."""
    offset, slope = lattice_neighbors(kernel, ratio)
    r, z, h = _distance(offset), offset[-1], 0.5 * ratio
    share = z * z / (r * r + softening * h * h)
    return float(h * np.sum(slope / r * share * (1.0 - np.cos(np.pi * z))))


def _distance(offset: Array) -> Array:
    return np.sqrt(np.sum(offset * offset, axis=0))
