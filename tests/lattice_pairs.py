"""All pairs of a lattice with their weights, dummies kept apart: for tests of operators."""

from dataclasses import dataclass

import numpy as np

from lasersph import compute
from lasersph.particles import Domain, Geometry, Lattice
from lasersph.particles.extended_lattice import MIRROR
from lasersph.particles.filling import Filling, fill
from lasersph.particles.layers import Layers, stack
from lasersph.particles.neighbor_lists import find_neighbors
from lasersph.particles.support import arithmetic, graded
from lasersph.sph.kernels import kernel
from lasersph.sph.laplacian import layered_weight, weight
from lasersph.sph.second_moment import layer_factors


@dataclass(frozen=True)
class Pairs:
    """Pairs (i, j) of a filling with weights g."""

    layers: Layers
    filling: Filling
    i: np.ndarray
    j: np.ndarray
    g: np.ndarray

    def offset(self, axis):
        """x_i - x_j along an axis [m]."""
        return self.filling.position[axis, self.i] - self.filling.position[axis, self.j]

    def flux_through_planes(self):
        """Heat per area through the plane under each layer, for a unit gradient along z.

        Exact is 1. The first and last planes near a face are meaningless: pairs of two
        dummies are not in the list.
        """
        layer = self.filling.layer
        area = np.prod([upper - lower for lower, upper in self.layers.bounds])
        upper, lower = layer[self.i], layer[self.j]
        heat = self.g * np.abs(self.offset(-1))
        flux = [
            heat[(upper <= plane) & (lower > plane)].sum()
            for plane in range(self.layers.thickness.size - 1)
        ]
        return np.array(flux) / area


def pairs_of(dimension, name="quintic-spline", *, ratio=3.75, corrected=True, is_graded=True,
             fine_layers=12, depth=2.2e-6):  # fmt: skip
    """Pairs of a block with mirrored faces, 0.1 um spacing, graded below `fine_layers`."""
    spacing = 1e-7
    domain = Domain(depth=depth, width=8e-7 if dimension > 1 else None)
    arrangement = "graded" if is_graded else "uniform"
    lattice = Lattice(spacing=spacing, arrangement=arrangement, coarsest=4e-7)
    layers = stack(domain, lattice, Geometry(dimension), fine_layers * spacing)
    filling = fill(layers, surface=MIRROR, bottom=MIRROR, sides=MIRROR)
    backend = compute.cpu(threads=2)
    shape, mean = kernel(name, dimension), graded if is_graded else arithmetic
    neighbors = find_neighbors(
        backend, backend.asarray(filling.position), backend.asarray(ratio * filling.width[-1]),
        filling.count, kernel=shape, mean=mean,
    )  # fmt: skip
    j = backend.to_host(neighbors.neighbor).astype(np.int64)
    g = backend.zeros(j.size)
    fields = {"V": backend.asarray(filling.volume)}
    if corrected:
        normal, lateral = layer_factors(layers, shape, ratio, mean).at(filling.layer)
        fields |= {
            "layer": backend.asarray(filling.layer), "normal": backend.asarray(normal),
            "lateral": backend.asarray(lateral),
        }  # fmt: skip
        up = (0.0,) * (dimension - 1) + (1.0,)
        backend.pair_values(layered_weight, neighbors, fields, g, up=up)
    else:
        backend.pair_values(weight, neighbors, fields, g)
    start = backend.to_host(neighbors.row_start).astype(np.int64)
    i = np.repeat(np.arange(filling.count), np.diff(start))
    return Pairs(layers, filling, i, j, backend.to_host(g))
