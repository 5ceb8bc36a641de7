"""`lasersph run`: compute a case into a run folder, then draw its figures and its report."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from lasersph.cli.arguments import (
    Anyway,
    Backend,
    CaseName,
    Out,
    Overwrite,
    Quick,
    Resume,
    Settings,
    Threads,
    refuse_backend,
    say_what_moved,
)
from lasersph.cli.drawing import begin_before_end, drawing_processes, say
from lasersph.cli.engine_options import EngineOptions, Workers
from lasersph.cli.failures import StoppedBySignal, WrongCommand
from lasersph.cli.same_command import command_of
from lasersph.cli.side_by_side import preparation, refuse_workers
from lasersph.cli.stop_signals import StopSignals

if TYPE_CHECKING:
    from lasersph.case import Case
    from lasersph.cli.progress import WarningsOnce
    from lasersph.plots.drawing_processes import DrawingProcesses
    from lasersph.simulation import Result, RunProgress
    from lasersph.studies import Input

RUNS = Path("runs")
REPORT = "report.html"
Precision = Annotated[
    Literal["float64", "float32"], typer.Option("--precision", help="Of the computation.")
]
Uncertainty = Annotated[
    bool,
    typer.Option(
        "--uncertainty",
        help="Run two coarser companions, and two for each input with an uncertainty: every number "
        "then has an error.",
    ),
]
Uncertain = Annotated[
    list[str] | None,
    typer.Option(
        "--uncertain",
        metavar="KEY=U",
        help="Standard uncertainty of an input, for --uncertainty: laser.fluence=5%, "
        "material.conductivity=10%.",
    ),
]
Figures = Annotated[bool, typer.Option(help="Draw the figures and write report.html at the end.")]


UntilStdinCloses = Annotated[
    bool,
    typer.Option(
        "--until-stdin-closes",
        hidden=True,
        help="For programs that start runs: stop with a checkpoint when standard input ends, as it "
        "does when the program that holds its other end dies, and wait for a folder in use.",
    ),
]
LONGEST_WAIT = 120.0
"""How long a run that another program starts waits for a process that still writes its last
checkpoint into the folder [s]: twice `output.folder_lock.SILENCE`."""


def run(
    case: CaseName,
    out: Out = None,
    settings: Settings = None,
    resume: Resume = False,
    overwrite: Overwrite = False,
    quick: Quick = False,
    threads: Threads = None,
    precision: Precision = "float64",
    backend: Backend = "cpu",
    uncertainty: Uncertainty = False,
    uncertain: Uncertain = None,
    workers: Workers = None,
    figures: Figures = True,
    anyway: Anyway = False,
    until_stdin_closes: UntilStdinCloses = False,
) -> None:
    """Compute a case; the run folder then holds history, summary, particles, figures, report."""
    from lasersph.case import load_case
    from lasersph.cli.progress import WarningsOnce
    from lasersph.output.run_folder import is_untouched
    from lasersph.simulation.acceptance import refuse_unresolved
    from lasersph.simulation.recipes import recipe_of

    # Refuse all that is wrong before anything is written.
    refuse_backend(backend, threads)
    loaded = load_case(case, settings or (), quick=quick)
    say_what_moved(loaded)
    if resume and overwrite:
        raise WrongCommand(
            "--resume goes on with the run in DIR, --overwrite replaces it: give one"
        )
    engine = EngineOptions(workers, threads)
    if engine.at_once > 1 and not uncertainty:
        raise WrongCommand(
            "--workers is for the companions of --uncertainty; one run has --threads"
        )
    refuse_workers(engine, backend, precision)

    # Too coarse for its flow: --quick is known to be, --anyway says that it may, and a run that
    # goes on has begun so.
    folder = out or (Path(case) if resume and Path(case).is_dir() else RUNS / loaded.name)
    goes_on = resume and not is_untouched(folder)
    if not (quick or anyway or goes_on):
        refuse_unresolved(recipe_of(loaded).flow)

    # Inputs of --uncertain, and the command that would go on after a signal.
    inputs = _uncertain_inputs(loaded, uncertain or (), wanted=uncertainty)
    again = command_of(
        *("run", case),
        out=folder,
        resume=True,
        set=settings,
        quick=quick,
        precision=precision if precision != "float64" else None,
        backend=backend if backend != "cpu" else None,
        uncertainty=uncertainty,
        uncertain=uncertain,
        workers=workers if engine.at_once > 1 else None,
        anyway=anyway,
    )

    # Options of every run of this command.
    options = {"threads": threads, "precision": precision, "backend": backend, "anyway": anyway}
    options |= {"wait": LONGEST_WAIT if until_stdin_closes else 0.0}
    warnings = WarningsOnce()

    # Companions of --uncertainty lie below the run and always go on where they stopped.
    def make(case: Case, path: Path) -> Result:
        is_own = path == folder
        with StopSignals(until_stdin_closes=until_stdin_closes) as signals:
            # companions lie in our own folder
            given = {**options, "resume": resume or not is_own, "overwrite": overwrite and is_own}
            drawing = None if uncertainty else others  # no process waits for all companions
            return _compute(case, path, signals, warnings, again, given, drawing)

    # One run, or a run with its companions, whose report several processes draw.
    with drawing_processes(threads) if figures else nullcontext() as others:
        if uncertainty:
            from lasersph.cli.costs import say_cost
            from lasersph.studies import assess_uncertainty
            from lasersph.studies.uncertainty import runs_of_assessment

            say_cost(runs_of_assessment(loaded, inputs), engine, backend, folder)
            prepare = preparation(engine, again)
            assess_uncertainty(loaded, folder, inputs=inputs, run=make, prepare=prepare, report=say)
        else:
            make(loaded, folder)
            # Nothing was computed, and its report shows all of it.
            if resume and figures and _is_reported(folder):
                print(f"{folder}: complete already; open {folder / REPORT} in a browser")
                return
        _tell(folder)
        if others is not None:
            _draw(folder, others)


def _uncertain_inputs(case: Case, given: Sequence[str], *, wanted: bool) -> list[Input]:
    """The inputs of --uncertain, refused before anything is written."""
    if not given:
        return []
    from lasersph.input import QuantityError
    from lasersph.studies import read_input

    # An uncertain input needs companions that change it.
    if not wanted:
        raise WrongCommand("--uncertain says how uncertain an input is: add --uncertainty")
    try:
        return [read_input(case, text) for text in given]
    except QuantityError as error:
        raise WrongCommand(f"--uncertain: {error}") from None


def _compute(
    case: Case,
    folder: Path,
    signals: StopSignals,
    warnings: WarningsOnce,
    again: str,
    options: dict[str, Any],
    others: DrawingProcesses | None,
) -> Result:
    """Run with progress; a signal ends it with a checkpoint and the way to go on.

    Args:
        again: the command that goes on. options: of the run. others: draw its figures.
    """
    from lasersph import simulation
    from lasersph.cli.progress import USUAL_LOOPS, RunDisplay
    from lasersph.compute.compiling import Compiling
    from lasersph.simulation.known_loops import known_loops
    from lasersph.simulation.time_loop import Stopped

    # Loops are compiled on the way; a signal stops the run between two steps.
    with RunDisplay(known_loops(case) or USUAL_LOOPS) as progress:

        def show(status: RunProgress) -> None:
            progress(status)
            if others is not None:
                begin_before_end(others, status)

        try:
            with Compiling(progress.compiling, progress.compiled) as compiling:
                result = simulation.run(
                    case,
                    folder,
                    progress=show,
                    warn=lambda text: warnings.show(text, progress.say),
                    should_stop=signals.asked,
                    **options,
                )
        except Stopped as stopped:
            raise StoppedBySignal(f"{stopped}; continue with: {again}", signals.code) from None
    if compiling.loops:
        print(
            f"compiled {compiling.loops} loops, which later runs find, in {compiling.seconds:.0f} s"
        )
    return result


def _tell(folder: Path) -> None:
    """The main numbers of a finished run."""
    from lasersph.input.text_table import text_table
    from lasersph.output import open_run
    from lasersph.report.tables import summary_rows

    found = open_run(folder)
    print(text_table(summary_rows(found.summary, found.uncertainty)))
    print(f"{folder}: complete")


def _is_reported(folder: Path) -> bool:
    """Whether the report of a complete run was written after its numbers."""
    report, summary = folder / REPORT, folder / "summary.json"
    return report.exists() and report.stat().st_mtime_ns >= summary.stat().st_mtime_ns


def _draw(folder: Path, others: DrawingProcesses) -> None:
    """Draw figures and report; their time grows with the particles and frames."""
    from lasersph.cli.progress import Drawn, ProgressDisplay
    from lasersph.report import write_report

    say("drawing figures and report")
    with ProgressDisplay[Drawn](lambda one: f"drawing {one.name}") as display:
        # Elsewhere than on a terminal one line for all figures is enough.
        def show(name: str, count: int, total: int) -> None:
            if display.is_terminal:
                display(Drawn(count, total, name))

        path = write_report(folder, begun=show, others=others)
    print(f"open {path} in a browser")
