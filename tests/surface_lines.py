"""Height fields with one axis, as sections have them."""

from lasersph.surface.height_field import HeightField


def line_of(start, width, count, ends, cutoff):
    """A line of columns of one width [m] from `start` [m] on."""
    return HeightField((start,), (width,), (count,), (ends,), cutoff)
