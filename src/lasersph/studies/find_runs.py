"""`find`: settings for wanted results, with runs added where the answer is unsure.

    case = "dlip-steel"
    want = ["melt.depth_half_max_m = 200 +- 10 nm", "temperature_max_K < 3000 K"]
    [vary]
    "laser.fluence" = { from = "0.3 J/cm^2", to = "1 J/cm^2" }
    [runs]
    first = 8
    most = 16

Runs of a Sobol sequence in the box of the ranges come first. Then runs are made at the settings
found, where the error of the emulator changes their probability by more than 5 %, until it does
not or the budget is spent. Every decision follows from the plan and the finished runs.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

from pydantic import Field

from lasersph.input import QuantityError, build
from lasersph.studies.calibration_run import make_or_stop, read_answer
from lasersph.studies.find_settings import (
    FoundSettings,
    Target,
    find_settings,
    parse_target,
    refuse_other_keys,
)
from lasersph.studies.run_budget import RunBudget
from lasersph.sweeps import Engine, LocalEngine, Study, SweepPlan, Table
from lasersph.sweeps.plan import Sampling, VariedCase, compare_with_case
from lasersph.sweeps.plan_reading import Mistakes, entries_of, read_plan_file
from lasersph.sweeps.sampling import DIGITS

LARGEST_EMULATOR_SHARE = 0.05
"""Change of a probability by the emulator up to which an answer is sure: less than its rounding in
what is printed matters to whoever chooses settings."""
AT_ONCE = 2
"""Runs added at a time; a fixed number, so that results do not depend on the workers."""


class FindEntry(VariedCase):
    """The keys of a plan to find settings."""

    want: tuple[str, ...] = Field(examples=[["melt.depth_half_max_m = 200 +- 10 nm"]])
    runs: RunBudget = RunBudget()


@dataclass(frozen=True)
class FindPlan:
    """A plan that the case takes: the first runs, what is wanted, how many runs at most."""

    sweep: SweepPlan
    targets: tuple[Target, ...]
    budget: RunBudget

    @property
    def study(self) -> Study:
        """Study that a folder must belong to for this plan to go on in it."""
        sweep = self.sweep
        return Study.of("search", sweep.template, sweep.varied, sweep.text)


def read_find_plan(file: str | PathLike[str]) -> FindPlan:
    """Read a plan to find settings.

    Raises:
        CaseError: every mistake of the plan, or of its case, in one line with file and line.
    """
    document = read_plan_file(file, "find")
    entry = build(FindEntry, document)
    mistakes, targets = Mistakes(document), []
    # what is wanted, then how many runs, then what varies
    for number, text in enumerate(entry.want):
        try:
            targets.append(parse_target(text))
        except QuantityError as error:
            mistakes.add(("want", number), str(error), key="want")
    if not entry.want:
        hint = 'write e.g. want = ["melt.depth_half_max_m = 200 +- 10 nm"]'
        mistakes.add(("want",), "nothing is wanted", hint)
    keys = len(entries_of(entry.vary, ("vary",)))
    entry.runs.refuse_too_few(keys, mistakes)
    first = entry.runs.first_runs(keys)
    sampling = Sampling(kind="sobol", runs=first, seed=entry.runs.seed)
    sweep = compare_with_case(mistakes, entry, sampling)
    return FindPlan(sweep, tuple(targets), entry.runs)


def find(
    plan: str | PathLike[str],
    out: str | PathLike[str] | None = None,
    *,
    want: Sequence[str] = (),
    under: str | PathLike[str] | None = None,
    engine: Engine | None = None,
    report: Callable[[str], None] | None = None,
    should_stop: Callable[[], bool] | None = None,
) -> list[FoundSettings]:
    """Find settings that reach wanted values inside limits, the most probable first.

        lasersph.find("runs/sweep", want=["melt.depth_half_max_m = 200 +- 10 nm"])
        lasersph.find("plan.toml", "runs/find")

    Args:
        plan: the folder of a sweep, whose runs are looked at, with `want`; or a plan file, which
            says what is wanted and whose runs are made in the folder `out`, where needed more.
        under: folder of a calibration, over whose posterior probabilities are averaged.
        engine: what computes runs; None for this machine. report: called with lines on how far it
            is. should_stop: asked several times a second; True ends all runs with checkpoints.

    Returns:
        At most five settings; none where all are impossible.

    Raises:
        CaseError: every mistake of the plan or its case. QuantityError: a wrong target.
        ValueError: too few runs, or numbers that none of them has. OutputError: see `make_runs`.
        Stopped: `should_stop` said so.
    """
    # a folder of runs is only read; a plan makes runs of its own
    known = None if under is None else read_answer(under)
    if Path(plan).is_dir():
        return find_settings(
            Table.read(plan), [parse_target(one) for one in want], calibration=known
        )
    if want or out is None:
        raise ValueError("a plan says itself what is wanted, and its runs need a folder")
    loaded = read_find_plan(plan)
    sweep, points = loaded.sweep, loaded.sweep.points()
    refuse_other_keys(known, tuple(sweep.choices))
    while True:
        table = make_or_stop(
            points, Path(out), loaded.study, engine or LocalEngine(), report, should_stop
        )
        # run the settings whose probability the emulator decides, as far as the budget goes
        found = find_settings(table, loaded.targets, calibration=known, seed=loaded.budget.seed)
        unsure = sorted(
            (one for one in found if one.emulator_share > LARGEST_EMULATOR_SHARE),
            key=lambda o: -o.emulator_share,
        )
        wanted = [
            sweep.template.point({k: float(f"{v:.{DIGITS}g}") for k, v in one.case_keys.items()})
            for one in unsure
        ]
        there = {point.hash for point in points}
        fresh = [one for one in wanted if one.hash not in there][:AT_ONCE]
        fresh = fresh[: loaded.budget.most - len(points)]
        best = f"{100.0 * found[0].probability:.3g} %" if found else "nothing possible"
        if report is not None:
            report(f"{len(points)} runs: {best}, {len(unsure)} of {len(found)} settings unsure")
        if not fresh:
            return found
        points += fresh
