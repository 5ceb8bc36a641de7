"""The cut through a crater: body and ejecta of one snapshot, and the frame that shows them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lasersph.observers.ablation_view import CONDENSED, EJECTED, LEAVING
from lasersph.observers.box_sections import Box
from lasersph.output import Run
from lasersph.plots.particle_map import Cells, Snapshot

DEPTH = 1.6
"""Depth that a picture shows, over that of the crater or the melt."""
LEAST_LAYERS = 8
HEIGHT = 0.6
"""Height above the surface that a picture shows at most, over its width."""


@dataclass(frozen=True)
class Cut:
    """A snapshot in the plane through the beam's axis.

    Attributes:
        step: the snapshot. body: cells of condensed and leaving particles in the cut.
        ejecta: numbers of the particles in flight in the cut, (e,).
    """

    step: Snapshot
    body: Cells
    ejecta: np.ndarray

    @property
    def time(self) -> float:
        """Seconds."""
        return float(self.step["time"])

    @property
    def flying(self) -> np.ndarray:
        """x and z of the ejecta, (2, e) [m]."""
        return in_plane(self.step["position"])[:, self.ejecta]

    @property
    def velocity(self) -> np.ndarray:
        """Velocity of the ejecta in the plane, (2, e) [m/s]."""
        return in_plane(self.step["velocity"])[:, self.ejecta]

    def temperature(self, numbers: np.ndarray) -> np.ndarray:
        """Temperature of some particles [K]; numbers below 0 have none."""
        return np.where(numbers < 0, np.nan, self.step["temperature"][numbers])


def has_ablation(run: Run) -> bool:
    """Whether a run has a crater to show: snapshots and the history of a crater."""
    return len(run.snapshots) > 0 and "crater_depth_m" in run.history


def in_plane(vector: np.ndarray) -> np.ndarray:
    """x and z of a vector (dim, n); in 1-D x is 0."""
    if vector.shape[0] == 1:
        return np.concatenate([np.zeros_like(vector), vector])
    return vector[[0, -1]]


def plane_cut(run: Run, step: Snapshot) -> Cut:
    """The particles in the plane y = const through the beam's axis, in 3-D two layers thick."""
    stage, position = step["stage"], step["position"]
    chosen = np.ones(stage.size, dtype=bool)
    # In space the cut is two layers thick; the body is shown from the axis on, so that one looks at
    # the layer that the axis runs through.
    if position.shape[0] == 3:
        chosen = np.abs(position[1] - axis_of(run)[1]) < 1.01 * float(np.min(step["width"]))
    solid = chosen & ((stage == CONDENSED) | (stage == LEAVING))
    if position.shape[0] == 3:
        solid &= position[1] >= axis_of(run)[1]
    body = np.flatnonzero(solid)
    cells = Cells(in_plane(position)[:, body], in_plane(step["width"])[:, body], body)
    return Cut(step, cells, np.flatnonzero(chosen & (stage == EJECTED)))


def cut_frame(run: Run) -> Box:
    """Part of the cut that shows the crater of the whole run and the ejecta above it."""
    # Width of the block.
    history, first = run.history, run.snapshots[0]
    x, half = in_plane(first["position"])[0], 0.5 * in_plane(first["width"])[0]
    left, right = float(np.min(x - half)), float(np.max(x + half))
    spacing = float(np.min(first["width"]))
    # Depth: the deepest crater or melt of the whole run, with some layers below it.
    deepest = max(
        float(np.max(history["crater_depth_max_m"])), float(np.max(history["melt_depth_any_m"]))
    )
    bottom = float(np.max(0.5 * first["width"][-1] - first["position"][-1]))
    depth = min(max(DEPTH * deepest, LEAST_LAYERS * spacing), bottom)
    # Height: of the ejecta when the crater was done, no more than the picture can hold.
    most = max(HEIGHT * (right - left), 2.0 * depth)
    step = crater_snapshot(run)
    flying = step["position"][-1][step["stage"] == EJECTED]
    height = min(1.1 * float(np.max(flying, initial=0.0)) + 2.0 * spacing, most)
    return Box(left, right, -depth, height)


def axis_of(run: Run) -> tuple[float, float]:
    """x and y of the beam's axis [m]."""
    x, y = (run.case.get("laser") or {}).get("position", (0.0, 0.0))
    return float(x), float(y)


def crater_snapshot(run: Run) -> Snapshot:
    """The first snapshot in which the crater has its final volume, or the last one; the hottest
    where nothing left."""
    history = run.history
    # The column has the unit of a volume in this dimension at its end.
    volume = next(name for name in history if name.startswith("crater_removed_volume"))
    if history[volume][-1] == 0.0:
        return run.snapshots.nearest(
            float(history["time_s"][np.argmax(history["temperature_max_K"])])
        )
    # A snapshot shows the crater if it lies at or after the time at which the volume was final.
    done = np.flatnonzero(history[volume] >= history[volume][-1])
    time = float(history["time_s"][done[0]])
    later = np.flatnonzero(run.snapshots.times >= time * (1.0 - 1e-9))
    return run.snapshots[int(later[0])] if later.size else run.snapshots[-1]
