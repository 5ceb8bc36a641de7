"""Sobol indices of known functions from some runs: how often their intervals hold the exact ones.

    python benchmarks/sobol_intervals.py [--seeds 6]

Functions: Ishigami's over -pi..pi, whose indices are known in closed form, and the depth that a
pulse melts by its balance of energy (`analytic.half_space.ablated_depth`), whose indices come from
Gauss quadrature. Each seed is another Sobol sequence of runs.
"""

from __future__ import annotations

import argparse
import time

import numpy as np
from scipy.stats import qmc

from lasersph.analytic.half_space import ablated_depth
from lasersph.studies import box_of, fit_emulator
from lasersph.studies.sensitivity import sobol_indices


def ishigami(x):
    """sin x_1 + 7 sin^2 x_2 + 0.1 x_3^4 sin x_1 over -pi..pi (Ishigami and Homma 1990)."""
    return np.sin(x[:, 0]) + 7.0 * np.sin(x[:, 1]) ** 2 + 0.1 * x[:, 2] ** 4 * np.sin(x[:, 0])


def ishigami_indices():
    """Closed form: V = a^2/8 + b pi^4/5 + b^2 pi^8/18 + 1/2 with a = 7, b = 0.1."""
    a, b = 7.0, 0.1
    first = 0.5 * (1.0 + b * np.pi**4 / 5.0) ** 2
    second, both = a**2 / 8.0, b**2 * np.pi**8 * (1.0 / 18.0 - 1.0 / 50.0)
    whole = first + second + both
    return (
        np.array([first, second, 0.0]) / whole,
        np.array([first + both, second, both]) / whole,
    )


CUBE = box_of([-np.pi] * 3, [np.pi] * 3)
KEYS = box_of((2e3, 2e-9, 0.3), (1e4, 50e-9, 0.5), (False, True, False))
"""Fluence [J/m^2], duration [s], absorptivity."""


def melt_depth(points):
    """Depth [m] that a pulse melts by its balance of energy; zero below the threshold."""
    return np.array(
        [
            ablated_depth(
                share * fluence,
                duration,
                density=7900.0,
                heat_capacity=500.0,
                diffusivity=4e-6,
                rise=1400.0,
                latent_heat=2.6e5,
            )
            for fluence, duration, share in np.atleast_2d(points)
        ]
    )


def exact_indices(function, box, order=40):
    """First-order and total indices of a function of three keys by Gauss quadrature."""
    node, weight = np.polynomial.legendre.leggauss(order)
    node, weight = 0.5 * (node + 1.0), 0.5 * weight
    grid = np.stack(np.meshgrid(node, node, node, indexing="ij"), axis=-1).reshape(-1, 3)
    y = function(box.restored(grid)).reshape((order,) * 3)

    def mean_over(values, axes):
        for axis in sorted(axes, reverse=True):
            values = np.tensordot(values, weight, axes=(axis, 0))
        return values

    mean = mean_over(y, (0, 1, 2))
    variance = mean_over(y**2, (0, 1, 2)) - mean**2
    others = [tuple(j for j in range(3) if j != k) for k in range(3)]
    first = [weight @ mean_over(y, others[k]) ** 2 - mean**2 for k in range(3)]
    total = []
    for k in range(3):
        left = mean_over(y, (k,))
        total.append(variance - (weight @ left**2 @ weight - mean**2))
    return np.array(first) / variance, np.array(total) / variance


def points_in(box, count, seed):
    """Points of a Sobol sequence."""
    return box.restored(qmc.Sobol(box.low.size, rng=seed).random(count))


def tell(name: str, function, box, exact, counts: tuple[int, ...], seeds: int) -> None:
    """Print of each number of runs the share held, the mean error and the mean half-width."""
    for count in counts:
        began, errors, widths = time.process_time(), [], []
        for seed in range(seeds):
            x = points_in(box, count, seed)
            found = sobol_indices(fit_emulator(x, function(x), box=box))
            errors.append(np.abs([found.first - exact[0], found.total - exact[1]]))
            widths.append([found.first_error, found.total_error])
        held = 100.0 * np.mean(np.array(errors) <= np.array(widths))
        each = (time.process_time() - began) / seeds
        share = f"{held:.0f} % of {np.size(errors)} indices in their intervals"
        sizes = f"mean error {np.mean(errors):.3f}, half-width {np.mean(widths):.3f}"
        print(f"{name}, {count} runs: {share}, {sizes}, {each:.1f} s each", flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=6)
    seeds = parser.parse_args().seeds
    tell("Ishigami", ishigami, CUBE, ishigami_indices(), (64, 128, 256), seeds)
    tell("melt depth", melt_depth, KEYS, exact_indices(melt_depth, KEYS), (16, 32, 64), seeds)
