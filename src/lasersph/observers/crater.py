"""Depth, width, volume and taper of the crater, and how much each pulse ablates.

The removed volume is that of all particles that left at the reference density; the vaporized
volume adds the share of its heat of vaporization that each exposed particle has taken up. While
whole layers leave, the latter grows smoothly; after the pulse it falls again, as what has not left
gives its heat to the metal below.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np

from lasersph.input.key_units import unit_in
from lasersph.observers.ablation_view import CONDENSED, AblationView
from lasersph.observers.crater_shape import CraterShape, crater_shape
from lasersph.observers.observer import Observer, Row
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View, lower_faces

SIZES = {
    "depth": "depth of the crater at the axis",
    "depth_mean": "mean depth of the crater",
    "depth_max": "largest depth of the crater",
    "width": "width of the crater along x at the original surface",
    "diameter": "diameter of the circle of the same area",
}
CELLS = {"depth": 1.0, "depth_max": 1.0, "width": 2.0}
"""Cells by which a size jumps: particles leave one by one, a width grows at both ends at once."""
REMOVED = Quantity("crater_removed_volume_m3", "m^3", "volume of ejected metal")
VAPORIZED = Quantity(
    "crater_vaporized_volume_m3",
    "m^3",
    "ejected volume with vaporized shares of the surface",
)


class Crater(Observer):
    """Observes the crater of a beam."""

    title = "crater"
    note = (
        "Of half or a quarter of a spot volumes, areas and widths are those of the whole crater. In"
        " 2-D volumes are per unit length, in 1-D per unit area."
    )
    columns = (
        *(
            Quantity(
                f"crater_{name}_m",
                "m",
                words,
                end=f"crater.{name}_m",
                is_main=name in ("depth", "depth_mean", "diameter"),
                cells=CELLS.get(name, 0.0),
            )
            for name, words in SIZES.items()
        ),
        REMOVED,
        VAPORIZED,
    )
    results = (
        Quantity("crater.taper_deg", "deg", "taper of the walls from the vertical"),
        Quantity("crater.volume_unit", "", "unit of the volumes"),
        Quantity("crater.volume_m3", "m^3", "volume below the original surface"),
        Quantity("crater.removed_volume_m3", "m^3", "volume of ejected metal"),
        Quantity("crater.vaporized_volume_max_m3", "m^3", f"{VAPORIZED.words}, at most"),
        Quantity("crater.mirror_images", "", "computed parts that make up the crater"),
        Quantity("crater.depth_of_pulse_m", "m", "depth that each pulse added at the axis"),
    )
    kept = ("shape", "removed", "vaporized_max", "bottom", "depth_at_start")

    def __init__(
        self,
        dimension: int,
        *,
        axis: tuple[float, float] = (0.0, 0.0),
        pulse_starts: tuple[float, ...] = (),
    ) -> None:
        """
        Args:
            dimension: 1, 2 or 3.
            axis: where the beam's axis meets the surface, x and y [m].
            pulse_starts: times at which the pulses begin [s].
        """
        # a 1-D run has a depth alone; volumes are per area there
        self.names = list(SIZES) if dimension > 1 else list(SIZES)[:3]
        self.unit = unit_in("m^3", dimension)
        end = self.unit.replace("^", "")
        volumes = (
            replace(one, key=one.key.replace("_m3", f"_{end}"), unit=self.unit)
            for one in (REMOVED, VAPORIZED)
        )
        self.columns = (*type(self).columns[: len(self.names)], *volumes)
        super().__init__()
        self.axis = np.array(axis[: dimension - 1])
        self.pulse_starts = pulse_starts
        self.shape = CraterShape()
        self.removed = self.vaporized_max = 0.0
        self.bottom: float | None = None
        self.depth_at_start: list[float] = []

    def observe(self, view: View) -> Row:
        """Sizes of the crater [m] and volumes at this step."""
        seen = ablation_of(view)
        # the bottom of the body, which a hole through it reaches
        if self.bottom is None:
            self.bottom = float(np.max(lower_faces(view)))
        self.shape = crater_shape(
            seen.column_center, seen.column_width, seen.column_top, self.axis, self.bottom
        )
        # depth at the start of each pulse, so that each pulse has its own
        for start in self.pulse_starts[len(self.depth_at_start) :]:
            if view.time >= start:
                self.depth_at_start.append(self.shape.depth)

        # what has left, and what the vaporized shares at the surface add to it
        self.removed = seen.ejected_mass / seen.density_reference
        exposed = view.surface[seen.stage[view.surface] == CONDENSED]
        share = float(np.sum(view.vapor_fraction[exposed] * view.volume[exposed]))
        vaporized = self.removed + share
        self.vaporized_max = max(self.vaporized_max, vaporized)
        sizes = [float(getattr(self.shape, name)) for name in self.names]
        return self.record(view.time, (*sizes, self.removed, vaporized))

    def values(self) -> dict[str, object]:
        """Volumes and the depth of each pulse; in 1-D there is no width and no taper."""
        depths = [*self.depth_at_start, self.shape.depth]
        absent = (f"crater.{name}_m" for name in SIZES if name not in self.names)
        return {
            **dict.fromkeys(absent),
            "crater.taper_deg": float(np.degrees(self.shape.taper)) if self.axis.size else None,
            "crater.volume_unit": self.unit,
            "crater.volume_m3": self.shape.volume,
            "crater.removed_volume_m3": self.removed,
            "crater.vaporized_volume_max_m3": self.vaporized_max,
            "crater.mirror_images": self.shape.mirror_images,
            "crater.depth_of_pulse_m": [after - before for before, after in pairwise(depths)],
        }


def ablation_of(view: View) -> AblationView:
    """Crater and ejecta of a view. Raises ValueError for a run without ablation."""
    if view.ablation is None:
        raise ValueError("this run has no ablation to observe")
    return view.ablation
