"""Which unknowns the data fix, and of which only a combination is known.

The logarithms of the unknowns (unknowns that may be negative as they are) are divided by the
standard deviations that they have beforehand. Along an eigenvector of their covariance whose
standard deviation is above half the data have taught little; where it holds several unknowns, only
the combination across it is known.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lasersph.studies.calibration_plan import CalibrationPlan, Unknown
from lasersph.studies.posterior import Posterior, covariance_of

Array = NDArray[np.float64]
NARROWED = 0.5
"""Standard deviation over that beforehand below which the data have taught something."""
INVOLVED = 0.25
"""Part of a wide direction from which an unknown belongs to it: its square is a sixteenth."""
WHOLE = 0.15
"""Distance from 1 below which an exponent is said as a product or a ratio."""


@dataclass(frozen=True)
class Combination:
    """Unknowns that the data do not fix one by one, and the combination that is known of them.

    Attributes:
        unknowns: their names. words: "factor * absorptivity"; "" where nothing is known of one.
        value, sd: of that combination.
    """

    unknowns: tuple[str, ...]
    words: str = ""
    value: float = float("nan")
    sd: float = float("nan")

    def sentence(self) -> str:
        """Sentence that a user must know."""
        if not self.words:
            text = f"the data hardly tell {self.unknowns[0]}: its band is about what was known"
            return f"{text} before"
        names = " and ".join(self.unknowns)
        kind = "product" if "^" not in self.words and "*" in self.words else "combination"
        kind = "ratio" if "/" in self.words else kind
        return (
            f"only the {kind} {self.words} is known, {self.value:.4g} +- {self.sd:.2g}: the data "
            f"cannot tell {names} apart; measure one of them, or say what is known of it"
        )


def find_combinations(plan: CalibrationPlan, posterior: Posterior) -> list[Combination]:
    """Unknowns that the data do not fix, together with what they fix instead."""
    names = [one.name for one in plan.unknowns]
    curved = np.array([one.low > 0.0 for one in plan.unknowns])
    points = posterior.unknowns
    # a power product is a line in the logarithms
    logs = np.where(curved, np.log(np.where(curved, points, 1.0)), points)
    before = np.array([_sd_before(one) for one in plan.unknowns])
    covariance = covariance_of(logs, posterior.weights)
    # eigenvectors of the covariance over that beforehand: wide ones are not fixed
    values, vectors = np.linalg.eigh(covariance / np.outer(before, before))
    found: list[Combination] = []
    for value, vector in zip(values, vectors.T, strict=True):
        if value <= NARROWED**2:
            continue
        # unknowns along the wide direction: only their combination across it is known
        involved = np.flatnonzero(np.abs(vector) > INVOLVED)
        if involved.size == 1:
            found.append(Combination((names[involved[0]],)))
            continue
        found.append(_combination(names, involved, covariance, points, curved, posterior))
    return found


def separability(
    plan: CalibrationPlan, posterior: Posterior, combinations: Sequence[Combination]
) -> str:
    """Which unknowns the data fix one by one, how well, and which they confuse most; a sentence."""
    unidentified = {name for one in combinations for name in one.unknowns}
    names = [one.name for one in plan.unknowns]
    fixed = [number for number, name in enumerate(names) if name not in unidentified]
    if not fixed:
        return f"the data fix none of {', '.join(names)} by itself"
    sd, mean = np.sqrt(np.diag(posterior.covariance)), posterior.mean
    precisions = [f"{names[k]} to {100.0 * sd[k] / abs(mean[k]):.2g} %" for k in fixed]
    text = f"the data tell {' and '.join(precisions)}"
    if len(fixed) == 1:
        return text
    # the pair of fixed unknowns that the data confuse most
    correlation = np.tril(posterior.covariance / np.outer(sd, sd), -1)[np.ix_(fixed, fixed)]
    a, b = np.unravel_index(int(np.argmax(np.abs(correlation))), correlation.shape)
    pair = f"{names[fixed[b]]} and {names[fixed[a]]}"
    return f"{text} apart; most alike are {pair}, with a correlation of {correlation[a, b]:.2f}"


def _combination(
    names: list[str],
    involved: NDArray[np.intp],
    covariance: Array,
    points: Array,
    curved: NDArray[np.bool_],
    posterior: Posterior,
) -> Combination:
    """The best known combination of some unknowns: that of least variance, the first one's
    exponent 1."""
    chosen = tuple(names[number] for number in involved)
    # direction of least variance among the unknowns involved
    part = covariance[np.ix_(involved, involved)]
    exponents = np.linalg.eigh(part)[1][:, 0]
    if involved.size == 2:  # exponents of least variance given the first: b = -cov / var
        exponents = np.array([1.0, -part[0, 1] / part[1, 1]])
    exponents = exponents / exponents[0]
    # exponents near whole numbers are said as a product or ratio
    rounded = np.round(exponents)
    exponents = np.where((np.abs(exponents - rounded) < WHOLE) & (rounded != 0), rounded, exponents)
    if not np.all(curved[involved]):
        return Combination(chosen, f"combination of {' and '.join(chosen)}")
    # the combination in words, and its mean and deviation in the posterior
    words = chosen[0]
    for name, exponent in zip(chosen[1:], exponents[1:], strict=True):
        sign = " / " if exponent < 0.0 else " * "
        power = "" if abs(exponent) == 1.0 else f"^{abs(exponent):.2g}"
        words += f"{sign}{name}{power}"
    values = np.prod(points[:, involved] ** exponents, axis=1)
    mean = float(posterior.weights @ values)
    sd = float(np.sqrt(posterior.weights @ (values - mean) ** 2))
    return Combination(chosen, words, mean, sd)


def _sd_before(one: Unknown) -> float:
    """Standard deviation of the (logarithm of the) unknown before the data."""
    # even between the bounds, or normal where something is known
    x = np.linspace(one.low, one.high, 2001)
    weights = np.ones_like(x)
    if one.known is not None:
        weights = np.exp(-0.5 * ((x - one.known.value) / one.known.sd) ** 2)
    values = np.log(x)[:, None] if one.low > 0.0 else x[:, None]
    return float(np.sqrt(covariance_of(values, weights / np.sum(weights))[0, 0]))
