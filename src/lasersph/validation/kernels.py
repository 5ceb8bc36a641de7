"""Conditions (32)-(38) of [Demuth2020] for every kernel and dimension, and skew-adjointness.

    (32) delta limit: |int W f dx - f(0)| falls with l^2       (36) monotonic: f' <= 0
    (33) positivity: f >= 0                                    (37) normalization: int W dx = 1
    (34) compact support: f = 0 from s = 1 on                  (38) smoothness: f'' continuous
    (35) spherical symmetry: W(x) = W(-x), by its form W(|x|)

and, for the gradient (46) and the divergence (47) with it on a disturbed lattice,

    sum_i V_i G+_i{p} . v_i = - sum_i V_i p_i D-_i{v}.
"""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import get_args

import numpy as np

from lasersph.compute.backend import Backend
from lasersph.particles.lattice import KernelName
from lasersph.plots import style
from lasersph.sph.divergence import divergence
from lasersph.sph.gradient import symmetric_gradient
from lasersph.sph.kernels import Kernel, kernel
from lasersph.validation.lattices import all_pairs, cubic_lattice
from lasersph.validation.report import Report
from lasersph.validation.runs import backend_of_loops
from lasersph.validation.verdict import Row, at_most, judged

TITLE = "Kernels: conditions (32)-(38) and skew-adjointness of gradient (46) and divergence (47)"
SOURCE = "Demuth & Lasagni 2020, eqs. (32)-(38)"
ADJOINT_SOURCE = "Demuth & Lasagni 2020, eqs. (46), (47); derivation"
BREAKS = (0.0, 1.0 / 3.0, 0.5, 2.0 / 3.0, 1.0)
SURFACE = {1: 2.0, 2: 2.0 * np.pi, 3: 4.0 * np.pi}
"""Measure of the unit sphere: an integral over space is that times int r^(d-1) dr."""
NAMES: tuple[KernelName, ...] = get_args(KernelName)


def run(out_dir: Path, *, quick: bool = False) -> Report:
    """Check all kernels; `quick` checks skew-adjointness with the quintic spline only."""
    backend = backend_of_loops()
    rows: list[Row] = []
    for name in NAMES:
        for dimension in (1, 2, 3):
            one = kernel(name, dimension)
            rows += conditions(one)
            if not quick or name == "quintic-spline":
                rows.append(
                    at_most(
                        f"{name} {dimension}-D: G+ and D- skew-adjoint", "1",
                        skew_defect(backend, one), 1e-12, source=ADJOINT_SOURCE,
                    )
                )  # fmt: skip
    remark = "Wendland C2 in 1-D is (1 - s)^3 (1 + 3 s), the member of its family for one dimension"
    return Report("kernels", TITLE, tuple(rows), (draw(out_dir),), (remark,), quick)


def conditions(one: Kernel) -> list[Row]:
    """Rows of (32)-(38) for a kernel."""
    s = np.linspace(0.0, 1.5, 3001)
    shape = np.array([one.shape(float(v)) for v in s])
    slope = np.array([one.slope(float(v)) for v in s])
    scale = shape[0]
    label = f"{one.name} {one.dimension}-D"
    steepest = float(np.max(np.abs(slope)))
    return [
        judged(f"{label}: (32) order of the delta limit", "1", delta_order(one), 2.0, 0.02,
               source=SOURCE),
        at_most(f"{label}: (33) most negative W / W(0)", "1",
                abs(min(shape.min(), 0.0)) / scale, 1e-15, source=SOURCE),
        at_most(f"{label}: (34) largest W / W(0) from s = 1 on", "1",
                float(np.max(np.abs(shape[s >= 1.0]))) / scale, 1e-15, source=SOURCE),
        at_most(f"{label}: (35) |W(x) - W(-x)| / W(0)", "1", asymmetry(one), 1e-15, source=SOURCE),
        at_most(f"{label}: (36) largest increase f' / max |f'|", "1",
                abs(max(slope.max(), 0.0)) / steepest, 1e-15, source=SOURCE),
        judged(f"{label}: (37) integral of W", "1", integral(one, lambda r: 1.0 + 0.0 * r, 1.0),
               1.0, 1e-13, source=SOURCE),
        at_most(f"{label}: (38) largest jump of f'' / max |f''|", "1", curvature_jump(one), 1e-4,
                source=SOURCE),
    ]  # fmt: skip


def integral(one: Kernel, function, support: float) -> float:
    """Integral over space of W times a function of r, by Gauss quadrature between the breaks."""
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

    return float(np.log2(error(0.1) / error(0.05)))


def asymmetry(one: Kernel) -> float:
    """Largest |W(x) - W(-x)| / W(0) over random points."""
    points = np.random.default_rng(1).uniform(-1.0, 1.0, (one.dimension, 200))
    forth = [one.value(float(r), 1.0) for r in np.sqrt(np.sum(points**2, axis=0))]
    back = [one.value(float(r), 1.0) for r in np.sqrt(np.sum((-points) ** 2, axis=0))]
    return float(np.max(np.abs(np.subtract(forth, back)))) / one.value(0.0, 1.0)


def curvature_jump(one: Kernel) -> float:
    """Largest jump of f'' at the breaks over the largest |f''|, by one-sided differences of f'."""
    step = 1e-6
    s = np.linspace(0.0, 1.0, 401)
    second = [(one.slope(float(v) + step) - one.slope(float(v))) / step for v in s]
    jumps = []
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
    position = cubic_lattice(one.dimension, {1: 200, 2: 20, 3: 9}[one.dimension])
    position += 0.3 * (random.random(position.shape) - 0.5)
    n = position.shape[1]
    neighbors = all_pairs(backend, position, one.support_ratio, one)
    m, rho, p = (random.random(n) + 0.5 for _ in range(3))
    v = random.random((one.dimension, n)) - 0.5
    fields = {"m": m, "rho": rho, "f": p, "v": v}
    arrays = {symbol: backend.asarray(values) for symbol, values in fields.items()}
    gradient, rate = backend.zeros((one.dimension, n)), backend.zeros(n)
    symmetric_gradient(backend, neighbors, arrays, gradient)
    divergence(backend, neighbors, arrays, rate)
    left = m / rho * np.sum(backend.to_host(gradient) * v, axis=0)
    right = m / rho * p * backend.to_host(rate)
    size = np.sum(np.abs(left)) + np.sum(np.abs(right))
    return float(abs(np.sum(left) + np.sum(right)) / size)


def draw(out_dir: Path) -> Path:
    """Kernels and their slopes over s, normalized in 2-D."""
    figure, axes = style.new_figure(1, 2, height=3.2)
    s = np.linspace(0.0, 1.1, 400)
    for name, color in zip(NAMES, style.COLORS, strict=False):
        one = kernel(name, 2)
        axes[0].plot(s, [one.sigma * one.shape(float(v)) for v in s], color=color, label=name)
        axes[1].plot(s, [one.sigma * one.slope(float(v)) for v in s], color=color, label=name)
    style.label(axes[0], "r / l [1]", "$l^2\\,W$ [1]", title="(a) kernel, 2-D")
    style.label(axes[1], "r / l [1]", "$l^3\\,dW/dr$ [1]", title="(b) slope, 2-D")
    style.legend(axes[0])
    return style.save(figure, out_dir / "kernels.png")
