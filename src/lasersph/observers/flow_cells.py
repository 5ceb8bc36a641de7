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

from typing import NamedTuple

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
        flow, r = flow_of(view), view.position[0]
        if np.any(flow.flows):
            rising = flow.velocity[-1] * view.volume / view.width[-1]
            psi = stream_function(r, rising, flow.flows)
            found = cells_of(psi, r, view.width[-1])
            values = tuple(
                value for name in CELLS for value in (found[name].turnover, found[name].height)
            )
        return self.record(view.time, values)

    def summary(self) -> dict[str, object]:
        """Nothing where nothing turned."""
        return super().summary() if any(peak.value for peak in self.peak.values()) else {}


class Cell(NamedTuple):
    """A cell of the flow.

    Attributes:
        turnover: largest |psi| [m^3/s]. height: of the rows that have a tenth of it [m]; both 0
            where there is no such cell. center: number of the particle with that |psi|.
    """

    turnover: float
    height: float
    center: int


def stream_function(r: np.ndarray, rising: np.ndarray, flows: np.ndarray) -> np.ndarray:
    """psi at the outer edges of particles (n,) [m^3/s], 0 where nothing flows.

    Args:
        r: (n,) [m], row by row, in each outward from the axis. rising: (n,) volume that rises in
            the ring of each per second [m^3/s]. flows: (n,) whether it flows.
    """
    begins = _row_begins(r)
    psi = np.cumsum(np.where(flows, rising, 0.0))
    # each row counts from its axis
    lengths = np.diff(np.append(begins, r.size))
    psi -= np.repeat(np.concatenate([[0.0], psi])[begins], lengths)
    # beyond what flows psi has no meaning
    return np.where(flows, psi, 0.0)


def cells_of(psi: np.ndarray, r: np.ndarray, height: np.ndarray) -> dict[str, Cell]:
    """The cells by their names.

    Args:
        psi: (n,), see `stream_function`. r: (n,) [m]. height: (n,) of the particles [m].
    """
    found = {name: _largest(sign * psi, r, height) for name, sign in CELLS.items()}
    strongest = max(one.turnover for one in found.values())
    # what is much weaker than the other is no cell
    return {
        name: one if one.turnover > SHARE * strongest else Cell(0.0, 0.0, one.center)
        for name, one in found.items()
    }


def _row_begins(r: np.ndarray) -> np.ndarray:
    """Numbers of the first particles of the rows."""
    return np.flatnonzero(np.diff(r, prepend=np.inf) < 0.0)


def _largest(psi: np.ndarray, r: np.ndarray, height: np.ndarray) -> Cell:
    """The cell in which psi is above zero."""
    begins = _row_begins(r)
    of_row, center = np.maximum.reduceat(psi, begins), int(np.argmax(psi))
    largest = float(np.max(of_row))
    if largest <= 0.0:
        return Cell(0.0, 0.0, center)
    return Cell(largest, float(np.sum(height[begins][of_row >= SHARE * largest])), center)
