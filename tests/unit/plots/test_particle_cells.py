"""Cells of a section through space: no holes where particles have flowed off the plane."""

import numpy as np

from lasersph.plots.particle_map import cells_of_cut


def test_flowing_particles_leave_no_holes():
    """Rows beside the plane, disordered by 0.4 of their width along y: each pixel shows one."""
    counts, width = (8, 3, 5), 1.0
    place = np.stack(np.meshgrid(*map(np.arange, counts), indexing="ij")).reshape(3, -1) + 0.5
    place[2] -= counts[2]
    place[1] += np.random.default_rng(3).uniform(-0.4, 0.4, place.shape[1])
    step = {"position": place, "width": np.full(place.shape, width)}
    cells = cells_of_cut(step, 4.0)
    shown = cells.picture(pixels=(40, 64))
    assert (shown >= 0).all()
    assert np.abs(place[1, np.unique(shown)]).max() < width
