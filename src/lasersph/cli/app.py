"""All verbs of the command line."""

from __future__ import annotations

from typing import Annotated

import typer

from lasersph.cli import (
    cache,
    cases,
    exporting,
    material,
    results,
    running,
    studies,
    validating,
)

app = typer.Typer(
    name="lasersph",
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)

app.command(rich_help_panel="Cases")(cases.new)
app.command(rich_help_panel="Cases")(cases.check)
app.command("cases", rich_help_panel="Cases")(cases.list_cases)
app.command(rich_help_panel="Cases")(cases.schema)
app.add_typer(material.app, name="material", rich_help_panel="Cases")
app.command(rich_help_panel="Runs")(running.run)
app.command(rich_help_panel="Runs")(results.info)
app.command(rich_help_panel="Runs")(results.plot)
app.command(rich_help_panel="Runs")(results.report)
app.command(rich_help_panel="Runs")(exporting.export)
app.command(rich_help_panel="Many runs")(studies.converge)
app.command(rich_help_panel="Many runs")(studies.threshold)
app.command(rich_help_panel="Many runs")(studies.spot)
app.command(rich_help_panel="Many runs")(validating.validate)
app.command("cache", rich_help_panel="Program")(cache.cache)


@app.callback()
def program(
    version: Annotated[
        bool, typer.Option("--version", is_eager=True, callback=lambda value: _version(value))
    ] = False,
    debug: Annotated[
        bool, typer.Option("--debug", help="Show the whole traceback of a failure.")
    ] = False,
) -> None:
    """Simulate what a laser pulse does to metal, with smoothed particle hydrodynamics.

    Start with: lasersph run dlip-steel
    """


def _version(wanted: bool) -> None:
    if wanted:
        import lasersph

        print(f"lasersph {lasersph.__version__}")
        raise typer.Exit
