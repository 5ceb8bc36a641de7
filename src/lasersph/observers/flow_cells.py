"""The cells in which the melt of a round spot turns: outward or inward at their top.

The volume that rises within a distance r of the axis, per second,

    psi(r, z) = int_0^r 2 pi r' w(r', z) dr',

is Stokes' stream function: melt runs along its lines, and a cell is where it has one sign. Where it
is above zero the melt rises near the axis, flows outward above and inward below; below zero the
other way round. What turns is the largest |psi| of a cell; its height is that of the rows in which
|psi| is a tenth of this or more. A cell that turns less than a tenth of the other is none.

Left out: several cells that turn the same way count as one. Below a surface that moves melt goes
where its surface rises, and no line of psi closes: it has no cells here.
"""

from __future__ import annotations

import numpy as np

from lasersph.observers.flow_speed import flow_of
from lasersph.observers.observer import Observer, Row
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View

SHARE = 0.1
"""Part of what turns in a cell down to which it reaches, and part of the larger cell that a cell
turns at least [1]. Guard: rows beside the wall of a pool, and rounding of a cell that is none."""
CELLS = {"outward": 1.0, "inward": -1.0}
"""Cells by where they flow at their top, with the sign of psi there."""


class FlowCells(Observer):
    """Observes the cells of a section (r, z), whose particles rest below a flat surface."""

    title = "cells of the flow"
    note = (
        "A cell is outward or inward by where the melt flows at its top; it turns the volume that "
        "rises on one side of its center per second."
    )
    columns = tuple(
        one
        for name in CELLS
        for one in (
            Quantity(
                f"flow_{name}_turnover_m3_s",
                "m^3/s",
                f"volume that the {name} cell turns",
                largest=f"flow.cells.{name}_turnover_max_m3_s",
            ),
            Quantity(
                f"flow_{name}_height_m",
                "m",
                f"height of the {name} cell",
                largest=f"flow.cells.{name}_height_max_m",
            ),
        )
    )

    def observe(self, view: View) -> Row:
        """Turnover [m^3/s] and height [m] of both cells; 0 where one does not exist."""
        values = (0.0,) * len(self.columns)
        if np.any(flow_of(view).flows):
            psi, height = self._stream_function(view)
            found = [largest_of(sign * psi, height) for sign in CELLS.values()]
            strongest = max(turnover for turnover, _ in found)
            # what is much weaker than the other is no cell
            kept = [one if one[0] > SHARE * strongest else (0.0, 0.0) for one in found]
            values = (*kept[0], *kept[1])
        return self.record(view.time, values)

    def _stream_function(self, view: View) -> tuple[np.ndarray, np.ndarray]:
        """psi at the outer edges of the particles of each row (rows, longest) [m^3/s], 0 beyond
        its end, and the heights of the rows (rows,) [m]."""
        flow, r = flow_of(view), view.position[0]
        # numbers go row by row, in each outward from the axis
        begins = np.flatnonzero(np.diff(r, prepend=np.inf) < 0.0)
        rising = flow.velocity[-1] * view.volume / view.width[-1]
        psi = np.cumsum(np.where(flow.flows, rising, 0.0))
        # each row counts from its axis
        lengths = np.diff(np.append(begins, r.size))
        psi -= np.repeat(np.concatenate([[0.0], psi])[begins], lengths)
        # beyond what flows psi has no meaning
        psi = np.where(flow.flows, psi, 0.0)
        strongest = np.array(
            [np.maximum.reduceat(psi, begins), np.minimum.reduceat(psi, begins)], float
        )
        return strongest.T, view.width[-1, begins]

    def summary(self) -> dict[str, object]:
        """Nothing where nothing turned."""
        return super().summary() if any(peak.value for peak in self.peak.values()) else {}


def largest_of(psi: np.ndarray, height: np.ndarray) -> tuple[float, float]:
    """Largest psi [m^3/s], and height of the rows that have a tenth of it [m]; 0 where none is.

    Args:
        psi: (rows, values) [m^3/s], above zero in the cell. height: (rows,) of the rows [m].
    """
    of_row = np.max(psi, axis=1)
    largest = float(np.max(of_row))
    if largest <= 0.0:
        return 0.0, 0.0
    return largest, float(np.sum(height[of_row >= SHARE * largest]))
