"""Conditions (32)-(38) of [Demuth2020] for every kernel and dimension, and skew-adjointness."""

from __future__ import annotations

from itertools import pairwise
from typing import get_args

import numpy as np

from lasersph.compute.backend import Backend
from lasersph.particles.lattice import KernelName
from lasersph.sph.divergence import divergence
from lasersph.sph.gradient import symmetric_gradient
from lasersph.sph.kernels import Kernel, kernel
from lasersph.validation.drawing import Panel, line
from lasersph.validation.lattices import all_pairs, cubic_lattice
from lasersph.validation.study import Study

BREAKS = (0.0, 1.0 / 3.0, 0.5, 2.0 / 3.0, 1.0)
"""Places over the support where the piecewise polynomials of the splines meet."""
SURFACE = {1: 2.0, 2: 2.0 * np.pi, 3: 4.0 * np.pi}
"""Measure of the unit sphere: an integral over space is that times int r^(d-1) dr."""
NAMES: tuple[KernelName, ...] = get_args(KernelName)


def compare(study: Study) -> None:
    """Judge all kernels in all dimensions."""
    for name in NAMES:
        for dimension in (1, 2, 3):
            one = kernel(name, dimension)
            add_conditions(study, one)
            if not study.plan.skew or name in study.plan.skew:
                study.add("skew", skew_defect(study.backend, one), label=label_of(one))
    draw(study)


def label_of(one: Kernel) -> str:
    """Name and dimension."""
    return f"{one.name} {one.dimension}-D"


def add_conditions(study: Study, one: Kernel) -> None:
    """Rows of (32)-(38) for a kernel."""
    # The shape and its slope, beyond the support as well.
    s = np.linspace(0.0, 1.5, 3001)
    shape = np.array([one.shape(float(v)) for v in s])
    slope = np.array([one.slope(float(v)) for v in s])
    outside, steepest = np.abs(shape[s >= 1.0]), np.max(np.abs(slope))
    # Conditions (32) to (38), each as a number that is 0 where it holds.
    found = {
        "delta": delta_order(one),
        "positive": abs(min(shape.min(), 0.0)) / shape[0],
        "compact": np.max(outside) / shape[0],
        "symmetric": asymmetry(one),
        "monotonic": abs(max(slope.max(), 0.0)) / steepest,
        "normal": integral(one, lambda r: 1.0 + 0.0 * r, 1.0),
        "smooth": curvature_jump(one),
    }
    for condition, value in found.items():
        study.add(condition, value, label=label_of(one))


def integral(one: Kernel, function, support: float) -> float:
    """Integral over space of W times a function of r, by Gauss quadrature between the breaks."""
    # Gauss quadrature between the breaks, where the kernel is a polynomial.
    points, weights = np.polynomial.legendre.leggauss(20)
    total = 0.0
    for low, high in pairwise(BREAKS):
        s = 0.5 * (low + high) + 0.5 * (high - low) * points
        r = s * support
        value = np.array([one.value(float(x), support) for x in r])
        measure = SURFACE[one.dimension] * r ** (one.dimension - 1) * support
        total += 0.5 * (high - low) * float(np.sum(weights * value * function(r) * measure))
    return total


def delta_order(one: Kernel) -> float:
    """Power of l with which int W exp(-r^2) dx goes to 1, between l = 0.1 and 0.05."""

    def error(support: float) -> float:
        return abs(integral(one, lambda r: np.expm1(-(r**2)), support))

    # Power of 2 by which the error falls when l is halved.
    return float(np.log2(error(0.1) / error(0.05)))


def asymmetry(one: Kernel) -> float:
    """Largest |W(x) - W(-x)| / W(0) over random points."""
    points = np.random.default_rng(1).uniform(-1.0, 1.0, (one.dimension, 200))
    # The kernel depends on r alone: at x and -x it must be the same.
    forth = [one.value(float(r), 1.0) for r in np.sqrt(np.sum(points**2, axis=0))]
    back = [one.value(float(r), 1.0) for r in np.sqrt(np.sum((-points) ** 2, axis=0))]
    return float(np.max(np.abs(np.subtract(forth, back)))) / one.value(0.0, 1.0)


def curvature_jump(one: Kernel) -> float:
    """Largest jump of f'' at the breaks over the largest |f''|, by one-sided differences of f'."""
    step = 1e-6
    s = np.linspace(0.0, 1.0, 401)
    second = [(one.slope(float(v) + step) - one.slope(float(v))) / step for v in s]
    jumps = []
    # One-sided differences of f' on both sides of each break.
    for at in BREAKS[1:]:
        right = (one.slope(at + step) - one.slope(at)) / step
        left = (one.slope(at) - one.slope(at - step)) / step
        jumps.append(abs(right - left))
    # f is even in r, so at the origin f' must vanish
    jumps.append(abs(one.slope(0.0)) / step)
    return float(max(jumps) / np.max(np.abs(second)))


def skew_defect(backend: Backend, one: Kernel) -> float:
    """|sum V G+ . v + sum V p D-| over the sum of its terms' sizes."""
    random = np.random.default_rng(one.dimension)
    # A lattice with particles out of place, so that nothing cancels by symmetry.
    position = cubic_lattice(one.dimension, {1: 200, 2: 20, 3: 9}[one.dimension])
    position += 0.3 * (random.random(position.shape) - 0.5)
    n = position.shape[1]
    neighbors = all_pairs(backend, position, one.support_ratio, one)
    # Random fields.
    m, rho, p = (random.random(n) + 0.5 for _ in range(3))
    v = random.random((one.dimension, n)) - 0.5
    fields = {"m": m, "rho": rho, "f": p, "v": v}
    arrays = {symbol: backend.asarray(values) for symbol, values in fields.items()}
    gradient, rate = backend.zeros((one.dimension, n)), backend.zeros(n)
    # sum V G+ . v = -sum V p D-: gradient and divergence are skew-adjoint.
    symmetric_gradient(backend, neighbors, arrays, gradient)
    divergence(backend, neighbors, arrays, rate)
    left = m / rho * np.sum(backend.to_host(gradient) * v, axis=0)
    right = m / rho * p * backend.to_host(rate)
    size = np.sum(np.abs(left)) + np.sum(np.abs(right))
    return float(abs(np.sum(left) + np.sum(right)) / size)


def draw(study: Study) -> None:
    """Kernels and their slopes over s, normalized in 2-D."""
    s = np.linspace(0.0, 1.1, 400)
    shapes, slopes = [], []
    for k, name in enumerate(NAMES):
        one = kernel(name, 2)
        shapes.append(line(s, [one.sigma * one.shape(float(v)) for v in s], name, k))
        slopes.append(line(s, [one.sigma * one.slope(float(v)) for v in s], k=k))
    study.draw(
        "kernels",
        Panel("r / l [1]", "$l^2\\,W$ [1]", shapes, "(a) kernel, 2-D"),
        Panel("r / l [1]", "$l^3\\,dW/dr$ [1]", slopes, "(b) slope, 2-D"),
        height=3.2,
    )
