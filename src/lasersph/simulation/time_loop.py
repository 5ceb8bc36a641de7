"""The time loop, and the run folder around it.

limits -> step -> observers -> history -> snapshots -> checkpoint, until the end of the case.
No decision reads the clock, so that a run resumed from a checkpoint repeats the same numbers.
"""

from __future__ import annotations

import time as clock
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from lasersph import compute
from lasersph.case import Case
from lasersph.input import format_quantity
from lasersph.input.text_table import text_table
from lasersph.observers import Observer, Observers, numerical_sd
from lasersph.observers.declared import KEY as OWN_OBSERVERS
from lasersph.observers.declared import declarations
from lasersph.observers.run_warnings import event_warnings, found_warnings
from lasersph.observers.snapshots import UNITS, snapshot_fields
from lasersph.observers.view import View
from lasersph.output import RunFolder
from lasersph.output.checkpoint import Checkpoint
from lasersph.output.history import read_events
from lasersph.output.settings import SnapshotSchedule
from lasersph.simulation.acceptance import accepted_forecast
from lasersph.simulation.forecast import spans_of
from lasersph.simulation.known_loops import compiling_ahead
from lasersph.simulation.progress import ProgressLines, RemainingTime, RunProgress
from lasersph.simulation.recipes import Recipe, recipe_of
from lasersph.simulation.run_origin import keep_layers, origin_of
from lasersph.simulation.surface_output import append_surface, write_relief
from lasersph.solvers.step_control import PAUSE, Solver, StepFailed, choose_step

END_SHARE = 1.0 - 1e-12
"""Share of the end of a run from which it has been reached. Rounding: of sums of steps."""


Progress = Callable[[RunProgress], None]
"""Called after each step."""
Warn = Callable[[str], None]
"""Called with each warning."""


@dataclass(frozen=True)
class Result:
    """A run at its end: its folder and the numbers of summary.json; printed, the main ones."""

    folder: Path
    summary: dict[str, Any] = field(repr=False)

    def __str__(self) -> str:
        """The main numbers as a table, warnings, and the folder."""
        from lasersph.report.tables import summary_rows

        notes = [f"warning: {text}" for text in self.summary.get("warnings", ())]
        return "\n".join(
            [text_table(summary_rows(self.summary)), *notes, f"{self.folder}: complete"]
        )


class Stopped(Exception):
    """The run was asked to stop; its checkpoint is written."""


class RunWarning(UserWarning):
    """Read it before the numbers of a run are used."""


def run(
    case: Case,
    out: str | Path,
    *,
    resume: bool = False,
    same_case: bool = False,
    overwrite: bool = False,
    wait: float = 0.0,
    threads: int | None = None,
    precision: str = "float64",
    backend: str = "cpu",
    recipe: type[Recipe[Any, Any]] | None = None,
    observers: Sequence[Observer] = (),
    progress: Progress | bool = False,
    warn: Warn | bool = True,
    anyway: bool = False,
    should_stop: Callable[[], bool] | None = None,
) -> Result:
    """Compute a case into a run folder.

        result = lasersph.run(lasersph.load_case("dlip-steel"), "runs/steel", progress=True)
        print(result)  # the main numbers, as `lasersph run`; all of them: result.summary

    Args:
        out: folder of the run; must be new or empty unless `resume` or `overwrite`.
        resume: continue from the last checkpoint in `out`; from the start where there is none. The
            case may have a later end, and write its output at other times: a run that is complete
            then goes on from its end.
        same_case: refuse to resume with any change, for runs whose numbers are compared.
        overwrite: replace the run that `out` holds, once the case is found right.
        wait: how long another process that computes in `out` may take to leave it [s].
        threads: None takes all processors.
        precision: "float64" or "float32".
        backend: "cpu", or "cuda" for a graphics card. Either continues what the other began.
        recipe: a class of one's own in place of that of the case's solver, with terms, boundaries
            or a solver of one's own.
        observers: of one's own, beside those of the recipe.
        progress: True prints ten lines on standard error, with the time that is left; a function
            is called with a `RunProgress` after each step.
        warn: True shows warnings as Python does, each a `RunWarning`, False leaves them to run.log
            and the summary; a function is called with the text of each.
        anyway: start what needs more memory than there is; a warning says so.
        should_stop: asked after each step; True writes a checkpoint and raises `Stopped`.

    Raises:
        CaseError: too large for this machine or its card.
        ValueError: two observers with the same column; both `resume` and `overwrite`.
        FolderRefused, OutputError: see `output`.
        NoDevice: no graphics card for backend "cuda".
        StepFailed: a step does not converge however small; the last checkpoint is kept.
    """
    # Refuse what cannot be right before anything is written.
    if resume and overwrite:
        raise ValueError("a run is resumed or overwritten, not both")
    Observers(observers)  # refuses them before anything is written
    device = compute.cuda(precision) if backend == "cuda" else compute.cpu(threads, precision)

    # A recipe of one's own gives other numbers: its name goes into the hash.
    chosen = recipe_of(case) if recipe is None else recipe(case)
    own = "" if recipe is None else f"-{recipe.__name__}"
    origin = origin_of(case, precision + own)
    if same_case:
        origin = replace(origin, changeable=())

    # A complete run of this very case needs no forecast and no solver.
    if resume and (done := RunFolder.complete(out, origin)) is not None:
        _say_each(done.summary.get("warnings", ()), warn)
        return Result(done.path, done.summary)
    expected = accepted_forecast(case, backend, recipe=chosen, anyway=anyway).warnings
    if resume:
        folder, checkpoint = RunFolder.resume(out, origin, wait=wait)
    else:
        folder = RunFolder.create(out, origin, overwrite=overwrite, wait=wait)
        checkpoint = None

    # From here on the folder is locked.
    try:
        if folder.is_complete:  # by the process that was waited for
            _say_each(folder.summary.get("warnings", ()), warn)
            return Result(folder.path, folder.summary)
        expected = (*expected, *keep_layers(chosen, folder))
        _say_each(expected, warn)
        with compiling_ahead(case):
            loop = _Loop(case, chosen, chosen.build(device), folder, observers)
            loop.begin(checkpoint, expected)
            loop.go(ProgressLines() if progress is True else progress or None, should_stop)
        summary = loop.finish()
        _say_each((text for text in summary["warnings"] if text not in expected), warn)
        return Result(folder.path, summary)
    finally:
        folder.close()


def _say_each(texts: Iterable[str], warn: Warn | bool) -> None:
    """Hand on warnings to who shows them: Python's own way, a function, or nobody."""
    for text in texts:
        if warn is True:
            # shown at the line that calls `run`
            warnings.warn(text, RunWarning, stacklevel=3)
        elif warn:
            warn(text)


class _Loop:
    """One run from its first or resumed step to its end."""

    def __init__(
        self,
        case: Case,
        recipe: Recipe[Any, Any],
        solver: Solver,
        folder: RunFolder,
        observers: Sequence[Observer],
    ) -> None:
        self.case = case
        self.recipe = recipe
        self.solver = solver
        self.folder = folder
        self._backend = solver.backend
        members = recipe.observers(tuple(solver.iterations)).members
        self.observers = Observers([*members, *observers])
        self.snapshots = SnapshotSchedule(case.output.snapshots, case.end_of_pulse)
        self.steps = 0
        self.limit = ""
        self.wall_before = 0.0
        self.started = clock.monotonic()
        self._remaining: RemainingTime | None = None

    def begin(self, checkpoint: Checkpoint | None, expected: Sequence[str]) -> None:
        """Start at rest, or where the checkpoint left off; note the warnings of the forecast."""
        # A new run observes its first state before any step.
        if checkpoint is None:
            self.folder.log(f"{self.case.name}: {self.solver.particle_count} particles")
            self.folder.events.append("started", time=0.0, step=0, backend=self._backend.name)
            self._warn(expected, 0.0)
            self._observe()
            return
        # A resumed one has observed it already.
        scalars = checkpoint.scalars
        self.steps, self.limit = checkpoint.step, scalars["limit"]
        self.wall_before = scalars["wall_time"]
        self.solver.restore(dict(checkpoint.arrays), scalars["solver"])
        self.observers.restore(scalars["observers"])
        self.snapshots.restore(scalars["snapshots"], checkpoint.time)
        self.folder.log(f"resumed at step {self.steps}, {format_quantity(checkpoint.time, 's')}")
        self.folder.events.append(
            "resumed", time=checkpoint.time, step=self.steps, backend=self._backend.name
        )
        self._warn(expected, checkpoint.time)

    def _warn(self, expected: Sequence[str], time: float) -> None:
        """Note the warnings that the folder does not hold yet; `time` in seconds."""
        known = event_warnings(read_events(self.folder.events.path))
        for text in expected:
            if text not in known:
                self.folder.warn(text, time, self.steps)

    def go(self, progress: Progress | None, should_stop: Callable[[], bool] | None) -> None:
        """Step until the end of the case."""
        state, end = self.solver.state, self.case.time.end
        while state.time < end * END_SHARE and not self.solver.is_steady:
            # 1. Limits: of the solver, and the next snapshot; before a pause the last state is
            # shown.
            limits = self.solver.time_step_limits()
            if PAUSE in limits:
                self._snapshot(self._view())
            else:
                until = max(self.snapshots.next_time - state.time, 0.0)
                limits["snapshot"] = until or float("inf")
            # 2. Step by the smallest limit; what binds it goes into the history.
            self.limit, step, unclipped_step = choose_step(limits)
            before = self.solver.checkpoint_scalars() if self.limit == PAUSE else {}
            taken = self._step(step, unclipped_step)
            if self.limit == PAUSE:
                self._begin_pulse(taken, before)
            # 3. A step never writes into a folder that another process has taken over.
            self.folder.confirm_lock()
            # 4. The exact end or time of the snapshot, without the rounding of the sum.
            if taken == step and self.limit in ("end", "snapshot"):
                state.time = end if self.limit == "end" else self.snapshots.next_time
            self.steps += 1
            self._observe()
            # 5. Checkpoint, progress, and the wish of the caller to stop.
            if self.steps % self.case.output.checkpoint_every == 0:
                self._save()
            if progress is not None:
                progress(self._progress())
            if should_stop is not None and should_stop():
                self._save()
                raise Stopped(
                    f"stopped at {format_quantity(state.time, 's')} after {self.steps} steps"
                )

    def _begin_pulse(self, pause: float, before: Mapping[str, float]) -> None:
        """Count snapshots anew after a pause of a length [s], and write what it has changed.

        Args:
            before: the numbers of the solver before it.
        """
        time, now = self.solver.state.time, self.solver.checkpoint_scalars()
        parts = self.recipe.mirror_images
        self.snapshots.begin_again(time)
        self.folder.events.append(
            "pause",
            time=time,
            step=self.steps + 1,
            length_s=pause,
            heat_removed_J=parts * (now["energy.pauses"] - before["energy.pauses"]),
            volume_added_m3=parts * (now["rearranged"] - before["rearranged"]),
        )

    def _progress(self) -> RunProgress:
        time, wall = self.solver.state.time, clock.monotonic()
        # The expected cost of the stages is asked once, at the first step.
        if self._remaining is None:
            steps = self.recipe.step_forecast()
            self._remaining = RemainingTime(spans_of(self.recipe, steps, self._backend.threads))
        return RunProgress(
            time,
            self.case.time.end,
            self.steps,
            self.hottest,
            self._remaining.work_done(time),
            self._remaining.step_to(time, wall),
        )

    def _step(self, step: float, unclipped_step: float) -> float:
        """A step of the solver; where it fails, what was reached is kept.

        Raises:
            StepFailed: with the time that was reached.
        """
        try:
            return self.solver.step(step, unclipped_step)
        except StepFailed as error:
            self._save()
            self._snapshot(self._view())
            time = format_quantity(self.solver.state.time, "s")
            raise StepFailed(
                f"{error}; stopped at {time} after {self.steps} steps, the checkpoint and the last "
                "good snapshot are kept"
            ) from error

    def finish(self) -> dict[str, Any]:
        """Write the summary; the run is complete."""
        state = self.solver.state

        # A run that became steady ends between two snapshots.
        if self.solver.is_steady:
            self._snapshot(self._view())
        self._save(is_last=True)
        summary = {
            "case": self.case.name,
            "title": self.case.title,
            "solver": self.case.solver.kind,
            **self.recipe.amounts(),
            "particles": self.solver.particle_count,
            "spacing_m": self.recipe.layers.spacing,
            "spacing_requested_m": self.case.particles.spacing,
            "steps": self.steps,
            "time_s": state.time,
            "is_steady": self.solver.is_steady,
            "wall_time_s": self._wall_time(),
            "backend": self._backend.name,
            "device": self._backend.device,
            "precision": str(self._backend.real),
            "threads": self._backend.threads,
            **self.observers.summary(),
            "dimensionless": self.recipe.dimensionless(),
            **self.recipe.summary(),
        }

        # Warnings that follow from the numbers join those of the forecast.
        summary["numerical_sd"] = numerical_sd(summary)
        if own := declarations(self.observers.members):
            summary[OWN_OBSERVERS] = own
        found = found_warnings(summary, self.observers.last)
        for text in found:
            self.folder.log(f"warning: {text}")
        summary["warnings"] = [*event_warnings(read_events(self.folder.events.path)), *found]

        # The line of a surface at the end, then the mark of a complete run.
        relief = self._view().relief
        if relief is not None:
            write_relief(self.folder.path, relief, self.case.domain.extent)
        self.folder.events.append("finished", time=state.time, step=self.steps)
        self.folder.log(f"finished after {self.steps} steps, {summary['wall_time_s']:.1f} s")
        self.folder.finish(summary)
        return self.folder.summary

    def _view(self) -> View:
        return self.recipe.view(self.solver, self.steps, self.limit)

    def _observe(self) -> None:
        view = self._view()
        self.hottest = float(view.temperature.max())
        row = self.observers.observe(view)
        if self.steps % self.case.output.history_every == 0:
            self.folder.history.append(row)
        if self.snapshots.due(view.time):
            self._snapshot(view)

    def _snapshot(self, view: View) -> None:
        self.folder.particles.append(view.time, view.position, snapshot_fields(view), units=UNITS)
        if view.relief is not None or view.columns is not None:
            append_surface(self.folder.surface, view)

    def _save(self, *, is_last: bool = False) -> None:
        state, backend = self.solver.state, self._backend
        self.folder.save_checkpoint(
            step=self.steps,
            time=state.time,
            arrays={name: backend.host_view(array) for name, array in self.solver.fields.items()},
            scalars={
                "limit": self.limit,
                "wall_time": self._wall_time(),
                "solver": self.solver.checkpoint_scalars(),
                "observers": self.observers.state(),
                "snapshots": self.snapshots.state(),
            },
            is_last=is_last,
        )

    def _wall_time(self) -> float:
        return self.wall_before + clock.monotonic() - self.started
