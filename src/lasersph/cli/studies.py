"""`lasersph converge`, `threshold` and `spot`: many runs for one answer."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from lasersph.cli.arguments import (
    Backend,
    CaseName,
    Out,
    Quick,
    Resume,
    Settings,
    read_quantities,
    refuse_backend,
)
from lasersph.cli.engine_options import EngineOptions, takes_engine
from lasersph.cli.failures import StoppedBySignal, WrongCommand
from lasersph.cli.side_by_side import preparation, refuse_workers
from lasersph.cli.stop_signals import StopSignals
from lasersph.input.text_table import text_table

if TYPE_CHECKING:
    from lasersph.lasers import Laser
    from lasersph.studies.fluence_threshold import Threshold

Spacings = Annotated[
    str, typer.Option("--spacing", metavar="A,B,C", help="Three or more, e.g. 32nm,16nm,8nm.")
]
Of = Annotated[
    Literal["melt", "vaporize", "ablate", "explode"],
    typer.Option(
        "--of",
        help="Completely molten somewhere, the boiling point reached, matter ejected, or 0.9 of "
        "the critical temperature reached.",
    ),
]
Tolerance = Annotated[
    float,
    typer.Option(
        "--tolerance", min=1e-6, max=0.5, help="Half-width of the bracket over its middle."
    ),
]
Fluences = Annotated[
    str,
    typer.Option(
        "--fluence", metavar="A,B,...", help="Peak fluences, e.g. 5J/cm2,10J/cm2,20J/cm2."
    ),
]
FLUENCES = {"mean": ", mean over a period,", "peak": ", peak,"}
"""Words after a fluence, by `laser.fluence_kind`."""
AGAIN = "the same command and --resume"
Json = Annotated[
    Path | None, typer.Option("--json", metavar="FILE", help="Write the answer as JSON as well.")
]


@takes_engine
def converge(
    case: CaseName,
    engine: EngineOptions,
    spacing: Spacings,
    out: Out = None,
    settings: Settings = None,
    resume: Resume = False,
    backend: Backend = "cpu",
    json_file: Json = None,
) -> None:
    """Run a case at several spacings: order and uncertainty of every number of its summary."""
    from lasersph import studies
    from lasersph.case import load_case
    from lasersph.cli.costs import say_cost
    from lasersph.output.study_mark import StudyMark
    from lasersph.studies.variation import changed

    # Read and refuse before anything is written.
    options = _options(engine, backend)
    wanted = read_quantities("--spacing", spacing, "length")
    if len(set(wanted)) < 3:
        raise WrongCommand("--spacing: an order needs three different spacings, e.g. 32nm,16nm,8nm")
    loaded = load_case(case, settings or ())
    _refuse_missing_folder(json_file)
    # Say the cost, mark the folder, compute.
    folder = _folder(out or Path("runs") / f"{loaded.name}-converge", resume)
    cases = [changed(loaded, "particles.spacing", one) for one in sorted(set(wanted))]
    say_cost(cases, engine, backend, folder)
    title = f"{loaded.name} at several spacings"
    StudyMark("converge", title, "particles.spacing", "m").write(folder)
    found = studies.converge(loaded, wanted, folder, **options)
    print(text_table(*found.table()))
    _write(json_file, found.as_dict())


@takes_engine
def threshold(
    case: CaseName,
    engine: EngineOptions,
    of: Of,
    out: Out = None,
    settings: Settings = None,
    resume: Resume = False,
    quick: Quick = False,
    backend: Backend = "cpu",
    tolerance: Tolerance = 0.01,
    json_file: Json = None,
) -> None:
    """Find the fluence at which melting, boiling or ablation begins, by bisection."""
    from dataclasses import asdict, replace

    from lasersph import studies
    from lasersph.case import load_case
    from lasersph.cli.costs import say_cost
    from lasersph.input import KINDS, in_field_units
    from lasersph.lasers.laser_keys import AMOUNTS
    from lasersph.output.study_mark import StudyMark
    from lasersph.studies.fluence_threshold import usual_runs
    from lasersph.sweeps.points import find_key

    # The case must have light and the phase change that is asked for.
    options = _options(engine, backend)
    loaded = load_case(case, settings or (), quick=quick)
    if loaded.laser is None:
        raise WrongCommand(f"{loaded.name} has no laser, so no threshold")
    if of == "ablate" and "ejection" not in type(loaded.solver).model_fields:
        raise WrongCommand(f'{loaded.name} ablates nothing: its solver is "{loaded.solver.kind}"')
    section = loaded.material.melting if of == "melt" else loaded.material.vaporization
    if section is None or not (loaded.solver.phase_change or of == "ablate"):
        raise WrongCommand(f"{loaded.name} computes no phase change to {of}, so no threshold")

    if of == "explode" and getattr(loaded.solver, "plateau", "") != "evaporate":
        raise WrongCommand(
            "the boiling point is held, so that nothing explodes; add "
            "--set solver.plateau=evaporate"
        )

    # Say the cost: bisection needs about as many runs as halvings.
    _refuse_missing_folder(json_file)
    folder = _folder(out or Path("runs") / f"{loaded.name}-threshold", resume)
    runs = usual_runs(tolerance) * [loaded]
    more = " or more, where the threshold is further than twice or half the energy of the case"
    quicker = "" if quick else "--quick makes coarser ones, in less time"
    say_cost(runs, engine, backend, folder, more=more, instead=quicker)

    # The key that the case itself gives its light by.
    key = next(f"laser.{name}" for name in AMOUNTS if getattr(loaded.laser, name) is not None)
    unit = KINDS[find_key(loaded, key)[1]].unit
    mark = StudyMark("threshold", f"threshold of {loaded.name} to {of}", key, unit)
    mark.write(folder)

    # Bisect, and put the answer into the title of the folder.
    found = studies.threshold(
        loaded, of, folder, tolerance=tolerance, at_once=engine.at_once, **options
    )
    kind = FLUENCES.get(loaded.laser.fluence_kind or "", "") * (key == "laser.fluence")
    answer = in_field_units(found.value, unit, found.tolerance * found.value)
    replace(mark, title=f"{mark.title}: {answer}{kind.rstrip(',')}").write(folder)
    print(_answer(found, loaded.laser))
    print(f"runs of all fluences: {folder}")
    _write(json_file, asdict(found))


@takes_engine
def spot(
    case: CaseName,
    engine: EngineOptions,
    fluence: Fluences,
    out: Out = None,
    settings: Settings = None,
    resume: Resume = False,
    quick: Quick = False,
    backend: Backend = "cpu",
    json_file: Json = None,
) -> None:
    """Ablate with a Gaussian spot at several fluences: threshold from D^2 over ln F, efficiency."""
    from lasersph import studies
    from lasersph.case import load_case
    from lasersph.cli.costs import say_cost
    from lasersph.output.study_mark import StudyMark
    from lasersph.plots import style
    from lasersph.plots.spot_threshold import spot_threshold_figure
    from lasersph.studies.variation import changed

    # The case must have a Gaussian spot whose craters can be measured.
    options = _options(engine, backend)
    wanted = read_quantities("--fluence", fluence, "fluence")
    loaded = load_case(case, settings or (), quick=quick)
    if reason := studies.no_spot(loaded, wanted):
        raise WrongCommand(f"{loaded.name}: {reason}")
    # Say the cost, mark the folder, compute, draw.
    folder = _folder(out or Path("runs") / f"{loaded.name}-spot", resume)
    cases = [changed(loaded, "laser.fluence", one) for one in sorted(set(wanted))]
    say_cost(cases, engine, backend, folder)
    title = f"spots of {loaded.name} at several fluences"
    StudyMark("spot", title, "laser.fluence", "J/m^2").write(folder)
    found = studies.spot_threshold(loaded, wanted, folder, **options)
    print(text_table(*found.table()))
    print(found.answer())
    _write(json_file, found.as_dict())
    print(style.save(spot_threshold_figure(found.as_dict()), folder / "spot-threshold.png"))


def _answer(found: Threshold, laser: Laser) -> str:
    from lasersph.studies import show_energy

    below, above = (show_energy(found.key, value) for value in (found.below, found.above))
    kind = FLUENCES.get(laser.fluence_kind or "", "") if laser.fluence is not None else ""
    return (
        f"{found.key} = {show_energy(found.key, found.value, 4)}{kind} +- "
        f"{100 * found.tolerance:.2g} % to {found.of} (between {below} and {above})"
    )


def _folder(folder: Path, resume: bool) -> Path:
    """Refuse a folder that holds files, as a run does, unless its study goes on."""
    if folder.exists() and (not folder.is_dir() or (not resume and any(folder.iterdir()))):
        raise WrongCommand(
            f"{folder} is not empty: choose another folder with --out, or go on with --resume"
        )
    return folder


def _refuse_missing_folder(file: Path | None) -> None:
    """Refuse an answer that could not be written after hours of runs."""
    if file is not None and not file.absolute().parent.is_dir():
        raise WrongCommand(f"--json: there is no folder {file.parent}")


def _options(engine: EngineOptions, backend: str) -> dict[str, Any]:
    """How a study makes its runs, and where it says so. Raises WrongCommand, NoDevice."""
    refuse_backend(backend, engine.threads)
    refuse_workers(engine, backend)
    prepare = preparation(engine, AGAIN)
    return {"run": _runner(engine.threads, backend), "prepare": prepare, "report": _report}


def _runner(threads: int | None, backend: str) -> Any:
    from lasersph.cli.progress import WarningsOnce
    from lasersph.simulation import Stopped, run

    warnings = WarningsOnce()

    def make(case: Any, folder: Path) -> Any:
        # A study compares numbers: no run of it may have changed since.
        options = {"resume": True, "same_case": True, "threads": threads, "backend": backend}
        options |= {"warn": lambda text: warnings.show(text, _report)}
        with StopSignals() as signals:
            try:
                return run(case, folder, should_stop=signals.asked, **options)
            except Stopped as stopped:
                raise StoppedBySignal(f"{stopped}; continue with {AGAIN}", signals.code) from None

    return make


def _report(line: str) -> None:
    print(line, file=sys.stderr, flush=True)


def _write(file: Path | None, content: dict[str, Any]) -> None:
    from lasersph.output.atomic import replace_json

    if file is not None:
        replace_json(file, content)
