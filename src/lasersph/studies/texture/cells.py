"""A unit cell: what the run of one period of a pattern says at each place of the period.

    height        of the surface at the end of the run, from the original surface [m]
    melt_depth    depth below the original surface down to which half has ever been molten [m]
    temperature   largest of the surface, ever [K]
    speed         largest of the surface, ever [m/s]

The largest values are those of the snapshots. The depth of the melt lies between two rows of
particles as `observers.melt_pool` puts it, by the largest melt fractions and temperatures that
particles of a column had; deep particles melt where they lay at the start.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lasersph.output import OutputError, Run

Array = NDArray[np.float64]
UNITS = {"height": "m", "melt_depth": "m", "temperature": "K", "speed": "m/s"}
HALF = 0.5
PERIOD_FITS = 1e-6
"""Rounding of a width that must be the period."""


@dataclass(frozen=True, eq=False)
class Cell:
    """One period of a pattern after a pulse.

    Attributes:
        x: (columns,) places, rising, one period from its brightest line at 0 [m].
        values: (columns,) of each name of `UNITS`; (columns, rows) of dots.
        is_solid: whether nothing is molten at the end of the run.
        y: (rows,) places along y of dots [m]; None of lines.
    """

    x: Array
    values: dict[str, Array]
    is_solid: bool
    y: Array | None = None


def read_cell(run: Run, period: float) -> Cell:
    """The cell of a complete run over one period or half of it, from x = 0.

    Raises:
        OutputError: the surface does not move, there are no snapshots, or another width.
    """
    if not len(run.surface) or not len(run.snapshots):
        raise OutputError(f"{run.path} holds no surface that moved")
    # the run covers one period or the half of an even one
    x, height = run.surface[-1]["position"]
    spacing = (x[-1] - x[0]) / (x.size - 1)
    width = spacing * x.size
    is_half = abs(width - 0.5 * period) < PERIOD_FITS * period
    if not is_half and abs(width - period) > PERIOD_FITS * period:
        raise OutputError(f"{run.path} is {width:g} m wide, not one period of {period:g} m")

    def columns_of(places: Array) -> NDArray[np.int64]:
        return np.floor((places - (x[0] - 0.5 * spacing)) / spacing).astype(int)

    # largest values over the snapshots, of particles and of the surface
    first = run.snapshots[0]
    melted, hottest = largest_of_particles(run)
    temperature, speed = np.zeros(x.size), np.zeros(x.size)
    for step in run.snapshots:
        # a surface that flows has values of its own; else those of the uppermost particle
        top = uppermost(step, columns_of(step["position"][0]))
        at, wet = step["position"][0, top], (step["surface"][top] > 0) & (step["flows"][top] > 0)
        found = np.where(wet, step["surface_temperature"][top], step["temperature"][top])
        np.maximum(temperature, np.interp(x, at, found), out=temperature)
        along = np.where(wet, np.abs(step["surface_velocity"][top]), 0.0)
        np.maximum(speed, np.interp(x, at, along), out=speed)

    # depth of the melt, then the mirrored half, in the order of x
    material = run.summary["material"]
    melting = 0.5 * (material["solidus_K"] + material["liquidus_K"])
    depth = depth_below(columns_of(first["position"][0]), x.size, first, melted, hottest, melting)
    values = {"height": height, "melt_depth": depth, "temperature": temperature, "speed": speed}
    if is_half:
        x = np.concatenate([x, period - x[::-1]])
        values = {name: np.concatenate([one, one[::-1]]) for name, one in values.items()}
    order = np.argsort(x % period, kind="stable")
    ordered = {name: np.array(one, float)[order] for name, one in values.items()}
    is_solid = not run.summary.get("melt", {}).get("molten_at_end", False)
    return Cell((x % period)[order], ordered, is_solid)


def largest_of_particles(run: Run) -> tuple[Array, Array]:
    """Largest melt fraction and temperature [K] of each particle over the snapshots, (n,).

    Raises:
        OutputError: particles come or go.
    """
    shape = run.snapshots[0]["temperature"].shape
    melted, hottest = np.zeros(shape), np.zeros(shape)
    for step in run.snapshots:
        if step["temperature"].shape != shape:
            raise OutputError(f"{run.path}: the number of particles changes")
        np.maximum(melted, step["melt_fraction"], out=melted)
        np.maximum(hottest, step["temperature"], out=hottest)
    return melted, hottest


def uppermost(step: dict[str, Array], column: NDArray[np.int64]) -> NDArray[np.int64]:
    """Number of the uppermost particle of each column that has one, in order of x."""
    # later writes win: from below to the top
    upward = np.argsort(step["position"][1], kind="stable")
    top = np.full(int(column.max()) + 1, -1)
    top[column[upward]] = upward
    top = top[top >= 0]
    return top[np.argsort(step["position"][0, top], kind="stable")]


def depth_below(
    column: NDArray[np.int64],
    columns: int,
    first: dict[str, Array],
    melted: Array,
    hottest: Array,
    melting: float,
) -> Array:
    """Depth [m] of each column (columns,) down to which half has been molten; 0 where nothing has.

    Args:
        column: (n,) of each particle. first: the snapshot at the start.
        melted, hottest: (n,) largest melt fraction and temperature [K] of each particle.
        melting: middle of the melting range [K].
    """
    z, found = first["position"][-1], np.zeros(columns)
    spacing = np.min(first["width"][0])
    is_fine = np.abs(first["width"][0] - spacing) < PERIOD_FITS * spacing
    # particles column by column, each from the top down
    fine = np.flatnonzero(is_fine)
    fine = fine[np.lexsort((-z[fine], column[fine]))]
    begins = np.searchsorted(column[fine], np.arange(columns + 1))
    for k in np.unique(column[(melted >= HALF) & is_fine]):
        # the deepest that was half molten
        rows = fine[begins[k] : begins[k + 1]]
        deepest = int(np.flatnonzero(melted[rows] >= HALF)[-1])
        if deepest + 1 == rows.size:
            found[k] = -z[rows[deepest]] + 0.5 * first["width"][-1, rows[deepest]]
            continue
        # half molten between two particles, by melt fraction, and by temperature where they differ
        a, b = rows[deepest], rows[deepest + 1]
        share = (melted[a] - HALF) / (melted[a] - melted[b])
        if hottest[a] > hottest[b]:
            warm = (hottest[a] - melting) / (hottest[a] - hottest[b])
            share = 0.5 * (share + min(max(warm, 0.0), 1.0))
        found[k] = -(z[a] + share * (z[b] - z[a]))
    return found
