"""Depth, width, volume and taper of the crater, and how much each pulse ablates.

The removed volume is that of all particles that left at the reference density; the vaporized
volume adds the share of its heat of vaporization that each exposed particle has taken up. While
whole layers leave, the latter grows smoothly; after the pulse it falls again, as what has not left
gives its heat to the metal below.
"""

from __future__ import annotations

from dataclasses import asdict
from itertools import pairwise
from typing import Any

import numpy as np

from lasersph.observers.ablation_view import CONDENSED, AblationView
from lasersph.observers.crater_shape import CraterShape, crater_shape
from lasersph.observers.view import View, lower_faces

SIZES = ("depth", "depth_mean", "depth_max", "width", "diameter")


class Crater:
    """Observes the crater of a beam."""

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
        self.axis = np.array(axis[: dimension - 1])
        self.unit = "m" if dimension == 1 else f"m{dimension}"
        self.names = SIZES if dimension > 1 else SIZES[:3]
        self.pulse_starts = pulse_starts
        self.shape = CraterShape()
        self.removed = self.vaporized_max = 0.0
        self.bottom: float | None = None
        self.depth_at_start: list[float] = []

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the history columns."""
        sizes = tuple(f"crater_{name}_m" for name in self.names)
        volumes = (f"crater_removed_volume_{self.unit}", f"crater_vaporized_volume_{self.unit}")
        return (*sizes, *volumes)

    def observe(self, view: View) -> dict[str, float]:
        """Sizes of the crater [m] and volumes at this step."""
        seen = ablation_of(view)
        if self.bottom is None:
            self.bottom = float(np.max(lower_faces(view)))
        self.shape = crater_shape(
            seen.column_center, seen.column_width, seen.column_top, self.axis, self.bottom
        )
        for start in self.pulse_starts[len(self.depth_at_start) :]:
            if view.time >= start:
                self.depth_at_start.append(self.shape.depth)
        self.removed = seen.ejected_mass / seen.density_reference
        exposed = view.surface[seen.stage[view.surface] == CONDENSED]
        share = float(np.sum(view.vapor_fraction[exposed] * view.volume[exposed]))
        vaporized = self.removed + share
        self.vaporized_max = max(self.vaporized_max, vaporized)
        sizes = [float(getattr(self.shape, name)) for name in self.names]
        return dict(zip(self.columns, [*sizes, self.removed, vaporized], strict=True))

    def summary(self) -> dict[str, Any]:
        """`crater`: sizes at the end, volumes, and the depth of each pulse.

        Volumes of 1-D and 2-D runs are per unit area and length: see `volume_unit`.
        """
        shape = asdict(self.shape)
        sizes = {f"{name}_m": shape[name] if name in self.names else None for name in SIZES}
        depths = [*self.depth_at_start, self.shape.depth]
        per_pulse = [after - before for before, after in pairwise(depths)]
        return {
            "crater": {
                **sizes,
                "taper_deg": float(np.degrees(self.shape.taper)) if self.axis.size else None,
                "volume_unit": self.unit.replace("m2", "m^2").replace("m3", "m^3"),
                "volume_m3": self.shape.volume,
                "removed_volume_m3": self.removed,
                "vaporized_volume_max_m3": self.vaporized_max,
                "mirror_images": self.shape.mirror_images,
                "depth_of_pulse_m": per_pulse,
            }
        }

    def state(self) -> dict[str, Any]:
        """What `restore` needs."""
        return {
            "shape": asdict(self.shape),
            "removed": self.removed,
            "vaporized_max": self.vaporized_max,
            "bottom": self.bottom,
            "depth_at_start": list(self.depth_at_start),
        }

    def restore(self, state: dict[str, Any]) -> None:
        """Continue from a state."""
        self.shape = CraterShape(**state["shape"])
        self.removed, self.vaporized_max = state["removed"], state["vaporized_max"]
        self.bottom = state["bottom"]
        self.depth_at_start = list(state["depth_at_start"])


def ablation_of(view: View) -> AblationView:
    """Crater and ejecta of a view. Raises ValueError for a run without ablation."""
    if view.ablation is None:
        raise ValueError("this run has no ablation to observe")
    return view.ablation
