"""Which keys of a case a number depends on: Sobol indices of an emulator, screening by Morris.

With keys that vary independently, each evenly over its range (or evenly in its logarithm), the
variance of a number y splits into parts [Sobol2001]:

    first order  S_k = V[E(y | x_k)] / V[y]          what key k does alone
    total        T_k = 1 - V[E(y | all but x_k)] / V[y]     what it does with all others too

Three things make an index u uncertain: what the runs do not tell about y, which functions drawn
from the emulator show; the points at which they are asked, which differ from batch to batch of
draws [LeGratiet2014]; and which runs were made. For the last the emulator is fitted K times anew,
each time without one of K groups of runs, giving u_j: the jackknife [Quenouille1956]

    u_unc^2 = V[drawn u] + (K - 1)/K sum of (u_j - mean)^2 + [(K - 1)(mean - u)]^2

whose last part is the bias of an emulator that has seen few runs: functions between them are
rougher than the true one, so that totals come out too large. The intervals, u +- 2 u_unc, are
rather wide than narrow: they held 144 of 144 indices of known functions
(`benchmarks/sobol_intervals.py`).

Screening needs no emulator: elementary effects, differences of y between runs that differ in one
key, over the share of the key's range between them [Morris1991]. mu* is the mean of their sizes
[Campolongo2007], sigma their standard deviation, large where the key interacts or bends.

[Campolongo2007] Campolongo, Cariboni, Saltelli, Environ. Model. Softw. 22, 1509 (2007).
[LeGratiet2014] Le Gratiet, Cannamela, Iooss, SIAM/ASA J. Uncertain. Quantif. 2, 336 (2014).
[Morris1991] Morris, Technometrics 33, 161 (1991).
[Quenouille1956] Quenouille, Biometrika 43, 353 (1956).
[Sobol2001] Sobol, Math. Comput. Simul. 55, 271 (2001).
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from os import PathLike

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lasersph.studies.emulator import Box, Emulator, fit_emulator
from lasersph.studies.sweep_numbers import box_of_runs, numerical_deviation, sizes_of
from lasersph.sweeps import Table
from lasersph.sweeps.folder import PLAN

Array = NDArray[np.float64]
POINTS = 1024
"""Of one batch, each asked keys + 2 times; a power of two, as Sobol sequences want."""
BATCHES, DRAWS = 8, 16
"""Batches of points, and functions drawn for each: 128 indices, their scatter known to 6 %."""
GROUPS = 8
"""K, groups of runs that are left out in turn."""
COVERAGE = 2.0
"""Standard uncertainties to each side that hold about 95 % of a normal distribution."""
BLOCK = 4096
"""Points at which functions are asked at once, so that their waves fit into 200 MB."""


@dataclass(frozen=True, eq=False)
class SobolIndices:
    """First-order and total indices (keys,), each with the half-width of an interval that holds
    about 95 %."""

    first: Array
    first_error: Array
    total: Array
    total_error: Array


def sobol_indices(emulator: Emulator, *, seed: int = 1) -> SobolIndices:
    """First-order and total Sobol indices of the emulated number over the box of its keys.

    The keys are taken as independent and evenly spread, wherever the runs are. A small index may
    come out slightly negative.

    Raises:
        ValueError: a single key, or too few runs to leave some out.
    """
    count, keys = emulator.inputs.shape
    if keys < 2:
        raise ValueError("a single key varies: there is nothing to compare it with")
    # indices of drawn functions: what the runs leave open, and the points
    drawn = np.hstack(
        [
            _indices(emulator, emulator.draw(DRAWS, seed=seed + batch), [seed, batch])
            for batch in range(BATCHES)
        ]
    )

    # jackknife over groups of runs
    group = np.random.default_rng(seed).permutation(count) % min(GROUPS, count)
    whole = _indices(emulator, lambda x: emulator.predict(x)[0][None], [seed])[:, 0]
    parts = []
    for one in range(group.max() + 1):
        reduced = emulator.without(group == one)
        parts.append(_indices(reduced, lambda x, r=reduced: r.predict(x)[0][None], [seed])[:, 0])
    left = np.array(parts)

    # variances of the draws and of the jackknife, and its bias
    fold = len(left) - 1
    bias = fold * (left.mean(axis=0) - whole)
    variance = drawn.var(axis=1) + fold * left.var(axis=0) + bias**2
    value, error = drawn.mean(axis=1), COVERAGE * np.sqrt(variance)
    first, total = (value[0], error[0]), (value[1], error[1])
    return SobolIndices(*first, *total)


def _indices(emulator: Emulator, functions: Callable[[Array], Array], seed: Sequence[int]) -> Array:
    """First-order and total indices (2, count, keys) of functions from points (m, keys) in SI to
    values (count, m)."""
    from scipy import stats  # takes half a second to load

    def values(x: Array) -> Array:
        points = emulator.box.restored(x.T)
        return np.hstack([functions(b) for b in np.array_split(points, -(-len(points) // BLOCK))])

    keys = [stats.uniform()] * emulator.inputs.shape[1]
    rng = np.random.default_rng(seed)
    found = stats.sobol_indices(func=values, n=POINTS, dists=keys, rng=rng)
    return np.array([np.atleast_2d(found.first_order), np.atleast_2d(found.total_order)])


@dataclass(frozen=True, eq=False)
class Screening:
    """mu* and sigma of each key (keys,), in units of the number over the range of the key, and how
    many elementary effects they come from."""

    mean_size: Array
    deviation: Array
    count: NDArray[np.int_]


def screen(inputs: ArrayLike, outputs: ArrayLike, box: Box) -> Screening:
    """mu* and sigma of each key from runs in the order of their trajectories.

    An effect is taken between every two runs that follow each other and differ in one key; runs
    that failed, with outputs that are not finite, only lose their effects.

    Args:
        inputs: keys (n, keys) in SI. outputs: (n,). box: ranges of the keys.

    Raises:
        ValueError: a key has fewer than two effects, so that its sigma is unknown.
    """
    x, y = box.scaled(inputs), np.asarray(outputs, float)
    steps, rises = np.diff(x, axis=0), np.diff(y)
    # steps in which one key alone has moved
    is_moved = np.abs(steps) > 1e-9  # rounding of scaled keys
    usable = (is_moved.sum(axis=1) == 1) & np.isfinite(rises)
    sizes, deviations, counts = [], [], []
    for key in range(x.shape[1]):
        chosen = usable & is_moved[:, key]
        # elementary effects of the key; mu* is the mean of their sizes
        effects = rises[chosen] / steps[chosen, key]
        if effects.size < 2:
            raise ValueError(
                f"key {key + 1} has {effects.size} elementary effects; two or more are needed"
            )
        sizes.append(np.mean(np.abs(effects)))
        deviations.append(np.std(effects, ddof=1))
        counts.append(effects.size)
    return Screening(np.array(sizes), np.array(deviations), np.array(counts))


@dataclass(frozen=True, eq=False)
class Sensitivity:
    """Influence of the keys of a sweep on a number.

    Attributes:
        column: the number. keys: what varies. runs: how many have the number.
        sobol: indices, and predictivity: how well an emulator knows the number; of a screening
            both are None. screening: elementary effects of a sweep of kind "morris".
    """

    column: str
    keys: tuple[str, ...]
    runs: int
    sobol: SobolIndices | None = None
    predictivity: float | None = None
    screening: Screening | None = None


def assess_sensitivity(
    runs: Table | str | PathLike[str], of: str = "melt.depth_half_max_m", *, seed: int = 1
) -> Sensitivity:
    """How much each key of a sweep changes a number, over the ranges of the runs.

    By screening if the sweep was sampled for it, else by Sobol indices.

        found = lasersph.sensitivity("runs/sweep", of="flow.speed_max_m_s")
        dict(zip(found.keys, found.sobol.total))

    Args:
        runs: the table of a sweep, or its folder. of: a number of the summaries.

    Raises:
        ValueError: too few runs with the number. KeyError: no run has it.
        OutputError: no sweep there; scikit-learn is missing.
    """
    table = runs if isinstance(runs, Table) else Table.read(runs)
    values = sizes_of(table, of)
    points = np.stack([table.values(key) for key in table.varied], axis=1)
    good = np.isfinite(values)
    if not np.any(good):
        raise ValueError(f"no run has {of} yet")
    found = Sensitivity(of, table.varied, int(good.sum()))
    box = box_of_runs(points)
    # walks of a screening have their effects; other runs are emulated
    if _is_screening(table):
        return replace(found, screening=screen(points, values, box))
    noise = numerical_deviation(table, of)
    emulator = fit_emulator(points[good], values[good], box=box, noise=noise, seed=seed)
    indices = sobol_indices(emulator, seed=seed)
    return replace(found, sobol=indices, predictivity=emulator.predictivity)


def _is_screening(table: Table) -> bool:
    """Whether the plan of a sweep sampled walks for screening."""
    plan = table.path / PLAN
    if not plan.exists():
        return False
    content = tomllib.loads(plan.read_text(encoding="utf-8"))
    return content.get("sampling", {}).get("kind") == "morris"
