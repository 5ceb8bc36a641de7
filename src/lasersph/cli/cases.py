"""`lasersph new`, `check`, `cases`, `schema`: cases before they run."""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING, Annotated

import typer

from lasersph.cli.arguments import (
    Backend,
    CaseName,
    Quick,
    Settings,
    Threads,
    refuse_backend,
    say_what_moved,
)
from lasersph.cli.failures import WrongCommand
from lasersph.cli.light import heating_rows, light_rows
from lasersph.input.text_table import text_table

if TYPE_CHECKING:
    from lasersph.case import Case
    from lasersph.simulation import Forecast

NewFile = Annotated[
    str | None, typer.Argument(metavar="FILE", help="The file to write; must be new.")
]
PlanKind = Annotated[
    str | None,
    typer.Option(
        "--plan",
        metavar="KIND",
        help="Write a plan for many runs of the case instead: sweep, calibrate, find.",
    ),
]


def new(case: CaseName, file: NewFile = None, plan: PlanKind = None) -> None:
    """Write a commented case file, or a plan for many runs, to start from."""
    if plan is not None:
        from lasersph.sweeps.new_plan import write_new_plan

        case, target = ("dlip-steel", case) if file is None else (case, file)
        path = write_new_plan(plan, case, target)
        trial = "" if plan == "find" else " --dry-run"
        print(f"wrote {path}: edit it, then lasersph {plan} {path}{trial}")
        return
    if file is None:
        raise WrongCommand("new wants a case and a file: lasersph new dlip-steel my-case.toml")
    from lasersph.case import write_new_case

    path = write_new_case(case, file)
    print(f"wrote {path}: edit it, then lasersph check {path} or lasersph run {path}")


def list_cases() -> None:
    """List the shipped cases."""
    from lasersph.case import available_cases
    from lasersph.input import read_toml

    rows = [(name, read_toml(path).data["title"]) for name, path in available_cases().items()]
    print(text_table(rows))


def schema() -> None:
    """Print the JSON Schema of case files."""
    import json

    from lasersph.case import Case

    print(json.dumps(Case.model_json_schema(), indent=2))


def check(
    case: CaseName,
    settings: Settings = None,
    quick: Quick = False,
    threads: Threads = None,
    backend: Backend = "cpu",
) -> None:
    """Say what a run would need, before anything runs: particles, memory, steps, warnings."""
    from lasersph.case import load_case
    from lasersph.compute.threads import chosen
    from lasersph.simulation.acceptance import accepted_forecast

    refuse_backend(backend, threads)
    loaded = load_case(case, settings or (), quick=quick)
    say_what_moved(loaded)
    count = chosen(threads)
    expected = accepted_forecast(loaded, backend, threads=count)
    print(text_table(_rows(loaded, expected, count, backend)))
    for warning in expected.warnings:
        print(f"warning: {warning}")
    print("the case is right" + ("; think about the warnings" if expected.warnings else ""))


def _rows(case: Case, expected: Forecast, threads: int, backend: str) -> list[tuple[str, str]]:
    from lasersph.case.size import in_words, memories
    from lasersph.input import format_duration, format_quantity
    from lasersph.materials.viscosity import viscosity_text

    there = [words.format(in_words(most)) for words, most in memories(backend) if isfinite(most)]
    time = f"roughly {format_duration(expected.wall_time)} on {threads} thread{'s' * (threads > 1)}"
    rows = [
        ("case", case.title or case.name),
        ("material", case.material.title or case.material.name),
        ("solver", f"{case.solver.kind}, {case.solver.dimensions}-D, {case.solver.scheme_text}"),
        *([] if case.laser is None else light_rows(case.laser)),
        *([] if expected.heating is None else heating_rows(case, expected.heating)),
        ("particles", f"{expected.particles} in {expected.layers} layers"),
        (
            "finest spacing",
            f"{format_quantity(expected.spacing, 'm')} in the top "
            f"{format_quantity(expected.fine_depth, 'm')}",
        ),
        ("memory", ", ".join([f"about {in_words(expected.memory)}", *there])),
    ]
    for name, limit in sorted(expected.limits.items(), key=lambda item: item[1]):
        binds = "  <- binding" if name == expected.binding else ""
        shown = format_quantity(limit, "s") if isfinite(limit) else "none"
        rows.append((f"step limit: {name}", shown + binds))
    if loss := _losses(case):
        rows.append(("surface loses heat", loss))
    rows.append(("steps", f"about {expected.steps} to {format_quantity(case.time.end, 's')}"))
    rows.append(("time", time if backend == "cpu" else "not estimated for a graphics card"))
    if expected.flow is not None:
        rows.append(("viscosity of the melt", viscosity_text(case.material)))
        rows.append(("expected speed", f"up to about {expected.flow.speed:.2g} m/s"))
    for name, length in (
        ("moving layer", expected.flow.layer if expected.flow else None),
        ("absorption length", expected.absorption_length),
        ("thermal penetration", expected.penetration),
    ):
        if length:
            cells = f"{length / expected.spacing:.2g} spacings"
            rows.append((name, f"{format_quantity(length, 'm')}, {cells}"))
    return rows


def _losses(case: Case) -> str:
    """What the surface loses to the surroundings, and who says so; empty where nothing."""
    from lasersph.input import format_quantity

    boundaries = case.boundaries
    losses = boundaries.surroundings(case.material, case.initial_temperature)
    owner = "as given" if boundaries.emissivity is not None else f"of {case.material.name}"
    parts = []
    if losses["eps"]:
        parts.append(f"radiation, emissivity {losses['eps']:g} {owner}")
    if losses["h_c"]:
        parts.append(f"convection, {format_quantity(losses['h_c'], 'W/(m^2 K)')}")
    return f"{'; '.join(parts)}; to {format_quantity(losses['T_a'], 'K')}" if parts else ""
