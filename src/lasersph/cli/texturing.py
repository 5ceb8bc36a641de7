"""`lasersph texture`: the texture of a whole spot from cells of its pattern."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from lasersph.cli.arguments import CaseName, Out, Settings, read_quantity
from lasersph.cli.engine_options import EngineOptions, takes_engine
from lasersph.cli.failures import WrongCommand
from lasersph.cli.same_command import command_of
from lasersph.cli.sweeping import DryRun, forecast, make, say_forecast, tell_warnings
from lasersph.input.text_table import text_table

if TYPE_CHECKING:
    from lasersph.studies.texture.make import TexturePlan

Cells = Annotated[
    int, typer.Option("--cells", min=6, max=400, metavar="N", help="Fluences that are computed.")
]
Pixel = Annotated[
    str | None,
    typer.Option("--pixel", metavar="LENGTH", help="Of the maps; default: period over 40."),
]
Share = Annotated[
    list[Path] | None,
    typer.Option("--share", metavar="DIR", help="A sweep whose equal runs are taken."),
]


@takes_engine
def texture(
    case: CaseName,
    engine: EngineOptions,
    out: Out = None,
    settings: Settings = None,
    cells: Cells = 24,
    pixel: Pixel = None,
    share: Share = None,
    dry_run: DryRun = False,
) -> None:
    """Compute the relief that a pulse leaves in its whole spot, from cells of the pattern."""
    from lasersph.output import OutputError
    from lasersph.studies.texture.make import CELLS, link_runs, plan_texture
    from lasersph.studies.texture.spot import NoTexture
    from lasersph.studies.texture.texture import FIGURE, finish_texture

    # Read and refuse before anything is written.
    size = None if pixel is None else read_quantity("--pixel", pixel, "length")
    if size is not None and size <= 0.0:
        raise WrongCommand(f'--pixel: "{pixel}" must be greater than 0')
    given = dict(_setting(one) for one in settings or ())
    try:
        plan = plan_texture(case, given, cells)
        if dry_run:
            print(text_table(_rows(plan)))
            forecast(plan.cells, engine)
            return
        folder = out or Path("runs") / f"{plan.case.name}-texture"
        # Equal runs of other sweeps are linked, not computed again.
        link_runs(plan.cells, folder / CELLS, share or [])
    except (NoTexture, OutputError) as error:
        raise WrongCommand(str(error)) from None

    # The command that would go on after a signal.
    own = engine.words()
    again = command_of("texture", case, *own, set=settings, cells=cells, out=folder, pixel=pixel)
    chosen = engine.engine()

    # Make the cells; a texture needs all of them.
    say_forecast(plan.cells.points(), engine, folder / CELLS, plan.cells.study)
    table = make(plan.cells, folder / CELLS, chosen, again)
    for row in table.rows:
        if row.status != "complete":
            print(f"lasersph: cell {row.run} {row.status}: {row.reason}", file=sys.stderr)
    tell_warnings(table)
    if not table.is_complete.all():
        raise OutputError(f"not all cells are complete, so no texture; go on with: {again}")

    # The relief from the cells, its numbers and its figure.
    try:
        content = finish_texture(plan, folder, table, size)
    except NoTexture as error:
        raise OutputError(str(error)) from None
    print(text_table([*_rows(plan), *_answer_rows(content)]))
    for note in content["notes"]:
        print(f"note: {note}")
    print(folder / FIGURE)


def _setting(text: str) -> tuple[str, Any]:
    """Key and value of a --set. Raises WrongCommand."""
    import tomllib

    # A value as TOML, else as text.
    key, sign, value = text.partition("=")
    if not sign:
        raise WrongCommand(f'--set: "{text}" has no "="; write e.g. laser.fluence=0.8J/cm2')
    try:
        return key.strip(), tomllib.loads(f"value = {value}")["value"]
    except tomllib.TOMLDecodeError:
        return key.strip(), value.strip()


def _rows(plan: TexturePlan) -> list[tuple[str, str]]:
    from lasersph.input import format_quantity

    spot = plan.spot
    moved = f", {format_quantity(plan.shift, 'm')} apart along x" if plan.pulses > 1 else ""
    return [
        ("spot", spot.shape),
        ("fluence at its center", f"{1e-4 * spot.center:.4g} J/cm^2, mean over a period"),
        ("period", format_quantity(plan.period, "m")),
        ("pulses", f"{plan.case.laser.pulse.count if plan.case.laser else 1}{moved}"),
    ]


def _answer_rows(content: dict[str, Any]) -> list[tuple[str, str]]:
    """The main numbers of texture.json."""
    from lasersph.input import format_quantity

    # Sizes, depths and speeds of the whole texture.
    areal, errors = content["areal_parameters"], content["interpolation_error"]
    sizes = ", ".join(f"{n} {format_quantity(areal[n], 'm')}" for n in ("Sa", "Sq", "Sz"))
    rows = [
        ("cells", str(len(content["cells"]["fluence_J_m2"]))),
        ("deepest point", format_quantity(content["depth_max_m"], "m")),
        ("highest point", format_quantity(content["rim_height_max_m"], "m")),
        ("depth of the melt", format_quantity(content["melt_depth_max_m"], "m")),
        ("largest speed", format_quantity(content["speed_max_m_s"], "m/s")),
        ("ISO 25178", f"{sizes}, Ssk {areal['Ssk']:.3g}, Sdr {areal['Sdr']:.3g}"),
    ]
    # Errors of the interpolation: each cell predicted from the others.
    for name, one in errors.items():
        shown = [format_quantity(one[k], one["unit"], 2) for k in ("largest", "rms")]
        share = 100.0 * one["largest"] / (one["largest_value"] or 1.0)
        words = f"{shown[0]} at most ({share:.2g} %), {shown[1]} rms, each cell from the others"
        rows.append((f"error of {name.replace('_', ' ')}", words))
    return rows
