"""The hot loops that are no linear solver: pair sums, neighbor list, enthalpy, shifting."""

from __future__ import annotations

from typing import Any

import numpy as np

from hot_loops.counting import CountingBackend
from hot_loops.functions import is_neighbor, right_hand_side
from hot_loops.hot_loop import HotLoop
from hot_loops.least import Least
from hot_loops.particles import shape_of
from lasersph.compute import search
from lasersph.compute.backend import Backend
from lasersph.materials import load_material
from lasersph.particles.neighbor_lists import NeighborList
from lasersph.physics.phase_change import state
from lasersph.sph.correction import kernel_gradient
from lasersph.sph.shifting import repulsion_terms, shift

METAL = "steel-304"


def pair_sum(backend: Backend, neighbors: NeighborList) -> HotLoop:
    """Right-hand side of weakly compressible SPH: momentum and continuity in one pass."""
    dimension, count = shape_of(neighbors)
    rng = np.random.default_rng(2)
    fields = {"v": backend.asarray(rng.random((dimension, count)))}
    fields |= {name: backend.asarray(1.0 + rng.random(count)) for name in ("rho", "p", "m")}
    out = (backend.zeros((dimension, count)), backend.zeros(count))

    def run() -> int:
        backend.pair_sum(right_hand_side, neighbors, fields, out, mu=1e-3)
        return 1

    return HotLoop(f"pair sum {dimension}-D", count, run)


def list_build(backend: Backend, neighbors: NeighborList) -> HotLoop:
    """Search for all pairs; only those that are found count as looked at."""
    dimension, count = shape_of(neighbors)
    position, support = neighbors.position, neighbors.support
    assert position is not None and support is not None

    def run() -> int:
        search.neighbor_list(backend, position, support, count, mean=neighbors.mean)
        return 1

    name = f"neighbor list {dimension}-D"
    if not isinstance(backend, CountingBackend):
        return HotLoop(name, count, run)
    read, written = (
        sum(backend.to_host(array).nbytes for array in arrays if array is not None)
        for arrays in (
            (neighbors.position, neighbors.support),
            (neighbors.row_start, neighbors.neighbor),
        )
    )
    values = backend.zeros(neighbors.neighbor.shape[0], "flag")
    tests = backend.least(lambda: backend.pair_values(is_neighbor, neighbors, {}, values))
    least = Least(read + 2.0 * written, tests.operations)
    return HotLoop(name, count, run, least)


def enthalpy_update(backend: Backend, count: int) -> HotLoop:
    """Temperature, heat potential, melt and vapor fraction from the enthalpy."""
    curve = load_material(METAL).caloric_curve(300.0)
    tables: dict[str, Any] = {
        "h_nodes": backend.asarray(curve.enthalpy),
        "T_nodes": backend.asarray(curve.temperature),
        "P_nodes": backend.asarray(curve.potential),
        "m_nodes": backend.asarray(curve.melt_fraction),
        "v_nodes": backend.asarray(curve.vapor_fraction),
    }
    highest = float(curve.enthalpy[-1])
    h = backend.asarray(np.random.default_rng(3).uniform(0.0, highest, count))
    out = tuple(backend.zeros(count) for _ in range(4))

    def run() -> int:
        backend.pointwise(state, {"h": h}, out, **tables)
        return 1

    return HotLoop("enthalpy update", count, run)


def shifting(backend: Backend, neighbors: NeighborList) -> HotLoop:
    """Displacement that keeps particles from clustering."""
    dimension, count = shape_of(neighbors)
    fields = {name: backend.asarray(np.ones(count)) for name in ("is_fluid", "at_surface")}
    fields["position"] = backend.zeros((dimension, count))
    fields["G_ij"] = backend.zeros((dimension, neighbors.neighbor.shape[0]))
    volume = {"V": backend.asarray(np.ones(count))}
    backend.pair_values(kernel_gradient, neighbors, volume, fields["G_ij"])
    out = backend.zeros((dimension, count))
    low, high = (-1.0,) * dimension, (1.0,) * dimension

    def run() -> int:
        backend.pair_sum(
            repulsion_terms,
            neighbors,
            fields,
            out,
            finish=shift,
            low=low,
            high=high,
            close_push=3.0,
            scale=0.01,
            limit=0.1,
        )
        return 1

    return HotLoop(f"shifting {dimension}-D", count, run)
