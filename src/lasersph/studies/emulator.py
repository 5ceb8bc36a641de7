"""Emulator of a run: a Gaussian process over keys of the case, fitted to some tens of runs.

One number y of the summary is a random function of the keys x, each scaled to 0..1 over its range,
logarithmically where asked [Rasmussen2006, eqs. 2.22-2.24, 4.17]:

    y(x) = mean + s g(x) + noise,   cov[g(x), g(x')] = v (1 + r + r^2/3) exp(-r)
    r^2 = 5 sum of (x_k - x'_k)^2 / l_k^2

s is the standard deviation of the runs; v, the lengths l_k and the noise maximize the likelihood of
the runs, by scikit-learn. This covariance, of functions that bend but have no kinks, is surer of
itself than it should be less often than the smooth exp(-r^2/2). Neighboring runs differ by whole
cells as well as by their keys: the noise is never smaller than that numerical standard deviation.

[Rasmussen2006] Rasmussen, Williams, Gaussian Processes for Machine Learning, MIT Press (2006).
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import cho_solve, solve_triangular
from scipy.spatial import Delaunay
from scipy.spatial.distance import cdist

from lasersph.output import OutputError
from lasersph.output.errors import install_hint

Array = NDArray[np.float64]
VARIANCES = (1e-2, 1e3)
"""Bounds of v: a process within the scatter of its runs, and one that they barely show."""
LENGTHS = (0.05, 50.0)
"""Bounds of l_k: twenty waves across the range of a key, and a key that hardly matters."""
NOISES = (1e-8, 0.1)
"""Bounds of the fitted variance of the noise over that of the runs; above, nothing is emulated."""
LEAST_NOISE = 1e-5
"""Standard deviation of the noise over that of the runs that keeps the matrix definite."""
RESTARTS = 3
"""Starts of the maximization beside the first; more change no emulator of the tests."""
FEATURES = 512
"""Waves of a drawn function; its covariance errs by about their number to the power -1/2."""
MOST_HULL_KEYS = 4
"""Keys up to which the hull of the runs is triangulated; its simplices grow as n^(keys/2)."""


@dataclass(frozen=True)
class Box:
    """Ranges of the keys: low, high (keys,) in SI, and which of them count logarithmically."""

    low: Array
    high: Array
    logarithmic: NDArray[np.bool_]

    def scaled(self, points: ArrayLike) -> Array:
        """Points (n, keys) in SI with each key from 0 at its low end to 1 at its high end.

        Raises:
            ValueError: a point is zero or negative in a key that counts logarithmically.
        """
        x = np.atleast_2d(np.asarray(points, float))
        if np.any(x[:, self.logarithmic] <= 0.0):
            raise ValueError("a key that counts logarithmically must be positive")
        low, high = self._bent(self.low), self._bent(self.high)
        return (self._bent(x) - low) / (high - low)

    def restored(self, scaled: ArrayLike) -> Array:
        """Points in SI of scaled ones."""
        low, high = self._bent(self.low), self._bent(self.high)
        bent = low + np.asarray(scaled, float) * (high - low)
        bent[..., self.logarithmic] = np.exp(bent[..., self.logarithmic])
        return bent

    def _bent(self, values: Array) -> Array:
        """Values with the logarithm of those keys that count logarithmically."""
        bent = np.array(values, float)
        bent[..., self.logarithmic] = np.log(bent[..., self.logarithmic])
        return bent


def box_of(low: ArrayLike, high: ArrayLike, logarithmic: ArrayLike | None = None) -> Box:
    """The box between two corners (keys,) in SI.

    Raises:
        ValueError: a range is empty, or a logarithmic one reaches zero.
    """
    low, high = np.atleast_1d(np.asarray(low, float)), np.atleast_1d(np.asarray(high, float))
    bent = np.zeros(low.size, bool) if logarithmic is None else np.asarray(logarithmic, bool)
    if not low.shape == high.shape == bent.shape:
        raise ValueError("low, high and logarithmic need one entry for each key")
    if not np.all(high > low):
        raise ValueError("each key needs a range: high above low")
    if np.any(low[bent] <= 0.0):
        raise ValueError("the range of a key that counts logarithmically must be positive")
    return Box(low, high, bent)


def fit_emulator(
    inputs: ArrayLike,
    outputs: ArrayLike,
    *,
    box: Box | None = None,
    noise: ArrayLike = 0.0,
    seed: int = 1,
) -> Emulator:
    """The Gaussian process through some runs; the same bits for the same arguments.

    Args:
        inputs: keys of the runs (n, keys) in SI. outputs: one number of each run (n,).
        box: ranges that the keys are scaled to; default: those of the inputs, linear.
        noise: numerical standard deviation of the outputs, one for all or (n,).
        seed: of the starts of the maximization.

    Raises:
        ValueError: fewer runs than keys + 2, a value that is not finite, all outputs equal, arrays
            that do not fit.
        OutputError: scikit-learn is not installed.
    """
    # refuse what determines no process
    x, y = np.atleast_2d(np.asarray(inputs, float)), np.asarray(outputs, float)
    if y.ndim != 1 or x.shape[0] != y.size:
        raise ValueError(f"{x.shape[0]} runs have {y.size} outputs; one each is needed")
    if y.size < x.shape[1] + 2:
        raise ValueError(
            f"{y.size} runs over {x.shape[1]} keys are too few: an emulator needs {x.shape[1] + 2}"
        )
    if not (np.all(np.isfinite(x)) and np.all(np.isfinite(y))):
        raise ValueError("inputs and outputs must be finite; leave out runs without a result")
    scale = float(np.std(y))
    if scale <= 1e-12 * float(np.max(np.abs(y))):
        raise ValueError(f"all {y.size} runs give {y[0]:.6g}: there is nothing to emulate")
    box = box or box_of(x.min(axis=0), x.max(axis=0))

    # keys to 0..1, outputs to mean 0 and deviation 1, then the likeliest kernel
    scaled, offset = box.scaled(x), float(np.mean(y))
    floor = np.maximum(np.broadcast_to(np.asarray(noise, float), y.shape) / scale, LEAST_NOISE) ** 2
    fit = _likeliest(scaled, (y - offset) / scale, floor, seed)
    return Emulator(box, scaled, y, offset, scale, floor, *fit)


@dataclass(frozen=True, eq=False)
class Emulator:
    """A fitted process: call `predict` for its mean and standard deviation at new points.

    Attributes:
        box: ranges of the keys. inputs: scaled keys of the runs (n, keys). outputs: (n,).
        offset, scale: mean and standard deviation of the outputs.
        floor, noise: variance of the noise of each run over scale^2, as given and as fitted (n,).
        variance: v. lengths: l_k (keys,), over how much of its range a key must change to change
            the number.
    """

    box: Box
    inputs: Array
    outputs: Array
    offset: float
    scale: float
    floor: Array
    noise: Array
    variance: float
    lengths: Array

    @cached_property
    def _factor(self) -> Array:
        """Lower Cholesky factor of the covariance of the runs, over scale^2."""
        covariance = self._covariance(self.inputs) + np.diag(self.noise)
        return np.asarray(np.linalg.cholesky(covariance), dtype=np.float64)

    def _covariance(self, x: Array) -> Array:
        """cov[g] of scaled points (m, keys) with the runs, (m, n)."""
        # the kernel above, with r^2 = 5 sum of (x_k - x'_k)^2 / l_k^2
        r = np.sqrt(5.0) * cdist(x / self.lengths, self.inputs / self.lengths)
        return np.asarray(self.variance * (1.0 + r + r**2 / 3.0) * np.exp(-r), dtype=np.float64)

    @cached_property
    def _weights(self) -> Array:
        return cho_solve((self._factor, True), (self.outputs - self.offset) / self.scale)

    def predict(self, points: ArrayLike) -> tuple[Array, Array]:
        """Mean and standard deviation at points (m, keys) in SI, each (m,).

        The standard deviation is that of the smooth function, without the noise of a single run
        [Rasmussen2006, eqs. 2.25, 2.26].
        """
        x = self.box.scaled(points)
        # (2.25) mean = k* . K^-1 y; (2.26) variance = k(x, x) - |L^-1 k*|^2
        across = self._covariance(x)
        explained = solve_triangular(self._factor, across.T, lower=True)
        variance = self.variance - np.sum(explained**2, axis=0)
        mean = self.offset + self.scale * (across @ self._weights)
        return mean, self.scale * np.sqrt(np.maximum(variance, 0.0))

    def leave_one_out(self) -> tuple[Array, Array]:
        """Each run's output less what the other runs predict there, and the standard deviation of
        that prediction with the noise of the run, (n,) each; closed form
        [Rasmussen2006, eqs. 5.10-5.12], mean, scale and kernel as fitted to all runs."""
        # (5.10)-(5.12): from the diagonal of K^-1
        inverse = cho_solve((self._factor, True), np.eye(self.outputs.size))
        variance = 1.0 / np.diag(inverse)
        return self.scale * self._weights * variance, self.scale * np.sqrt(variance)

    @property
    def predictivity(self) -> float:
        """Share of the outputs' variance that the other runs predict: 1 less the mean square of the
        leave-one-out errors over the variance; 1 is perfect, 0 no better than the mean."""
        return 1.0 - float(np.mean(self.leave_one_out()[0] ** 2)) / self.scale**2

    def without(self, left_out: NDArray[np.bool_]) -> Emulator:
        """The emulator of the other runs: its covariance fitted anew from the present one.

        Raises:
            ValueError: fewer runs than keys + 2 are left.
        """
        x, y, floor = self.inputs[~left_out], self.outputs[~left_out], self.floor[~left_out]
        if y.size < x.shape[1] + 2:
            raise ValueError(f"{y.size} runs over {x.shape[1]} keys are too few")
        scaled = (y - self.offset) / self.scale
        noise, variance, lengths = _likeliest(x, scaled, floor, 1, (self.variance, self.lengths))
        return replace(
            self, inputs=x, outputs=y, floor=floor, noise=noise, variance=variance, lengths=lengths
        )

    def is_inside(self, points: ArrayLike) -> NDArray[np.bool_]:
        """Whether points (m, keys) in SI lie in the convex hull of the runs, to rounding; with more
        than four keys in the smallest box around the runs. Outside, a mean is an extrapolation.

        Raises:
            ValueError: the runs lie on a line or a plane of their keys, which has no inside.
        """
        x, rounding = self.box.scaled(points), 1e-9
        if x.shape[1] == 1 or x.shape[1] > MOST_HULL_KEYS:
            low, high = self.inputs.min(axis=0) - rounding, self.inputs.max(axis=0) + rounding
            return np.all((x >= low) & (x <= high), axis=1)
        # runs on a plane of their keys have no simplices
        if np.linalg.matrix_rank(self.inputs - self.inputs[0], tol=1e-6) < x.shape[1]:
            raise ValueError("the runs vary their keys together, so that they have no inside")
        return Delaunay(self.inputs).find_simplex(x, tol=rounding) >= 0

    def draw(self, count: int, *, seed: int = 1) -> Callable[[ArrayLike], Array]:
        """Functions drawn from the process as the runs leave it: points (m, keys) to (count, m).

        A draw is a sum of random waves, with frequencies of the kernel's spectrum (Student's t with
        five degrees of freedom, over l_k) [Rasmussen2006, eqs. 4.5, 4.15], moved through the runs
        [Wilson2020, eq. 11].

        [Wilson2020] Wilson et al., Efficiently sampling functions from Gaussian process posteriors,
        ICML (2020), arXiv:2002.09309.
        """
        # frequencies of the kernel, each with a cosine and a sine of random weights
        rng = np.random.default_rng(seed)
        student = np.sqrt(5.0 / rng.chisquare(5.0, (FEATURES, 1)))
        waves = student * rng.standard_normal((FEATURES, self.lengths.size)) / self.lengths
        weights = rng.standard_normal((2 * FEATURES, count)) * np.sqrt(self.variance / FEATURES)

        def prior(scaled: Array) -> Array:
            phase = scaled @ waves.T
            return np.hstack([np.cos(phase), np.sin(phase)]) @ weights

        # [Wilson2020, eq. 11]: moved by what the waves miss at the runs, with a noise of their own
        noise = np.sqrt(self.noise)[:, None] * rng.standard_normal((self.outputs.size, count))
        missing = ((self.outputs - self.offset) / self.scale)[:, None] - prior(self.inputs) - noise
        moves = cho_solve((self._factor, True), missing)

        def functions(points: ArrayLike) -> Array:
            x = self.box.scaled(points)
            values = prior(x) + self._covariance(x) @ moves
            return self.offset + self.scale * values.T

        return functions


def _likeliest(
    x: Array, y: Array, floor: Array, seed: int, start: tuple[float, Array] | None = None
) -> tuple[Array, float, Array]:
    """Variance of the noise (n,) above its floor (n,), v and l_k, all of largest likelihood.

    With v and l_k to `start` from, only the nearest maximum is looked for.
    """
    try:
        from sklearn.exceptions import ConvergenceWarning
        from sklearn.gaussian_process import GaussianProcessRegressor
        from sklearn.gaussian_process.kernels import ConstantKernel, Matern, WhiteKernel
    except ImportError as error:
        raise OutputError(install_hint("scikit-learn", "study")) from error
    # maximum of the marginal likelihood, from several starts
    variance, lengths = start or (1.0, np.full(x.shape[1], 0.5))
    untyped: dict[str, Any] = {"length_scale": lengths, "alpha": floor}  # scikit-learn says floats
    smooth = Matern(untyped["length_scale"], LENGTHS, nu=2.5)
    process: Any = GaussianProcessRegressor(
        ConstantKernel(variance, VARIANCES) * smooth + WhiteKernel(1e-4, NOISES),
        alpha=untyped["alpha"],
        n_restarts_optimizer=RESTARTS if start is None else 0,
        random_state=seed,
    )
    with warnings.catch_warnings():  # parameters may end at their bounds
        warnings.simplefilter("ignore", ConvergenceWarning)
        process.fit(x, y)
    # scikit-learn keeps the logarithms of the parameters, in the order of the kernel
    variance, *lengths, noise = np.exp(process.kernel_.theta)
    return floor + noise, float(variance), np.array(lengths)
