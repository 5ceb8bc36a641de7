"""The verbs of the command line: help of all of them, and each as a command of its own.

A verb's module is imported when the verb is given, so that help answers at once.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import typer

VERBS = {
    "Cases": {
        "new": (
            "cases.new",
            "Write a commented case file, or a plan for many runs, to start from.",
        ),
        "check": (
            "cases.check",
            "Say what a run would need, before anything runs: particles, memory, steps, warnings.",
        ),
        "cases": ("cases.list_cases", "List the shipped cases."),
        "schema": ("cases.schema", "Print the JSON Schema of case files."),
        "material": ("material.app", "List, show and check materials."),
    },
    "Runs": {
        "run": (
            "running.run",
            "Compute a case; the run folder then holds history, summary, particles, figures, "
            "report.",
        ),
        "info": (
            "results.info",
            "Show what a run folder holds: the case, how far it is, the main numbers.",
        ),
        "plot": (
            "results.plot",
            "Draw the figures of a run into DIR/figures, or an animation or a 3-D scene of it.",
        ),
        "report": (
            "results.report",
            "Write DIR/report.html: viewer, figures and numbers on one self-contained page.",
        ),
        "serve": (
            "serving.serve",
            "Show the runs and sweeps of a folder as a page in a browser: live curves, particles, "
            "maps.",
        ),
        "compare": (
            "measured.compare",
            "Say how a run or texture differs from a measured profile or height map, or a run.",
        ),
        "export": (
            "results.export",
            "Write the surface of a crater or a relief as CSV, STL, PLY, X3P or SDF.",
        ),
    },
    "Many runs": {
        "sweep": (
            "sweeping.sweep",
            "Run a case with many settings by a plan; the same command again goes on.",
        ),
        "texture": (
            "texturing.texture",
            "Compute the relief that a pulse leaves in its whole spot, from cells of the pattern.",
        ),
        "converge": (
            "studies.converge",
            "Run a case at several spacings: order and uncertainty of every number of its summary.",
        ),
        "threshold": (
            "studies.threshold",
            "Find the fluence at which melting, boiling or ablation begins, by bisection.",
        ),
        "spot": (
            "studies.spot",
            "Ablate with a Gaussian spot at several fluences: threshold from D^2 over ln F, "
            "efficiency.",
        ),
        "map": (
            "maps.draw_map",
            "Draw a number of a sweep over its keys, with the lines of melting, boiling and "
            "ablation.",
        ),
        "sensitivity": (
            "maps.sensitivity",
            "Tell how much each key of a sweep changes a number: Sobol indices, or effects of "
            "Morris.",
        ),
        "calibrate": (
            "calibrating.calibrate",
            "Find unknowns of a case from measured values, with their bands and what limits them.",
        ),
        "find": (
            "calibrating.find",
            "Find settings of a sweep that reach wanted values inside limits, and how probably.",
        ),
        "validate": (
            "validating.validate",
            "Compute published cases; print published, reference and computed numbers with "
            "verdicts.",
        ),
    },
    "Program": {
        "cache": ("cache.cache", "Show, fill or clear the cache of compiled loops."),
    },
}
"""Verbs by heading, each with module and function below `lasersph.cli` and its summary.

The summaries are the first lines of the functions' docstrings, which a test compares.
"""
HELP = {"help_option_names": ["-h", "--help"]}
"""Options that ask for the help of a verb, as typer names them."""
OPTIONS = {
    "--version": "Print the version.",
    "--install-completion": "Complete verbs and options in your shell with the Tab key.",
    "--debug": "Show the whole traceback of a failure.",
    "--help": "Show this; lasersph VERB --help explains a verb.",
}


def top_help() -> str:
    """Text of `lasersph --help`."""
    lines = [
        "Usage: lasersph VERB ...",
        "",
        "Simulate what a laser pulse does to metal, with smoothed particle hydrodynamics.",
        "Start with: lasersph run dlip-steel",
    ]
    # A section a heading, with the options of the program itself at the end.
    sections = {
        heading: {name: summary for name, (_, summary) in verbs.items()}
        for heading, verbs in VERBS.items()
    }
    for heading, entries in (sections | {"Options": OPTIONS}).items():
        width = max(map(len, entries))
        lines += ["", heading, *(f"  {name:<{width}} {text}" for name, text in entries.items())]
    return "\n".join(lines)


def command_of(verb: str) -> Callable[[Sequence[str]], object]:
    """The function that runs a verb on its arguments.

    Raises:
        KeyError: there is no such verb.
    """
    app = app_of(verb)

    def command(arguments: Sequence[str]) -> object:
        return app(list(arguments), prog_name=f"lasersph {verb}", standalone_mode=False)

    return command


FIRST_TAB = '_lasersph_completion "$@"'
"""Call for zsh, whose first Tab did nothing: typer's file only defines the function."""


def complete_in_shell(arguments: Sequence[str]) -> object:
    """Install or answer the completion of verbs and options, which needs all verbs at once."""
    import typer

    # One application of all verbs: a verb of one command is a command, others keep their own.
    whole = typer.Typer()
    for name in (name for verbs in VERBS.values() for name in verbs):
        app = app_of(name)
        commands = [one.callback for one in app.registered_commands if one.callback is not None]
        if len(commands) == 1:
            whole.command(name)(commands[0])
        else:
            whole.add_typer(app, name=name)
    try:
        return whole(list(arguments), prog_name="lasersph", standalone_mode=False)
    finally:  # typer leaves the program once it has written
        # The first Tab after the installation would only define the function in zsh.
        zsh = Path("~/.zfunc/_lasersph").expanduser()
        is_new = "--install-completion" in arguments and zsh.is_file()
        if is_new and FIRST_TAB not in zsh.read_text(encoding="utf-8"):
            with zsh.open("a", encoding="utf-8") as file:
                file.write(f"\n\n{FIRST_TAB}\n")


def app_of(verb: str) -> typer.Typer:
    """The typer application of one verb.

    Raises:
        KeyError: there is no such verb.
    """
    places = {name: place for verbs in VERBS.values() for name, (place, _) in verbs.items()}
    module, _, name = places[verb].partition(".")
    import typer

    # A module may have several commands under its verb; any other function is the verb itself.
    target = getattr(import_module(f"lasersph.cli.{module}"), name)
    if isinstance(target, typer.Typer):
        return target
    app = typer.Typer(add_completion=False, context_settings=HELP)
    app.command(verb)(target)
    return app
