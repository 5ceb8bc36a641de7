"""Read a run folder back: `open_run(folder)` gives history, summary, snapshots and events.

Works on a finished run and on one that is still running: what a run overwrites while it is read
is read again (`generation`). Nothing is ever written.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.input.key_units import unit_in, unit_of
from lasersph.output.errors import OutputError, clear_errors, install_hint, read_json
from lasersph.output.generation import Result, read_unchanged
from lasersph.output.history import read_events, read_history
from lasersph.output.older_results import (
    images_of_older,
    note_on_older,
    read_summary,
    read_uncertainty,
    times,
)
from lasersph.output.particle_file import AXES, open_for_reading
from lasersph.output.symmetry import is_axisymmetric, is_mirrored, mirrored_axes

if TYPE_CHECKING:
    import anywidget  # pyright: ignore[reportMissingImports]
    import pandas  # pyright: ignore[reportMissingImports]
    import xarray  # pyright: ignore[reportMissingImports]

    from lasersph.output.height_map import HeightMap


class Run:
    """A run folder open for reading; each file is read when it is asked for.

    Attributes:
        path: the folder.
    """

    def __init__(self, path: Path) -> None:
        self.path = path

    def __repr__(self) -> str:
        """The folder, the case and how far it is, in one line."""
        title = self.case.get("title") or "a case without a title"
        state = "complete" if self.is_complete else "not complete"
        return f"<run {self.path}: {title}, {state}>"

    @property
    def is_complete(self) -> bool:
        """Whether the run has reached its end."""
        return (self.path / "summary.json").exists()

    @cached_property
    def summary(self) -> dict[str, Any]:
        """Content of summary.json, SI, see `older_results` of what an earlier version wrote. Raises
        OutputError where the run is not complete."""
        if not self.is_complete:
            raise OutputError(f"{self.path} has no summary: the run is not complete")
        return read_summary(self.path)

    @cached_property
    def uncertainty(self) -> dict[str, Any] | None:
        """Content of uncertainty.json, SI; None where the run was done without companions."""
        return read_uncertainty(self.path) if (self.path / "uncertainty.json").exists() else None

    @cached_property
    def resolved(self) -> dict[str, Any]:
        """Content of resolved.json: schema_version, case_hash, versions, case."""
        return read_json(self.path / "resolved.json")

    @property
    def case(self) -> dict[str, Any]:
        """The case with all defaults, SI."""
        return self.resolved["case"]

    @property
    def symmetry_factor(self) -> int:
        """2 where half or a quarter of a period or a section (r, z) was computed, mirrored about
        x = 0; else 1."""
        return 2 if is_mirrored(self.case) else 1

    @property
    def mirrored(self) -> tuple[bool, bool]:
        """Whether x < 0, and whether y < 0, mirrors what was computed."""
        return mirrored_axes(self.case)

    @property
    def across(self) -> str:
        """Letter of the first axis for labels: r in a section (r, z), else x."""
        return "r" if is_axisymmetric(self.case) else "x"

    @cached_property
    def case_text(self) -> str:
        """The case file as given."""
        with clear_errors("read", self.path / "case.toml"):
            return (self.path / "case.toml").read_text(encoding="utf-8")

    @cached_property
    def history(self) -> dict[str, np.ndarray]:
        """Columns of history.csv, arrays (steps,), SI, by name; `units` has the unit of each."""
        path = self.path / "history.csv"
        found = read_unchanged(self.path, lambda: read_history(path) if path.exists() else {})
        images = images_of_older(self.path)
        return found if images == 1 else times(found, images)

    @property
    def note_on_older(self) -> str | None:
        """One line on amounts that an earlier version gave of the computed part, and that are
        multiplied as they are read; None where none is."""
        return note_on_older(self.path)

    @property
    def dimensions(self) -> int:
        """Number of space dimensions of the run."""
        return int(self.case["solver"]["dimensions"])

    @property
    def units(self) -> dict[str, str]:
        """SI unit of each column of the history, empty of numbers and texts.

        Amounts of a 1-D run are per area, those of a 2-D run per length: J/m^2, J/m; of a section
        (r, z) of the whole revolution.
        """
        covered = 3 if is_axisymmetric(self.case) else self.dimensions
        return {name: unit_in(unit_of(name), covered) for name in self.history}

    @cached_property
    def events(self) -> list[dict[str, Any]]:
        """Events of the run: dicts with time_s, step, event and more."""
        return read_unchanged(self.path, lambda: read_events(self.path / "events.jsonl"))

    @cached_property
    def snapshots(self) -> Snapshots:
        """The particle snapshots, read one by one when asked for."""
        return Snapshots(self.path / "particles.vtkhdf")

    @cached_property
    def surface(self) -> Snapshots:
        """The surface at the times of the snapshots: a line of one that moves, a grid over which
        melt flows in 3-D; none of others."""
        return Snapshots(self.path / "surface.vtkhdf")

    @property
    def surface_moves(self) -> bool:
        """Whether the surface has heights: a grid below which melt flows may stay flat."""
        if not len(self.surface):
            return False
        return self.surface.dimension == 2 or "height" in self.surface.units

    def relief(self, time: float | None = None) -> HeightMap:
        """The surface of a crater, or of metal that moved, as arrays in meters.

            relief = lasersph.open_run("runs/texture-steel").relief()
            relief.x, relief.z[0]  # places and heights of a 2-D run, (nx,) each
            relief.y, relief.z  # of a 3-D run, (ny,) and (ny, nx)

        Half and a quarter of a period are mirrored.

        Args:
            time: of the closest snapshot [s]; the last one where it is not given.

        Raises:
            OutputError: no snapshots yet, or a surface that stayed flat.
        """
        from lasersph.output.height_map import height_map, profile_map, surface_map

        # A surface that moves has a line of its own; else the uppermost particles are the surface.
        steps = self.surface if self.surface_moves else self.snapshots
        if not len(steps):
            raise OutputError(f"{self.path} has no snapshots yet")
        step = steps[-1] if time is None else steps.nearest(time)
        try:
            if steps is self.surface and steps.dimension == 3:
                return surface_map(step, steps.shape, self.mirrored)
            if steps is self.surface:
                return profile_map(step, is_half=self.symmetry_factor == 2)
            return height_map(step)
        except OutputError as error:
            raise OutputError(f"{self.path}: {error}") from None

    def show(self) -> anywidget.AnyWidget:
        """The particles in a notebook: turn them, color them, play them; also while a run computes.

        Raises:
            OutputError: anywidget is not installed.
        """
        from lasersph.output.viewer import make_widget

        return make_widget(self.path)

    def history_frame(self) -> pandas.DataFrame:
        """The history as a pandas table, indexed by time_s.

        Raises:
            OutputError: pandas is not installed.
        """
        try:
            import pandas  # pyright: ignore[reportMissingImports]
        except ImportError as error:
            raise OutputError(install_hint("pandas")) from error
        return pandas.DataFrame(self.history).set_index("time_s")

    def snapshots_dataset(self) -> xarray.Dataset:
        """All snapshots as one xarray data set with dimensions time, particle (and axis).

        Raises:
            OutputError: xarray is not installed, or the number of particles changes.
        """
        try:
            import xarray  # pyright: ignore[reportMissingImports]
        except ImportError as error:
            raise OutputError(install_hint("xarray")) from error
        steps = list(self.snapshots)
        # A data set has axes of one length: numbers of particles that change do not fit.
        if len({step["position"].shape for step in steps}) > 1:
            raise OutputError("the number of particles changes: read the snapshots one by one")
        variables: dict[str, Any] = {}
        for name in steps[0] if steps else ():
            if name == "time":
                continue
            # Time goes first, the axis of a vector second.
            array = np.stack([step[name] for step in steps])
            dims = ("time", "particle") if array.ndim == 2 else ("time", "axis", "particle")
            unit = {"unit": self.snapshots.units.get(name, "")}
            variables[name] = (dims, array, unit)
        axes = "xyz" if self.snapshots.dimension == 3 else "xz"[-self.snapshots.dimension :]
        times = self.snapshots.times
        return xarray.Dataset(variables, coords={"time": times, "axis": list(axes)})


class Snapshots:
    """The steps of particles.vtkhdf: `len(s)`, `s[k]`, iteration.

    Each step is a dict of `time` [s], `position` (dim, n) [m] and the stored fields, (n,) or
    (dim, n), SI.
    """

    def __init__(self, path: Path) -> None:
        self.path = path

    @cached_property
    def times(self) -> np.ndarray:
        """Times of the steps [s]. Raises OutputError where the file is damaged."""
        if not self.path.exists():
            return np.zeros(0)
        return self._read(lambda file: file["VTKHDF/Steps/Values"][:])

    @cached_property
    def dimension(self) -> int:
        """Number of space dimensions of the run."""
        return self._read(lambda file: int(file.attrs["dimension"]))

    @cached_property
    def shape(self) -> tuple[int, int]:
        """Numbers of points along x and y of a surface over a grid, x slowest. Raises KeyError of
        other files."""
        nx, ny = self._read(lambda file: file.attrs["shape"][:].tolist())
        return nx, ny

    @cached_property
    def units(self) -> dict[str, str]:
        """SI unit of each entry of a step: `time`, `position`, and the fields."""
        fields = self._read(
            lambda file: {n: str(d.attrs["unit"]) for n, d in file["VTKHDF/PointData"].items()}
        )
        return {"time": "s", "position": "m", **fields}

    def _read(self, read: Callable[[Any], Result]) -> Result:
        """Result of `read` on the HDF5 file, from one generation of it. Raises OutputError."""

        def read_file() -> Result:
            with open_for_reading(self.path) as file:
                return read(file)

        return read_unchanged(self.path.parent, read_file)

    def nearest(self, time: float) -> dict[str, Any]:
        """The step closest to a time [s]. Raises IndexError where there is none."""
        if not len(self):
            raise IndexError("the run has no snapshots")
        return self[int(np.argmin(np.abs(self.times - time)))]

    def __len__(self) -> int:
        return len(self.times)

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return (self[k] for k in range(len(self)))

    def __getitem__(self, number: int) -> dict[str, Any]:
        return self._read(lambda file: read_step(file, number))

    def series(self, name: str) -> list[np.ndarray]:
        """One field, or `position`, of every step, as in the steps; the file is opened once."""
        numbers = self._numbers()
        return self._read(lambda file: read_series(file, numbers, name))

    def _numbers(self) -> list[int]:
        """Numbers of the steps in the file."""
        return list(range(len(self)))


def read_step(file: Any, number: int) -> dict[str, Any]:
    """One step of an open file. Raises IndexError where the file does not hold it (any longer)."""
    axes = AXES[int(file.attrs["dimension"])]
    root = file["VTKHDF"]
    steps = root["Steps"]
    present = int(steps.attrs["NSteps"])
    if not -present <= number < present:
        raise IndexError(f"the run has {present} snapshots")
    # Negative numbers count from the end, as those of a list.
    number %= present
    # Number of points, and where positions and fields of this step begin.
    count = int(root["NumberOfPoints"][int(steps["PartOffsets"][number])])
    start = int(steps["PointOffsets"][number])
    position = read_block(root["Points"], start, count, axes)
    step = {"time": float(steps["Values"][number]), "position": position}
    offsets = steps["PointDataOffsets"]
    for name, dataset in root["PointData"].items():
        step[name] = read_block(dataset, int(offsets[name][number]), count, axes)
    return step


def read_series(file: Any, numbers: list[int], name: str) -> list[np.ndarray]:
    """A field, or `position`, of steps of an open file. Raises KeyError where there is none."""
    axes = AXES[int(file.attrs["dimension"])]
    root = file["VTKHDF"]
    steps = root["Steps"]
    counts = root["NumberOfPoints"][:][steps["PartOffsets"][:]]
    # Each look into the file takes as long as a small read: once for all steps.
    if name == "position":
        data, starts = root["Points"], steps["PointOffsets"][:]
    else:
        data, starts = root["PointData"][name], steps["PointDataOffsets"][name][:]
    return [read_block(data, int(starts[k]), int(counts[k]), axes) for k in numbers]


def read_block(data: Any, start: int, count: int, axes: tuple[int, ...]) -> np.ndarray:
    """Values of so many points from a place on, (n,) or (dim, n)."""
    block = data[start : start + count]
    return block if block.ndim == 1 else from_three_axes(block, axes)


def from_three_axes(block: np.ndarray, axes: tuple[int, ...]) -> np.ndarray:
    """(n, 3) -> (dim, n)."""
    return np.ascontiguousarray(block[:, axes].T)


RunOrFolder = Run | str | PathLike[str]
"""A run as functions that read one take it: one that is open, or its folder."""


def open_run(path: RunOrFolder) -> Run:
    """Open the folder of a run, finished or running; a run that is open is given back.

        run = lasersph.open_run("runs/steel")
        run.history["temperature_max_K"].max(), run.units["temperature_max_K"]
        run.snapshots[-1]["velocity"], run.snapshots.units["velocity"]  # (dim, n), "m/s"

    Raises:
        OutputError: there is no run in the folder.
    """
    if isinstance(path, Run):
        return path
    folder = Path(path)
    # A folder without resolved.json was never that of a run.
    if not folder.is_dir():
        what = "is a file, not the folder of a run" if folder.exists() else "no such folder"
        raise OutputError(f"{folder}: {what}")
    if not (folder / "resolved.json").exists():
        raise OutputError(f"{folder} is not a run folder: it has no resolved.json")
    return Run(folder)
