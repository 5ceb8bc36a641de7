"""A surface over a grid as triangles."""

from __future__ import annotations

import numpy as np


def grid_triangles(number: np.ndarray) -> np.ndarray:
    """Numbers of the vertices of each triangle, (t, 3), counterclockwise from above.

    Args:
        number: (ny, nx) number of each vertex of the grid, y rising down and x to the right.
    """
    a, b = number[:-1, :-1].ravel(), number[:-1, 1:].ravel()
    # a, b, c, d go around each square of four columns; its diagonal runs from a to c
    c, d = number[1:, 1:].ravel(), number[1:, :-1].ravel()
    return np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
