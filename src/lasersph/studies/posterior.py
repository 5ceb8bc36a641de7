"""Posterior of unknowns from measured values: likelihood over emulators.

With d_j the measured values, s_j their standard errors, m_j and e_j mean and standard deviation of
the emulator and n_j the numerical standard deviation of the runs (cells),

    ln p(unknowns) = -1/2 sum_j [(d_j - m_j)^2 / v_j + ln v_j] - 1/2 sum_k (x_k - mu_k)^2 / t_k^2
    v_j = s_j^2 + e_j^2 + n_j^2

within the bounds, where mu_k +- t_k is what is known beforehand. Errors of different values count
as independent. Up to two unknowns p is summed over a grid, which is exact; with more it is sampled
by emcee [ForemanMackey2013].

[ForemanMackey2013] Foreman-Mackey et al., PASP 125, 306 (2013).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lasersph.output import OutputError
from lasersph.output.errors import install_hint
from lasersph.studies.calibration_plan import CalibrationPlan
from lasersph.studies.emulator import Emulator

Array = NDArray[np.float64]
GRID = {1: 1001, 2: 141}
"""Points along each unknown, of a first look and again of where the probability lies."""
FIRST_LOOK = 12.5
"""Drop of ln p that a second look leaves out: five standard deviations."""
WALKERS, STEPS, BURNT = 8, 1500, 500
"""emcee: walkers for each unknown, steps kept, steps before them; some 40 times the memory of a
chain of a few smooth unknowns."""
CHUNK = 4000
"""Points that an emulator is asked for at once, to bound memory."""


@dataclass(frozen=True)
class Model:
    """Emulators of all measured numbers, as functions of the unknowns.

    Attributes:
        emulators: by number of summaries. numerical: standard deviation by the cells, as well.
    """

    plan: CalibrationPlan
    emulators: Mapping[str, Emulator]
    numerical: Mapping[str, float]

    @cached_property
    def data(self) -> list[tuple[int, str]]:
        """Condition and number of each measured value, in the order of the plan."""
        found = enumerate(self.plan.conditions)
        return [(place, column) for place, one in found for column in one.values]

    @property
    def measured(self) -> tuple[Array, Array]:
        """Measured values and their standard errors (values,) each."""
        every = [self.plan.conditions[place].values[column] for place, column in self.data]
        return np.array([one.value for one in every]), np.array([one.sd for one in every])

    @property
    def numerical_sd(self) -> Array:
        """Numerical standard deviation (values,)."""
        return np.array([self.numerical[column] for _, column in self.data])

    def predict(self, unknowns: ArrayLike) -> tuple[Array, Array]:
        """Mean and standard deviation of the emulators (n, values) at unknowns (n, p)."""
        points = np.atleast_2d(np.asarray(unknowns, float))
        means, sds = np.empty((2, len(points), len(self.data)))
        for column, emulator in self.emulators.items():
            # values of this number in all measurements, each with its own settings
            places = [number for number, (_, name) in enumerate(self.data) if name == column]
            inputs = [
                self.plan.inputs(points, self.plan.conditions[self.data[number][0]])
                for number in places
            ]
            stacked = np.concatenate(inputs)  # one call: it costs more than its points
            parts = [
                emulator.predict(stacked[start : start + CHUNK])
                for start in range(0, len(stacked), CHUNK)
            ]
            mean, sd = (np.concatenate(one) for one in zip(*parts, strict=True))
            means[:, places] = mean.reshape(len(places), -1).T
            sds[:, places] = sd.reshape(len(places), -1).T
        return means, sds

    def log_probability(self, unknowns: Array, *, with_emulators_error: bool = True) -> Array:
        """ln p but for a constant (n,), -inf outside of the bounds."""
        mean, sd = self.predict(unknowns)
        value, error = self.measured
        # v_j, then the likelihood and what is known beforehand
        variance = error**2 + self.numerical_sd**2 + (sd**2 if with_emulators_error else 0.0)
        found = -0.5 * np.sum((value - mean) ** 2 / variance + np.log(variance), axis=1)
        for one, x in zip(self.plan.unknowns, unknowns.T, strict=True):
            if one.known is not None:
                found -= 0.5 * ((x - one.known.value) / one.known.sd) ** 2
            found[(x < one.low) | (x > one.high)] = -np.inf
        return found


@dataclass(frozen=True)
class Posterior:
    """Unknowns (n, p), weights (n,) of sum 1, and weights with perfect emulators."""

    unknowns: Array
    weights: Array
    weights_without_emulators: Array
    most_probable: Array

    @property
    def mean(self) -> Array:
        """(p,)."""
        return self.weights @ self.unknowns

    @property
    def covariance(self) -> Array:
        """(p, p)."""
        return covariance_of(self.unknowns, self.weights)

    @property
    def emulators_share(self) -> Array:
        """Part of the variance of each unknown that is due to the emulators (p,)."""
        without = covariance_of(self.unknowns, self.weights_without_emulators)
        return np.clip(1.0 - np.diag(without) / np.diag(self.covariance), 0.0, 1.0)

    def quantiles(self, values: Array, shares: ArrayLike) -> Array:
        """Quantiles of some values (n,) of the points."""
        # distribution at the middle of each point's weight
        order = np.argsort(values, kind="stable")
        cumulative = np.cumsum(self.weights[order]) - 0.5 * self.weights[order]
        return np.interp(np.asarray(shares), cumulative, values[order])

    def draw(self, count: int, seed: int) -> Array:
        """Points (count, p) drawn by their weights."""
        chosen = np.random.default_rng(seed).choice(len(self.weights), count, p=self.weights)
        return self.unknowns[chosen]


def covariance_of(points: Array, weights: Array) -> Array:
    """Covariance (p, p) of weighted points."""
    off = points - weights @ points
    return (weights[:, None] * off).T @ off


def find_posterior(model: Model, seed: int) -> Posterior:
    """The posterior of the unknowns; the same bits for the same runs.

    Raises:
        OutputError: emcee is needed and not installed.
    """
    low = np.array([one.low for one in model.plan.unknowns])
    high = np.array([one.high for one in model.plan.unknowns])
    if low.size in GRID:
        # first look over the bounds, second one where the probability lies
        points = _grid(low, high)
        density = model.log_probability(points)
        near = points[density > density.max() - FIRST_LOOK]
        cell = (high - low) / (GRID[low.size] - 1)
        points = _grid(np.maximum(near.min(0) - cell, low), np.minimum(near.max(0) + cell, high))
        density = model.log_probability(points)
        weights = _normalized(density)
    else:
        # points of a chain weigh the same
        points, density = _sampled(model, low, high, seed)
        weights = np.full(len(points), 1.0 / len(points))
    # the same points, weighted as if the emulators were exact
    perfect = model.log_probability(points, with_emulators_error=False)
    tilted = weights * np.exp(perfect - density - np.max(perfect - density))
    best = points[int(np.argmax(density))]
    return Posterior(points, weights, tilted / np.sum(tilted), best)


def _normalized(log_density: Array) -> Array:
    weights = np.exp(log_density - log_density.max())
    return weights / np.sum(weights)


def _grid(low: Array, high: Array) -> Array:
    """Points (n, p) of a grid between two corners."""
    axes = [np.linspace(a, b, GRID[low.size]) for a, b in zip(low, high, strict=True)]
    return np.column_stack([one.ravel() for one in np.meshgrid(*axes, indexing="ij")])


def _sampled(model: Model, low: Array, high: Array, seed: int) -> tuple[Array, Array]:
    """Points (n, p) of a chain that begins around the best of random points, and ln p."""
    try:
        import emcee  # pyright: ignore[reportMissingImports]
    except ImportError as error:
        raise OutputError(install_hint("emcee", "study")) from error
    rng = np.random.default_rng(seed)
    # walkers start at the best of random points, and forget that before steps are kept
    trials = low + rng.random((CHUNK, low.size)) * (high - low)
    walkers = WALKERS * low.size
    best = trials[np.argsort(-model.log_probability(trials), kind="stable")[:walkers]]
    state = emcee.State(best, random_state=np.random.RandomState(seed).get_state())
    sampler = emcee.EnsembleSampler(walkers, low.size, model.log_probability, vectorize=True)
    state = sampler.run_mcmc(state, BURNT)
    sampler.reset()
    sampler.run_mcmc(state, STEPS)
    return np.array(sampler.get_chain(flat=True)), np.array(sampler.get_log_prob(flat=True))
