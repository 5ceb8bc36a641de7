"""`lasersph calibrate` and `find`: unknowns from measured values, settings for wanted ones."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from lasersph.cli.arguments import Out
from lasersph.cli.engine_options import EngineOptions, takes_engine
from lasersph.cli.failures import StoppedBySignal, WrongCommand
from lasersph.cli.same_command import command_of
from lasersph.cli.sweeping import (
    DryRun,
    count_words,
    forecast_rows,
    refused_words,
    say_forecast,
    tell_refused,
    tell_warnings,
)
from lasersph.input.text_table import text_table

if TYPE_CHECKING:
    from lasersph.studies.calibration_plan import CalibrationPlan
    from lasersph.studies.find_runs import FindPlan
    from lasersph.studies.find_settings import FoundSettings
    from lasersph.sweeps import Point, Table

PlanName = Annotated[
    Path,
    typer.Argument(metavar="PLAN", help="A plan file; lasersph new --plan calibrate writes one."),
]
Place = Annotated[
    Path,
    typer.Argument(
        metavar="PLAN|DIR",
        help="A plan file; lasersph new --plan find writes one. Or the folder of a sweep.",
    ),
]
Wants = Annotated[
    list[str] | None,
    typer.Option(
        "--want",
        metavar="WISH",
        help='"melt.depth_half_max_m = 200 +- 10 nm", "temperature_max_K < 3000 K".',
    ),
]
Under = Annotated[
    Path | None,
    typer.Option("--under", metavar="DIR", help="A calibration, over whose posterior to average."),
]


@takes_engine
def calibrate(
    plan: PlanName,
    engine: EngineOptions,
    out: Out = None,
    dry_run: DryRun = False,
) -> None:
    """Find unknowns of a case from measured values, with their bands and what limits them."""
    from lasersph.cli.stop_signals import StopSignals
    from lasersph.simulation.time_loop import Stopped
    from lasersph.studies import calibration_run
    from lasersph.studies.calibration_answer import answer_lines
    from lasersph.studies.calibration_reading import read_calibration_plan
    from lasersph.sweeps import Table

    # The plan is read, and refused, before an engine starts.
    loaded = read_calibration_plan(plan)
    if dry_run:
        _forecast_calibration(loaded, engine)
        return
    folder = out or Path("runs") / plan.stem
    chosen = engine.engine()
    points, most = _first_points(loaded)
    more = ", and two checks" * loaded.runs.check
    say_forecast(points, engine, folder, loaded.study, most, more)

    # A signal ends the runs in hand with a checkpoint; the same command goes on.
    with StopSignals() as signals:
        try:
            found = calibration_run.calibrate(
                loaded, folder, engine=chosen, report=_say, should_stop=signals.asked
            )
        except Stopped as error:
            raise _stopped(error, signals.code, "calibrate", plan, folder, engine) from None
    tell_warnings(Table.read(folder))
    for line in answer_lines(found):
        print(line)
    print(folder / calibration_run.FIGURE)


@takes_engine
def find(
    place: Place,
    engine: EngineOptions,
    want: Wants = None,
    under: Under = None,
    out: Out = None,
    dry_run: DryRun = False,
) -> None:
    """Find settings of a sweep that reach wanted values inside limits, and how probably."""
    from lasersph.cli.stop_signals import StopSignals
    from lasersph.input import CaseError, QuantityError
    from lasersph.output import OutputError
    from lasersph.simulation.time_loop import Stopped
    from lasersph.studies import find_runs
    from lasersph.studies.find_settings import parse_target
    from lasersph.sweeps import Table

    folder = place if place.is_dir() else out or Path("runs") / place.stem
    _refuse_mixed(place, want, is_planned=out is not None or bool(engine.words()) or dry_run)
    plan = None if place.is_dir() else find_runs.read_find_plan(place)
    if plan is not None and dry_run:
        _forecast_find(plan, engine)
        return

    # The engine refuses contradicting options before anything is written.
    chosen = engine.engine()
    if plan is not None:
        say_forecast(plan.sweep.points(), engine, folder, plan.study, plan.budget.most)
    with StopSignals() as signals:
        try:
            found = find_runs.find(
                place,
                folder,
                want=want or (),
                under=under,
                engine=chosen,
                report=_say,
                should_stop=signals.asked,
            )
        except Stopped as error:
            raise _stopped(error, signals.code, "find", place, folder, engine) from None
        except CaseError:
            # A case that is refused says so itself; anything else is said as a wrong command.
            raise
        except (QuantityError, OutputError, ValueError, KeyError) as error:
            raise WrongCommand(str(error.args[0])) from None
    # What can be reached, where nothing is found.
    table = Table.read(folder)
    if not found:
        targets = plan.targets if plan is not None else [parse_target(text) for text in want or ()]
        reached = ", ".join(dict.fromkeys(_reached(table, one.column) for one in targets))
        raise WrongCommand(
            f"no settings inside the runs of {folder} do all of this; they reach {reached}"
        )
    tell_warnings(table)
    _print_found(table, found)


def _refuse_mixed(place: Path, want: Sequence[str] | None, *, is_planned: bool) -> None:
    """Raise WrongCommand for options of the other kind: a folder has its runs, a plan makes them.

    Args:
        is_planned: whether there are options of a plan.
    """
    if place.is_dir() and (is_planned or not want):
        raise WrongCommand(
            f"{place} is a folder, whose runs are looked at: it takes --want and --under; a plan "
            "(lasersph new --plan find FILE) has runs of its own"
        )
    if not place.is_dir() and want:
        raise WrongCommand("--want is for the folder of a sweep: a plan says what is wanted")


def _print_found(table: Table, found: Sequence[FoundSettings]) -> None:
    """Settings in the units of the plan, numbers in those of their columns."""
    from lasersph.input import format_quantity

    units = table.shown_units()
    rows = []
    for one in found:
        settings = [units[key].text(value) for key, value in one.settings.items()]
        numbers = [
            format_quantity(value, table.number_unit(name)) for name, value in one.numbers.items()
        ]
        rows.append([f"{100.0 * one.probability:.3g} %", *settings, *numbers])
    print(text_table(rows, ("probability", *found[0].settings, *found[0].numbers)))
    if found[0].probability < 0.5:
        _say("note: none of these is likelier than not; more runs near them may help")


def _reached(table: Table, column: str) -> str:
    """A number of the runs of a sweep, with its least and its largest value."""
    from lasersph.input import format_quantity

    values, unit = [one for one in table.values(column) if isfinite(one)], table.number_unit(column)
    low, high = (format_quantity(float(one), unit) for one in (min(values), max(values)))
    return f"{column} from {low} to {high}"


def _stopped(
    error: Exception, code: int, verb: str, plan: Path, folder: Path, engine: EngineOptions
) -> StoppedBySignal:
    """Error for what a signal has stopped, which says how to go on."""
    again = command_of(verb, plan, *engine.words(), out=folder)
    return StoppedBySignal(f"{error}; continue with: {again}", code)


def _first_points(plan: CalibrationPlan) -> tuple[list[Point], int]:
    """The first runs of a calibration, or the cells of its first spots, and how many at most."""
    from lasersph.studies.calibration import first_settings

    settings, spot = first_settings(plan), plan.spot
    # Cells of the spots count each once, however many spots share them.
    if spot is None:
        return [plan.template.point(dict(one)) for one in settings], plan.runs.most
    cells = {point.hash: point for one in settings for point in spot.points(one)}
    return list(cells.values()), plan.runs.most * spot.count if len(spot.cell_units) > 1 else 0


def _forecast_calibration(plan: CalibrationPlan, engine: EngineOptions) -> None:
    from lasersph.input.shown_unit import units_written

    points, most = _first_points(plan)
    count = count_words(points, most) + refused_words(points) + ", and two checks" * plan.runs.check
    # The box of the unknowns in the units in which the plan gives them.
    box, shown = zip(plan.keys, *plan.box(), strict=True), units_written(plan.text, plan.units)
    print(
        text_table(
            [
                ("unknown", ", ".join(one.name for one in plan.unknowns)),
                ("measured values", str(sum(len(one.values) for one in plan.conditions))),
                ("profiles", str(sum(one.profile is not None for one in plan.conditions))),
                *(
                    (key, f"{shown[key].text(low, 6)} to {shown[key].text(high, 6)}")
                    for key, low, high in box
                ),
                ("cells" if plan.spot else "runs", count),
                *forecast_rows(points, engine, most),
            ]
        )
    )
    tell_refused(points)


def _forecast_find(plan: FindPlan, engine: EngineOptions) -> None:
    points, most = plan.sweep.points(), plan.budget.most
    rows = [
        ("wanted", ", ".join(dict.fromkeys(one.column for one in plan.targets))),
        ("varied", ", ".join(plan.sweep.choices)),
        ("runs", count_words(points, most) + refused_words(points)),
    ]
    print(text_table([*rows, *forecast_rows(points, engine, most)]))
    tell_refused(points)


def _say(line: str) -> None:
    print(line, file=sys.stderr, flush=True)
