"""Depth of ablation that a run of a column gives."""

from __future__ import annotations

from dataclasses import dataclass

from lasersph.output import Run


@dataclass(frozen=True)
class Column:
    """A finished run of a column.

    Attributes:
        whole: depth in whole layers [um]. smooth: with the shares of what was about to leave [um].
    """

    whole: float
    smooth: float

    @classmethod
    def of(cls, one: Run) -> Column:
        """Read a run; its volume is per area in 1-D, else divided by the area."""
        # The volume of a 1-D run is per area already.
        crater, domain = one.summary["crater"], one.case["domain"]
        dimension = one.case["solver"]["dimensions"]
        area = 1.0 if dimension == 1 else domain["width"] ** (dimension - 1)
        return cls(1e6 * crater["depth_m"], 1e6 * crater["vaporized_volume_max_m3"] / area)


Pulse = tuple[int, int]
"""Duration [ns] and fluence [J/cm2]."""
Columns = dict[tuple[int, int, float], Column]
"""By duration, fluence and spacing [um]."""
