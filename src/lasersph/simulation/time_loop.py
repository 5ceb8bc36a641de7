"""The time loop, and the run folder around it.

limits -> step -> observers -> history -> snapshots -> checkpoint, until the end of the case.
No decision reads the clock, so that a run resumed from a checkpoint repeats the same numbers.
"""

from __future__ import annotations

import platform
import time as clock
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from lasersph import __version__, compute
from lasersph.case import Case
from lasersph.case.checks import refuse_if_too_large
from lasersph.input import format_quantity
from lasersph.observers import Observer, Observers, numerical_sd
from lasersph.observers.snapshots import UNITS, snapshot_fields
from lasersph.observers.view import View
from lasersph.output import RunFolder
from lasersph.output.checkpoint import Checkpoint
from lasersph.output.run_folder import Origin
from lasersph.output.settings import SnapshotSchedule
from lasersph.simulation.forecast import spans_of
from lasersph.simulation.progress import RemainingTime, RunProgress
from lasersph.simulation.recipes import Recipe, recipe_of
from lasersph.solvers.step_control import PAUSE, Solver, StepFailed, choose_step

PACKAGES = ("numpy", "numba", "scipy", "h5py", "pydantic", "matplotlib")
END = 1.0 - 1e-12


Progress = Callable[[RunProgress], None]
"""Called after each step."""


@dataclass(frozen=True)
class Result:
    """What a run leaves: its folder and the numbers of summary.json."""

    folder: Path
    summary: dict[str, Any]


class Stopped(Exception):
    """The run was asked to stop; its checkpoint is written."""


def run(
    case: Case,
    out: str | Path,
    *,
    resume: bool = False,
    wait: float = 0.0,
    threads: int | None = None,
    precision: str = "float64",
    backend: str = "cpu",
    recipe: type[Recipe[Any, Any]] | None = None,
    observers: Sequence[Observer] = (),
    progress: Progress | None = None,
    should_stop: Callable[[], bool] = lambda: False,
) -> Result:
    """Compute a case into a run folder.

    Args:
        out: folder of the run; must be new or empty unless `resume`.
        resume: continue from the last checkpoint in `out`; from the start where there is none.
        wait: how long another process that computes in `out` may take to leave it [s].
        threads: None takes all processors. precision: "float64" or "float32".
        backend: "cpu", or "cuda" for a graphics card. Either continues what the other began.
        recipe: a class of one's own in place of that of the case's solver, with terms, boundaries
            or a solver of one's own. observers: of one's own, beside those of the recipe.
        should_stop: asked after each step; True writes a checkpoint and raises `Stopped`.

    Raises:
        CaseError: too large for this machine or its card. ValueError: two observers with
            the same column. FolderRefused, OutputError: see `output`.
        NoDevice: no graphics card for backend "cuda".
        StepFailed: a step does not converge however small; the last checkpoint is kept.
    """
    refuse_if_too_large(case, backend)
    Observers(observers)  # refuses them before anything is written
    device = compute.cuda(precision) if backend == "cuda" else compute.cpu(threads, precision)
    chosen = recipe_of(case) if recipe is None else recipe(case)
    own = "" if recipe is None else f"-{recipe.__name__}"
    origin = _origin(case, precision + own)
    if resume:
        folder, checkpoint = RunFolder.resume(out, origin, wait=wait)
    else:
        folder, checkpoint = RunFolder.create(out, origin, wait=wait), None
    try:
        if folder.is_complete:
            return Result(folder.path, folder.summary)
        loop = _Loop(case, chosen, chosen.build(device), folder, observers)
        loop.begin(checkpoint)
        loop.go(progress, should_stop)
        return Result(folder.path, loop.finish())
    finally:
        folder.close()


def _origin(case: Case, variant: str) -> Origin:
    versions = {"lasersph": __version__, "python": platform.python_version()}
    versions |= {name: version(name) for name in PACKAGES}
    return Origin(case.text, case.resolved(), versions, f"{case.hash()}-{variant}")


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
        self.case, self.recipe, self.solver, self.folder = case, recipe, solver, folder
        self._backend = solver.backend
        members = recipe.observers(tuple(solver.iterations)).members
        self.observers = Observers([*members, *observers])
        self.snapshots = SnapshotSchedule(case.output.snapshots, case.end_of_pulse)
        self.steps, self.limit, self.wall_before = 0, "", 0.0
        self.started = clock.monotonic()
        self._remaining: RemainingTime | None = None

    def begin(self, checkpoint: Checkpoint | None) -> None:
        """Start at rest, or where the checkpoint left off."""
        if checkpoint is None:
            self.folder.log(f"{self.case.name}: {self.solver.particle_count} particles")
            self.folder.events.append("started", time=0.0, step=0, backend=self._backend.name)
            self._observe()
            return
        scalars = checkpoint.scalars
        self.steps, self.limit = checkpoint.step, scalars["limit"]
        self.wall_before = scalars["wall_time"]
        self.solver.restore(dict(checkpoint.arrays), scalars["solver"])
        self.observers.restore(scalars["observers"])
        self.snapshots.restore(scalars["snapshots"])
        self.folder.log(f"resumed at step {self.steps}, {format_quantity(checkpoint.time, 's')}")
        self.folder.events.append(
            "resumed", time=checkpoint.time, step=self.steps, backend=self._backend.name
        )

    def go(self, progress: Progress | None, should_stop: Callable[[], bool]) -> None:
        """Step until the end of the case."""
        state, end = self.solver.state, self.case.time.end
        while state.time < end * END and not self.solver.is_steady:
            limits = self.solver.time_step_limits()
            if PAUSE in limits:
                self._snapshot(self._view())
            else:
                until = max(self.snapshots.next_time - state.time, 0.0)
                limits["snapshot"] = until or float("inf")
            self.limit, step, unclipped_step = choose_step(limits)
            before = self.solver.checkpoint_scalars() if self.limit == PAUSE else {}
            taken = self._step(step, unclipped_step)
            if self.limit == PAUSE:
                self._begin_pulse(taken, before)
            self.folder.confirm_lock()
            if taken == step and self.limit in ("end", "snapshot"):
                state.time = end if self.limit == "end" else self.snapshots.next_time
            self.steps += 1
            self._observe()
            if self.steps % self.case.output.checkpoint_every == 0:
                self._save()
            if progress is not None:
                progress(self._progress())
            if should_stop():
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
        self.snapshots.begin_again(time)
        self.folder.events.append(
            "pause",
            time=time,
            step=self.steps + 1,
            length_s=pause,
            heat_removed_J=now["energy.pauses"] - before["energy.pauses"],
            volume_added_m2=now["rearranged"] - before["rearranged"],
        )

    def _progress(self) -> RunProgress:
        time, wall = self.solver.state.time, clock.monotonic()
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
        if self.solver.is_steady:
            self._snapshot(self._view())
        summary = {
            "case": self.case.name,
            "title": self.case.title,
            "solver": self.case.solver.kind,
            "dimensions": self.case.solver.dimensions,
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
        summary["numerical_sd"] = numerical_sd(summary)
        relief = self._view().relief
        if relief is not None:
            self.folder.write_profile(relief.x, relief.height)
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
        if view.relief is not None:
            line = np.array([view.relief.x, view.relief.height])
            self.folder.surface.append(view.time, line, {})

    def _save(self) -> None:
        state, backend = self.solver.state, self._backend
        self.folder.save_checkpoint(
            step=self.steps,
            time=state.time,
            arrays={name: backend.look(array) for name, array in self.solver.fields.items()},
            scalars={
                "limit": self.limit,
                "wall_time": self._wall_time(),
                "solver": self.solver.checkpoint_scalars(),
                "observers": self.observers.state(),
                "snapshots": self.snapshots.state(),
            },
        )

    def _wall_time(self) -> float:
        return self.wall_before + clock.monotonic() - self.started
