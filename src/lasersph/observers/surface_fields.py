"""Fields of a surface that moves, at its columns: temperature, height, speed and velocity.

A column has the mean of the surface particles within its width, with linear weights along each
axis; one without any has the values of the nearest column that has.
"""

from __future__ import annotations

import numpy as np

from lasersph.observers.area_relief import AreaRelief
from lasersph.observers.relief import Relief
from lasersph.observers.view import View

UNITS = {"temperature": "K", "height": "m", "speed": "m/s", "velocity": "m/s"}


def surface_points(view: View) -> np.ndarray:
    """Middles of the columns at their heights, (dim, columns) [m]; x slowest in 3-D.

    Raises:
        ValueError: a surface that does not move.
    """
    relief = relief_of(view)
    return np.stack([*(axis.ravel() for axis in grid_of(relief)), relief.height.ravel()])


def surface_fields(view: View) -> dict[str, np.ndarray]:
    """Fields of `UNITS` at the columns, (columns,) and, of the velocity along the surface, (dim,
    columns), 0 along z; in single precision.

    Raises:
        ValueError: a surface that does not move.
    """
    relief, flow = relief_of(view), view.flow
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
    fields = {
        "temperature": found[0],
        "height": relief.height.ravel(),
        "speed": np.linalg.norm(found[1:], axis=0),
        "velocity": along,
    }
    return {name: values.astype(np.float32) for name, values in fields.items()}


def relief_of(view: View) -> Relief | AreaRelief:
    """Heights of the surface. Raises ValueError where it stays flat."""
    if view.relief is None:
        raise ValueError("the surface of this run does not move")
    return view.relief


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
