"""Fields of a surface at its columns: temperature, speed and velocity, and height where it moves.

A section has columns where its surface moves, a body in 3-D below a flat one as well. A column has
the mean of the surface particles within its width, with linear weights along each axis; one
without any has the values of the nearest column that has.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from lasersph.observers.area_relief import AreaRelief
from lasersph.observers.even_places import value_at_zero
from lasersph.observers.flow_speed import flow_of
from lasersph.observers.relief import Relief
from lasersph.observers.view import View

UNITS = {"temperature": "K", "height": "m", "speed": "m/s", "velocity": "m/s"}


def surface_points(view: View) -> np.ndarray:
    """Middles of the columns at their heights, (dim, columns) [m]; x slowest in 3-D.

    Raises:
        ValueError: a surface without columns.
    """
    relief = columns_of(view)
    return np.stack([*(axis.ravel() for axis in grid_of(relief)), relief.height.ravel()])


def surface_fields(view: View) -> dict[str, np.ndarray]:
    """Fields of `UNITS` at the columns, (columns,) and, of the velocity along the surface, (dim,
    columns), 0 along z; in single precision. A flat surface has no height.

    Raises:
        ValueError: a surface without columns.
    """
    relief, flow = columns_of(view), view.flow
    lateral = view.dimension - 1
    surface = view.surface if flow is None else flow.surface
    temperature = view.temperature[surface] if flow is None else flow.surface_temperature
    velocity = np.zeros((lateral, surface.size))
    if flow is not None:
        velocity = np.reshape(flow.surface_velocity, (lateral, surface.size))
    # temperature and velocity of the particles, brought to the columns
    places = view.position[:-1, surface]
    found = at_columns(relief, places, np.stack([temperature, *velocity]))
    along = np.concatenate([found[1:], np.zeros((1, found.shape[1]))])
    height = {} if view.relief is None else {"height": relief.height.ravel()}
    fields = {
        "temperature": found[0],
        **height,
        "speed": np.linalg.norm(found[1:], axis=0),
        "velocity": along,
    }
    return {name: values.astype(np.float32) for name, values in fields.items()}


class SurfaceLine(NamedTuple):
    """Surface along x, at y = 0 in 3-D: places (m,) in order [m], size of the velocity along x
    [m/s], whether it flows, temperature [K]."""

    x: np.ndarray
    speed: np.ndarray
    flows: np.ndarray
    temperature: np.ndarray


def line_along_x(view: View) -> SurfaceLine:
    """The particles at the surface of a section; in 3-D the line y = 0 of its columns.

    Raises:
        ValueError: a surface in 3-D without columns, or a run without flow.
    """
    flow = flow_of(view)
    row, flows = flow.surface, flow.flows[flow.surface]
    if view.dimension < 3:
        x, T = view.position[0, row], view.temperature[row]
        return SurfaceLine(x, flow.surface_speed, flows, T)
    # values at the columns, and from there at y = 0, about which the velocity along x is even
    columns = columns_of(view)
    assert isinstance(columns, AreaRelief)
    values = np.stack([view.temperature[row], flow.surface_velocity[0], flows])
    found = at_columns(columns, view.position[:-1, row], values)
    by_row = np.moveaxis(found.reshape(-1, *columns.height.shape), 2, 0)
    T, u, wet = value_at_zero(columns.y, by_row)
    return SurfaceLine(columns.x, np.abs(u), wet > 0.5, T)


def columns_of(view: View) -> Relief | AreaRelief:
    """Columns of the surface. Raises ValueError where it has none."""
    columns = view.columns if view.relief is None else view.relief
    if columns is None:
        raise ValueError("the surface of this run has no columns")
    return columns


def grid_of(relief: Relief | AreaRelief) -> list[np.ndarray]:
    """Places of the columns along each axis, of the shape of the heights [m]."""
    axes = (relief.x, relief.y) if isinstance(relief, AreaRelief) else (relief.x,)
    return list(np.meshgrid(*axes, indexing="ij"))


def at_columns(relief: Relief | AreaRelief, places: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Values of particles at the columns of a surface, (fields, columns).

    Args:
        places: (d - 1, s) of the particles [m]. values: (fields, s).
    """
    from scipy.ndimage import distance_transform_edt

    is_area = isinstance(relief, AreaRelief)
    axes = (relief.x, relief.y) if is_area else (relief.x,)
    beyond = relief.beyond if is_area else (relief.beyond,)
    shape = relief.height.shape
    total, weight = np.zeros((values.shape[0], *shape)), np.zeros(shape)

    # number of the column below and above along each axis, with the weight of each
    sides = []
    for axis, place, kind in zip(axes, places, beyond, strict=True):
        number = (place - axis[0]) / ((axis[-1] - axis[0]) / (axis.size - 1))
        lower = np.floor(number).astype(int)
        share = number - lower
        ends = (lower, lower + 1)
        ends = [n % axis.size if kind == "periodic" else n.clip(0, axis.size - 1) for n in ends]
        sides.append(((ends[0], 1.0 - share), (ends[1], share)))
    for corner in np.ndindex(*(2,) * len(sides)):
        chosen = [sides[k][end] for k, end in enumerate(corner)]
        column = tuple(number for number, _ in chosen)
        part = np.ones(places.shape[1])
        for _, share in chosen:
            part = part * share
        np.add.at(weight, column, part)
        for k in range(values.shape[0]):
            np.add.at(total, (k, *column), part * values[k])

    # columns that no particle is near
    known = weight > 0.0
    mean = total / np.where(known, weight, 1.0)
    nearest = np.zeros((len(shape), *shape), np.int32)
    distance_transform_edt(~known, return_distances=False, return_indices=True, indices=nearest)
    return mean[(slice(None), *nearest)].reshape(values.shape[0], -1)
