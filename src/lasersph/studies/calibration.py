"""Calibration: unknowns of a case from measured values, with some tens of runs.

Runs are emulated over keys of the case, not over the unknowns, so that one run serves all measured
values. Runs of a Sobol sequence in the box of keys that the bounds of the unknowns reach come
first; then runs are added where, inside the posterior, the emulator knows least beside the
standard error of what was measured there, until that no longer matters or the budget is spent.

Every decision follows from the plan and the finished runs, in their order: a calibration that is
killed and repeated finds its runs and gives the same numbers bit for bit.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.special import gammaincc

from lasersph.input import format_quantity
from lasersph.input.key_units import unit_of
from lasersph.studies.calibration_plan import CalibrationPlan, NoCalibration
from lasersph.studies.calibration_profile import ProfileFit, reduce_profiles
from lasersph.studies.emulator import Emulator, box_of, fit_emulator
from lasersph.studies.identifiability import Combination, find_combinations
from lasersph.studies.posterior import Model, Posterior, find_posterior
from lasersph.studies.texture.compare import AnyRelief
from lasersph.sweeps.sampling import DIGITS, Choices, Range, sobol

Array = NDArray[np.float64]
Settings = Mapping[str, float]
Numbers = Mapping[str, float]
MakeRuns = Callable[[Sequence[Settings]], Sequence[Numbers | None]]
"""Makes runs with these settings (SI, by key) exist: the numbers of their summaries, None of those
that fail. It is called with all runs again each time, the new ones last."""
MakeReliefs = Callable[[Sequence[Settings]], Sequence[AnyRelief | None]]
"""The reliefs of the same runs, where profiles are measured; called after `MakeRuns`."""
GOOD_ENOUGH = 0.3
"""Standard deviation of the emulator over the measured one from which runs add nothing: it widens
a band by 1 - sqrt(1 + 0.09), 4 %."""
AT_ONCE = 2
"""Runs added at a time, of different measurements; a fixed number, so that results do not depend
on how many workers there are."""
DRAWS = 256
"""Points of the posterior among which the emulator is looked at."""
IMPROBABLE = 0.01
"""Probability of so large a chi^2 below which the model does not describe the data."""


@dataclass(frozen=True)
class Calibration:
    """Posterior of the unknowns of a case, with the runs and emulators that it comes from.

    Attributes:
        plan, model, posterior: what was asked, the emulators, the answer.
        settings, numbers: of all runs in their order; None for numbers of runs that failed.
        ratio: largest standard deviation of the emulator over the measured one in the posterior.
        combinations: unknowns that the data do not fix one by one.
        profiles: measured ones, whose components are among the data of `plan`.
    """

    plan: CalibrationPlan
    model: Model
    posterior: Posterior
    settings: tuple[Settings, ...]
    numbers: tuple[Numbers | None, ...]
    ratio: float
    combinations: list[Combination] = field(default_factory=list)
    profiles: list[ProfileFit] = field(default_factory=list)

    @property
    def chi_squared(self) -> tuple[float, int, float]:
        """chi^2 of the data at the most probable unknowns, degrees of freedom, and how probable so
        large a value is: with none left, where only bounds keep it from 0, as if there were one."""
        total = float(np.sum(self.pulls**2))
        freedom = len(self.model.data) - sum(one.known is None for one in self.plan.unknowns)
        return total, freedom, float(gammaincc(0.5 * max(freedom, 1), 0.5 * total))

    @property
    def pulls(self) -> Array:
        """Measured less computed value at the most probable unknowns over all errors (values,)."""
        mean, sd = self.model.predict(self.posterior.most_probable)
        value, error = self.model.measured
        return (value - mean[0]) / np.sqrt(error**2 + sd[0] ** 2 + self.model.numerical_sd**2)

    def unidentified(self) -> set[str]:
        """Names of the unknowns that the data do not fix."""
        return {name for one in self.combinations for name in one.unknowns}

    def warnings(self) -> list[str]:
        """Lines that a user must know before using the numbers."""
        found = [one.sentence() for one in self.combinations]
        sd = np.sqrt(np.diag(self.posterior.covariance))
        unidentified = self.unidentified()
        # not the mean: where a bound cuts the posterior, its mean lies a standard deviation inside
        for one, x, s in zip(self.plan.unknowns, self.posterior.most_probable, sd, strict=True):
            for end in (one.low, one.high):
                if abs(x - end) < s and one.name not in unidentified:
                    found.append(
                        f"{one.name} is most probable within one standard deviation of its bound "
                        f"{end:.6g}: widen between"
                    )
        total, freedom, probability = self.chi_squared
        if probability < IMPROBABLE:
            worst = int(np.argmax(np.abs(self.pulls)))
            place, column = self.model.data[worst]
            found.append(
                f"the model does not describe these data: chi^2 = {total:.3g} with {freedom} "
                f"degrees of freedom (p = {probability:.1g}); farthest off is {column} of "
                f"measurement {place + 1}, by {abs(self.pulls[worst]):.1f} standard deviations"
            )
        for fit in self.profiles:
            if fit.probability < IMPROBABLE:
                found.append(
                    f"no sum of the runs has profile {fit.number}: {1e9 * fit.left_over:.3g} nm "
                    "rms of it are left over, more than its standard error explains"
                )
        # the emulator by itself: how well runs predict the others
        for column, emulator in self.model.emulators.items():
            error = float(np.sqrt(np.mean(emulator.leave_one_out()[0] ** 2)))
            least = min(
                one.values[column].sd for one in self.plan.conditions if column in one.values
            )
            if error > least:
                known, measured = (format_quantity(one, unit_of(column)) for one in (error, least))
                found.append(
                    f"runs predict {column} of one another to {known}, worse than it was "
                    f"measured ({measured}): allow more runs or narrower bounds"
                )
        if self.ratio > GOOD_ENOUGH:
            found.append(
                f"{len(self.settings)} runs leave the emulator at {self.ratio:.2g} of a measured "
                "standard error: allow more runs (most)"
            )
        # the box without failed runs may not reach as far as the bounds do
        failed = sum(one is None for one in self.numbers)
        if failed:
            text = f"{failed} of {len(self.numbers)} runs failed and were left out"
            found.append("; ".join([text, *self._extrapolated()]))
        return found

    def _extrapolated(self) -> Iterator[str]:
        """Beyond which keys of the case failed runs lie, and complete ones do not."""
        pairs = list(zip(self.settings, self.numbers, strict=True))
        for key, unit in self.plan.units.items():
            known = [one[key] for one, numbers in pairs if numbers is not None]
            wanted = [one[key] for one, _ in pairs]
            for word, end, farthest in (
                ("below", min(known), min(wanted)),
                ("above", max(known), max(wanted)),
            ):
                if farthest != end:
                    yield f"{word} {key} = {end:.4g} {unit}".rstrip() + " the answer extrapolates"


def calibrate_with(
    plan: CalibrationPlan,
    make: MakeRuns,
    report: Callable[[str], None] | None = None,
    reliefs: MakeReliefs | None = None,
) -> Calibration:
    """Calibrate with any maker of runs.

    Args:
        make, reliefs: see `MakeRuns`, `MakeReliefs`. report: called with a line after each look at
            the data.

    Raises:
        NoCalibration: too few runs give the measured numbers. OutputError: scikit-learn, or emcee
            with three unknowns or more, is not installed.
    """
    settings = first_settings(plan)
    # the answer of all runs so far, and whether the emulator still widens it
    while True:
        made, lines = make(settings), [] if reliefs is None else reliefs(settings)
        reduced, numbers, profiles = reduce_profiles(plan, made, lines)
        model = emulate(reduced, settings, numbers)
        posterior = find_posterior(model, plan.runs.seed)
        ratio, wanted = _next_runs(model, posterior)
        if report is not None:
            report(
                f"{len(settings)} runs: {_shown(plan, posterior)}; emulator at {ratio:.2g} of a "
                "standard error"
            )
        # runs where the emulator knows least, as far as the budget goes
        budget_left = plan.runs.most - len(settings)
        fresh = [one for one in wanted if one not in settings][:budget_left]
        if ratio <= GOOD_ENOUGH or not fresh:
            break
        settings += fresh
    found = find_combinations(plan, posterior)
    return Calibration(
        reduced, model, posterior, tuple(settings), tuple(numbers), ratio, found, profiles
    )


def first_settings(plan: CalibrationPlan) -> list[Settings]:
    """Settings of the first runs: a Sobol sequence in the box that the bounds reach."""
    corners = zip(plan.keys, *plan.box(), strict=True)
    ranges: Choices = {key: Range(float(low), float(high)) for key, low, high in corners}
    return [
        {key: float(value) for key, value in one.items()}
        for one in sobol(ranges, plan.first_runs, plan.runs.seed)
    ]


def _shown(plan: CalibrationPlan, posterior: Posterior) -> str:
    sd = np.sqrt(np.diag(posterior.covariance))
    rows = zip(plan.unknowns, posterior.mean, sd, strict=True)
    return ", ".join(f"{one.name} {m:.5g} +- {s:.2g} {one.unit}".rstrip() for one, m, s in rows)


def emulate(
    plan: CalibrationPlan, settings: Sequence[Settings], numbers: Sequence[Numbers | None]
) -> Model:
    """Emulators of all measured numbers from the runs that have them.

    Raises:
        NoCalibration: a number that too few runs have, or that does not change.
    """
    box = box_of(*plan.box())
    inputs = np.array([[one[key] for key in plan.keys] for one in settings])
    emulators: dict[str, Emulator] = {}
    numerical: dict[str, float] = {}
    for column in dict.fromkeys(column for one in plan.conditions for column in one.values):
        values = np.array([np.nan if one is None else one.get(column, np.nan) for one in numbers])
        noise = np.array(
            [0.0 if one is None else one.get(f"numerical_sd.{column}", 0.0) for one in numbers]
        )
        # keys + 2 runs: a mean, and a length of each key
        has = np.isfinite(values)
        if np.count_nonzero(has) < inputs.shape[1] + 2:
            done = sum(one is not None for one in numbers)
            raise NoCalibration(
                f"only {np.count_nonzero(has)} of {len(settings)} runs give {column} ({done} are "
                f"complete), {inputs.shape[1] + 2} are needed: check the bounds or allow more "
                "first runs"
            )
        try:
            emulators[column] = fit_emulator(
                inputs[has], values[has], box=box, noise=noise[has], seed=plan.runs.seed
            )
        except ValueError as error:
            raise NoCalibration(f"{column}: {error}") from None
        numerical[column] = float(np.max(noise[has]))
    return Model(plan, emulators, numerical)


def _next_runs(model: Model, posterior: Posterior) -> tuple[float, list[Settings]]:
    """Largest standard deviation of the emulators over a measured one in the posterior, and the
    settings that would lower it, of different measurements."""
    plan, draws = model.plan, posterior.draw(DRAWS, model.plan.runs.seed)
    _, sd = model.predict(draws)
    # where in the posterior the emulator's error is largest beside the measured one
    ratios = sd / model.measured[1]
    places = np.array([place for place, _ in model.data])
    found: list[tuple[float, Settings]] = []
    # one run for each measurement, at its settings with the unknowns drawn there
    for place in dict.fromkeys(places):
        of_place = ratios[:, places == place].max(axis=1)
        draw = int(np.argmax(of_place))
        inputs = plan.inputs(draws[draw : draw + 1], plan.conditions[place])[0]
        values = (float(f"{value:.{DIGITS}g}") for value in inputs)
        found.append((float(of_place[draw]), dict(zip(plan.keys, values, strict=True))))
    found.sort(key=lambda one: -one[0])
    wanted = [one for ratio, one in found[:AT_ONCE] if ratio > GOOD_ENOUGH]
    return found[0][0], wanted
