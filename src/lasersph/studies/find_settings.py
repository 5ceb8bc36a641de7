"""Settings that reach wanted values inside limits, and how probably they do.

Numbers of a sweep are emulated over its keys. With means m_j and standard deviations s_j (of the
emulators and of sizes in cells), wanted between a_j and b_j, settings do it with the probability

    P = product over j of [Phi((b_j - m_j) / s_j) - Phi((a_j - m_j) / s_j)]

averaged over the posterior of a calibration where one is given: the settings of a machine then
reach the metal by its unknowns. Settings outside the hull of the runs count as impossible. Errors
of different numbers count as independent.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtr
from scipy.stats import qmc

from lasersph.input import QuantityError, parse_quantity
from lasersph.studies.calibration_plan import Relation, related
from lasersph.studies.emulator import Emulator, fit_emulator
from lasersph.studies.measured_value import kind_of_number, read_measured
from lasersph.studies.sweep_numbers import box_of_runs, numerical_deviation, sizes_of
from lasersph.sweeps import Table

Array = NDArray[np.float64]
LOOKS, NARROWER = 1024, 0.15
"""Settings of a first look, and of a second one around each of the best, in how small a part of
the ranges."""
DRAWS = 32
"""Points of a posterior over which probabilities are averaged."""
APART = 0.1
"""Least distance of two answers, in ranges of their keys."""
Answer = tuple[dict[str, Any], Array]
"""Of a calibration: content of calibration.json, points of the posterior with their weights."""
ParameterSample = list[tuple[int, Relation, float]]
"""One drawn value of each unknown: number of its key, relation and value."""
_TARGET = re.compile(r"\s*([\w.]+)\s*(=|<=?|>=?)\s*(.+)")


@dataclass(frozen=True)
class Target:
    """A number of summaries that shall lie between low and high, in SI."""

    column: str
    low: float
    high: float


@dataclass(frozen=True)
class FoundSettings:
    """Settings that may do what is wanted, in SI.

    Attributes:
        settings: by key. probability: that all targets are met.
        numbers: mean of those that have a target. case_keys: the keys of the case that the settings
            act as, by a calibration; the settings themselves without one.
        emulator_share: how much of the probability, from 0 to 1, is the emulator's: its distance
            from what it would be were the means exact.
    """

    settings: dict[str, float]
    probability: float
    numbers: dict[str, float]
    case_keys: dict[str, float]
    emulator_share: float


def parse_target(text: str) -> Target:
    """A target from "melt.depth_max_m = 200 +- 10 nm" or "temperature_max_K < 3000 K".

    Raises:
        QuantityError: no such number, no such unit, neither = with +- nor < nor >.
    """
    # a value with its error is an interval, a limit is open at one end
    match = _TARGET.fullmatch(text)
    if match is None:
        raise QuantityError(
            f'"{text}" is no target; write e.g. "melt.depth_max_m = 200 +- 10 nm" or '
            '"temperature_max_K < 3000 K"'
        )
    column, sign, wanted = match.groups()
    kind = kind_of_number(column)
    if sign == "=":
        value = read_measured(wanted, kind)
        return Target(column, value.value - value.sd, value.value + value.sd)
    limit = parse_quantity(wanted, kind) if kind else float(wanted)
    return Target(column, -math.inf, limit) if "<" in sign else Target(column, limit, math.inf)


def find_settings(
    table: Table,
    targets: Sequence[Target],
    *,
    calibration: Answer | None = None,
    count: int = 5,
    seed: int = 1,
) -> list[FoundSettings]:
    """The most probable settings of a sweep for some targets, the best first; none where all are
    impossible.

    Args:
        calibration: what `calibration_run.read_answer` gives. count: answers at most.

    Raises:
        ValueError: too few runs, a number that none of them has, an unknown of the calibration at
            a key that the sweep does not vary.
    """
    # an emulator of each number that is wanted
    points = np.column_stack([table.values(key) for key in table.varied])
    box = box_of_runs(points)
    emulators: dict[str, Emulator] = {}
    numerical = {target.column: numerical_deviation(table, target.column) for target in targets}
    for column, noise in numerical.items():
        values = sizes_of(table, column)
        has = np.isfinite(values)
        given = points[has], values[has]
        try:
            emulators[column] = fit_emulator(*given, box=box, noise=noise, seed=seed)
        except ValueError as error:
            raise ValueError(f"{column}: {error}") from None
    refuse_other_keys(calibration, table.varied)
    samples = _samples(table.varied, calibration, seed)

    # P of settings, averaged over the posterior
    def probabilities(settings: Array, *, are_exact: bool = False) -> Array:
        total = np.zeros(len(settings))
        for sample in samples:
            keys = _case_keys(settings, sample)
            part = next(iter(emulators.values())).is_inside(keys).astype(float)
            for target in targets:
                mean, sd = emulators[target.column].predict(keys)
                least = max(numerical[target.column], 1e-9 * abs(float(np.max(mean))))
                sd = np.hypot(0.0 if are_exact else sd, least)
                part *= ndtr((target.high - mean) / sd) - ndtr((target.low - mean) / sd)
            total += part
        return total / len(samples)

    # Sobol points in the box, then narrower ones around the best
    candidates = qmc.Sobol(points.shape[1], seed=seed).random(LOOKS)  # pyright: ignore[reportCallIssue]
    first = _best(candidates, probabilities(box.restored(candidates)), count)
    steps = NARROWER * (candidates[: LOOKS // 8] - 0.5)
    near = [np.clip(candidates[number] + steps, 0.0, 1.0) for number in first]
    every = np.vstack([candidates, *near])
    chance = probabilities(box.restored(every))
    found = []
    for number in _best(every, chance, count):
        settings = box.restored(every[number : number + 1])
        keys = np.vstack([_case_keys(settings, sample) for sample in samples])
        numbers = {name: float(np.mean(one.predict(keys)[0])) for name, one in emulators.items()}
        # the settings, and the keys of the case that they act as
        by_key, acts_as = (
            dict(zip(table.varied, values.tolist(), strict=True))
            for values in (settings[0], keys.mean(axis=0))
        )
        emulator_share = abs(float(chance[number] - probabilities(settings, are_exact=True)[0]))
        found.append(FoundSettings(by_key, float(chance[number]), numbers, acts_as, emulator_share))
    return found


def _best(candidates: Array, chance: Array, count: int) -> list[int]:
    """Places of the most probable candidates that lie apart, and are possible at all."""
    chosen: list[int] = []
    # from the most probable on, those that lie apart from all before
    for number in np.argsort(-chance, kind="stable"):
        if chance[number] < 1e-6 or len(chosen) == count:
            break
        gaps = (np.max(np.abs(candidates[number] - candidates[one])) for one in chosen)
        if all(gap >= APART for gap in gaps):
            chosen.append(int(number))
    return chosen


def _case_keys(settings: Array, sample: ParameterSample) -> Array:
    """Keys of the case (n, keys) that some settings are, were the unknowns so."""
    keys = settings.copy()
    for number, relation, value in sample:
        unknown = np.full(len(settings), value)
        keys[:, number] = related(relation, keys[:, number], unknown)
    return keys


def refuse_other_keys(calibration: Answer | None, keys: Sequence[str]) -> None:
    """Raise ValueError where an unknown of a calibration belongs to none of the keys that vary."""
    for name, one in calibration[0]["unknowns"].items() if calibration is not None else ():
        if one["key"] not in keys:
            raise ValueError(
                f"{name} of the calibration belongs to {one['key']}, which the sweep does not vary"
            )


def _samples(keys: Sequence[str], calibration: Answer | None, seed: int) -> list[ParameterSample]:
    """Unknowns as drawn from a posterior; one sample without unknowns where there is none."""
    if calibration is None:
        return [[]]
    content, points = calibration
    unknowns = content["unknowns"]
    # points of the posterior, drawn by their weights
    weights = points[:, -1] / np.sum(points[:, -1])
    drawn = np.random.default_rng(seed).choice(len(weights), DRAWS, p=weights)
    return [
        [
            (list(keys).index(one["key"]), one["relation"], float(value))
            for one, value in zip(unknowns.values(), points[row], strict=False)
        ]
        for row in drawn
    ]
