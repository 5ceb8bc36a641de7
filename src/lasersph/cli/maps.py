"""`lasersph map` and `sensitivity`: what the runs of a sweep say together."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from lasersph.cli.arguments import read_quantity
from lasersph.cli.failures import WrongCommand
from lasersph.input.text_table import text_table

if TYPE_CHECKING:
    from lasersph.plots.process_map import ProcessMap

SweepFolder = Annotated[Path, typer.Argument(metavar="DIR", help="The folder of a sweep.")]
Key = Annotated[
    str | None, typer.Option(metavar="KEY", help="A key that varies; default: those that vary.")
]
Column = Annotated[
    str,
    typer.Option(
        "--show", metavar="COLUMN", help="A number of the summaries, e.g. melt.width_half_max_m."
    ),
]
Levels = Annotated[
    str | None,
    typer.Option("--levels", metavar="A,B,...", help="Of the contours, e.g. 100nm,200nm."),
]
Emulate = Annotated[
    bool,
    typer.Option("--emulate", help="Interpolate by a Gaussian process; hatch where it is unsure."),
]
Target = Annotated[
    str | None,
    typer.Option("--target", metavar="VALUE", help='Draw the line of a value, e.g. "200 nm".'),
]
Tolerance = Annotated[
    float,
    typer.Option(
        "--tolerance",
        min=1e-6,
        max=1.0,
        help="Hatch above this standard deviation, as a share of the largest value.",
    ),
]
Of = Annotated[str, typer.Option("--of", metavar="COLUMN", help="A number of the summaries.")]


def draw_map(
    folder: SweepFolder,
    x: Key = None,
    y: Key = None,
    show: Column = "melt.depth_half_max_m",
    levels: Levels = None,
    emulate: Emulate = False,
    target: Target = None,
    tolerance: Tolerance = 0.05,
) -> None:
    """Draw a number of a sweep over its keys, with the lines of melting, boiling and ablation."""
    from lasersph.input.key_units import unit_of
    from lasersph.report.map_page import write_map
    from lasersph.studies.maps import process_map

    unit = unit_of(show)
    # Values with units, as the column has them.
    wanted = None if target is None else _read_value("--target", target, unit)
    steps = [_read_value("--levels", one, unit) for one in (levels or "").split(",") if one.strip()]
    if levels is not None and (len(steps) < 2 or sorted(set(steps)) != steps):
        raise WrongCommand("--levels: give two or more values that rise, e.g. 100nm,200nm")
    # The map itself refuses a key or a column that the sweep does not have.
    try:
        found = process_map(folder, x, y, show, emulate=emulate, target=wanted, tolerance=tolerance)
    except (KeyError, ValueError) as error:
        raise WrongCommand(str(error.args[0])) from None
    _say(found)
    for file in write_map(found, folder, _title(folder), levels=tuple(steps)):
        print(file)


def sensitivity(folder: SweepFolder, of: Of = "melt.depth_half_max_m") -> None:
    """Tell how much each key of a sweep changes a number: Sobol indices, or effects of Morris."""
    from lasersph.input import in_field_units
    from lasersph.input.key_units import unit_of
    from lasersph.studies.sensitivity import assess_sensitivity

    try:
        found = assess_sensitivity(folder, of)
    except (KeyError, ValueError) as error:
        raise WrongCommand(str(error.args[0])) from None

    # Sobol indices: share of the variance by one key alone, and with all others.
    if found.sobol is not None:
        rows, one = [], found.sobol
        columns = (one.first, one.first_error, one.total, one.total_error)
        for key, s, ds, t, dt in zip(found.keys, *columns, strict=True):
            rows.append([key, f"{s:.3f} +- {ds:.3f}", f"{t:.3f} +- {dt:.3f}"])
        print(text_table(rows, ("key", "first order", "total")))
        known = 100.0 * (found.predictivity or 0.0)
        print(
            f"from {found.runs} runs; left out one at a time and predicted from the others, "
            f"{known:.3g} % of how they differ is explained"
        )

    # Morris: mean size and deviation of the effects of a key over its whole range.
    if found.screening is not None:
        rows = []
        one = found.screening
        unit = unit_of(of)
        for key, *sizes, count in zip(
            found.keys, one.mean_size, one.deviation, one.count, strict=True
        ):
            rows.append([key, *(in_field_units(size, unit) for size in sizes), str(count)])
        print(text_table(rows, ("key", "mean size", "deviation", "effects")))
        print(f"changes of {of} over the whole range of a key, from {found.runs} runs")


def _read_value(option: str, text: str, unit: str) -> float:
    """A value of a number of the summaries, with its unit. Raises WrongCommand."""
    from lasersph.input import KINDS

    kind = next((name for name, one in KINDS.items() if one.unit == unit), "fraction")
    return read_quantity(option, text, kind)


def _title(folder: Path) -> str:
    return f"Process map of {folder.resolve().name}"


def _say(found: ProcessMap) -> None:
    """The notes, where events begin, and where the line of the wanted value runs."""
    from lasersph.input import in_field_units

    for note in found.notes:
        # Notes first, then events in words, then lines by their ends.
        print(f"note: {note}")
    for event, text in found.onset_words():
        print(f"{event}{', ' if len(found.axes) == 2 else ': '}{text}")
    in_words = {one.event for one in found.onsets}
    for name, parts in found.lines.items():
        # Events were said already.
        if name in in_words:
            continue
        points = [point for part in parts for point in part]
        # Ends of the line: the points that are first and last in order.
        ends: Sequence = (min(points, key=tuple), max(points, key=tuple))
        said = [
            ", ".join(in_field_units(at, a.unit) for at, a in zip(end, found.axes, strict=True))
            for end in ends
        ]
        print(f"{found.line_words(name)}: {' to '.join(dict.fromkeys(said))}")
