"""The flow of one snapshot in the plane, mirrored to a whole period, and on a grid."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from lasersph.observers.box_sections import Box
from lasersph.observers.interpolation import interpolate
from lasersph.output import Run
from lasersph.plots.curves import summary_of
from lasersph.plots.particle_map import PIXELS, Cells, Snapshot

MARGIN = 1.12
"""Width that a picture of a pool shows, over the width of the pool."""
DEPTH = 1.2
"""Depth that it shows, over the depth of the pool."""
VAPOR = 1e-6
"""A cell that took up more than this part of its heat of vaporization is drawn as boiling."""


@dataclass(frozen=True)
class PlaneFlow:
    """Particles of a plane snapshot: cells (their numbers count the particles of the snapshot) and
    velocity (2, m) [m/s], mirrored like the cells; time [s]; letter of the level axis.
    """

    time: float
    step: Snapshot
    cells: Cells
    velocity: np.ndarray
    across: str = "x"

    @property
    def flows(self) -> np.ndarray:
        """Whether each cell flows, (m,)."""
        return self.step["flows"][self.cells.number] > 0

    @property
    def fastest(self) -> float:
        """Largest speed [m/s]."""
        return float(np.max(self.step["speed"]))

    def inside(self, frame: Box, margin: float = 0.0) -> PlaneFlow:
        """The part within a frame, widened by a margin [m] on each side."""
        # Cells that touch the frame, so that its edges are covered as well.
        x, z = self.cells.center
        half = 0.5 * self.cells.size + margin
        chosen = (x + half[0] > frame.left) & (x - half[0] < frame.right)
        chosen &= (z + half[1] > frame.bottom) & (z - half[1] < frame.top)
        cells = Cells(
            self.cells.center[:, chosen],
            self.cells.size[:, chosen],
            self.cells.number[chosen],
            self.cells.walls,
        )
        return replace(self, cells=cells, velocity=self.velocity[:, chosen])

    def on_grid(
        self, frame: Box, columns: int, rows: int
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Velocity on an even grid of a frame, half a step from its edges.

        Returns:
            x (columns,), z (rows,) [m] and velocity (2, rows, columns) [m/s], NaN outside the
            metal and where the closest particle does not flow.
        """
        from scipy.spatial import KDTree

        # Nodes in the middle of even cells, and the particles around them.
        x = frame.across((np.arange(columns) + 0.5) / columns)
        z = frame.up((np.arange(rows) + 0.5) / rows)
        nodes = np.array([grid.ravel() for grid in np.meshgrid(x, z)])
        near = self.inside(frame, 4.0 * float(np.max(self.cells.size[:, self.flows], initial=0.0)))
        # A linear fit to the particles around each node; no velocity outside flowing metal.
        velocity = interpolate(near.cells.center, near.velocity, nodes)
        _, closest = KDTree(near.cells.center.T).query(nodes.T)
        closest = np.asarray(closest)
        velocity[:, ~(near.flows[closest] & near.cells.covers(nodes, closest))] = np.nan
        return x, z, velocity.reshape(2, rows, columns)


@dataclass(frozen=True)
class Raster:
    """A frame in pixels, (rows, columns): `number` is the particle that each shows, -1 for none."""

    step: Snapshot
    frame: Box
    number: np.ndarray
    across: str = "x"

    @property
    def edges(self) -> tuple[float, float, float, float]:
        """Left, right, bottom and top edge [m]."""
        return self.frame.left, self.frame.right, self.frame.bottom, self.frame.top

    def of(self, values: np.ndarray, shown: np.ndarray | None = None) -> np.ndarray:
        """Values (n,) of the particles as a picture, NaN where there is none, or none `shown`."""
        seen = self.number >= 0
        if shown is not None:
            seen &= shown[self.number]
        return np.where(seen, values[self.number], np.nan)

    def metal(self) -> np.ndarray:
        """1 where there is any."""
        return self.of(np.ones_like(self.step["temperature"]))

    def temperature(self) -> np.ndarray:
        """[K]."""
        return self.of(self.step["temperature"])

    def speed(self) -> np.ndarray:
        """[m/s], NaN where nothing flows."""
        return self.of(self.step["speed"], self.step["flows"] > 0)

    def phase(self) -> np.ndarray:
        """0 solid, 1 mush, 2 liquid, 3 liquid that took up heat of vaporization."""
        melt, vapor = self.step["melt_fraction"], self.step["vapor_fraction"]
        liquid = melt >= 1.0
        return self.of((melt > 0.0).astype(float) + liquid + (liquid & (vapor > VAPOR)))


def raster(flow: PlaneFlow, frame: Box, pixels: tuple[int, int] = PIXELS) -> Raster:
    """A frame of a state in pixels, rows and columns."""
    edges = (frame.left, frame.right, frame.bottom, frame.top)
    number = flow.inside(frame).cells.picture(edges, pixels)
    return Raster(flow.step, frame, number, flow.across)


def plane_flow(run: Run, time: float) -> PlaneFlow:
    """The state at the snapshot closest to a time [s], over the whole period; at rest in a run
    without flow."""
    step = run.snapshots.nearest(time)
    count = step["position"].shape[1]
    cells = Cells(step["position"], step["width"], np.arange(count))
    # A box fills its walls at all times: the frame is that of the lattice at the start.
    if is_box(run) and not len(run.surface):  # its particles lay on a lattice at first
        first = run.snapshots[0]
        cells = replace(cells, walls=Cells(first["position"], first["width"], cells.number).frame)
    velocity = step.get("velocity", np.zeros(step["position"].shape))
    # The mirror image has the opposite u and the same w.
    if run.symmetry_factor == 2:
        cells = cells.mirrored()
        velocity = np.concatenate([velocity * np.array([[-1.0], [1.0]]), velocity], axis=1)
    return PlaneFlow(float(step["time"]), step, cells, velocity, run.across)


def pool_frame(run: Run, flow: PlaneFlow) -> Box:
    """Frame of a picture of the melt pool: the largest pool and rim of the run and a margin."""
    # Largest pool of the run by its summary, else that of this snapshot.
    melt = summary_of(run).get("melt", {})
    wet = flow.step["melt_fraction"][flow.cells.number] > 0.0
    x, z = flow.cells.center
    size = float(np.min(flow.cells.size))
    wide = melt.get("width_any_max_m") or (2.0 * np.max(np.abs(x), where=wet, initial=0.0))
    deep = melt.get("depth_any_max_m") or np.max(-z, where=wet, initial=0.0)
    # A pool of few cells is shown with some of its surroundings, but not beyond the body.
    half_width = max(0.5 * MARGIN * float(wide), 8.0 * size)
    left, right, bottom, _ = flow.cells.frame
    depth = max(DEPTH * float(deep), 6.0 * size)
    # The rim rises above the original surface.
    rim = float(np.max(run.history.get("topography.rim_height_m", np.zeros(1))))
    top = DEPTH * rim + size if rim > 0.0 else 0.0
    return Box(max(-half_width, left), min(half_width, right), max(-depth, bottom), top)


def body_frame(flow: PlaneFlow) -> Box:
    """The whole body."""
    return Box(*flow.cells.frame)


def has_flow(run: Run) -> bool:
    """Whether the run was computed with flow in the plane and has snapshots of it."""
    with_flow = "flow_speed_max_m_s" in run.history
    return with_flow and len(run.snapshots) > 0 and run.snapshots.dimension == 2


def is_box(run: Run) -> bool:
    """Whether the run was a closed box of liquid."""
    return "box_u_max_m_s" in run.history


def time_of_most_flow(run: Run) -> float:
    """When the melt had most kinetic energy; a box at the end [s].

    Not when its surface was fastest, which a weld is while its pool is shallow.
    """
    history = run.history
    # A box is slow at first and steady at the end.
    if is_box(run):
        return float(history["time_s"][-1])
    return float(history["time_s"][np.argmax(history["flow_kinetic_energy_J"])])
