"""lasersph on the displaced block: its solver of matter that moves, and heat at rest.

Each step of the solver is the midpoint rule, two right-hand sides. Heat at rest is computed between
pairs that are weighed once, by the solver in whole steps and by the sum over the pairs alone.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from time import perf_counter, process_time

import numpy as np
import same_particles as particles
from measurement import Measurement, middle
from workplace import CASES, Workplace

from lasersph import compute
from lasersph.case import load_case
from lasersph.compute.backend import Backend
from lasersph.particles.verlet_list import REST
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.ablation.equations import pair_weight
from lasersph.solvers.ablation.solver import Ablation
from lasersph.sph.laplacian import flow

SUMS = 2
"""Right-hand sides in a step of the midpoint rule."""


@cache
def backend(threads: int) -> Backend:
    """The processors, so that loops are loaded once for all rounds."""
    return compute.cpu(threads=threads)


def timed(call: Callable[[], object], workplace: Workplace) -> tuple[float, float]:
    """Median wall and processor time of a call [s], of all segments but the first."""
    segments = []
    for _ in range(workplace.segments + 1):
        wall, processor = perf_counter(), process_time()
        for _ in range(workplace.steps):
            call()
        segments.append((perf_counter() - wall, process_time() - processor))
    return middle(segments[1:], workplace.steps)


def _block(workplace: Workplace, *, moves: bool) -> Ablation:
    """The solver with the particles that all programs are given."""
    edge = workplace.edge
    size = [f"domain.depth={edge} m", f"domain.width={edge} m"]
    case = load_case(CASES / "block.toml", size)
    solver = recipe_of(case).build(backend(workplace.threads))
    assert isinstance(solver, Ablation)
    arrays = {name: solver.backend.to_host(array) for name, array in solver.fields.items()}
    position = particles.displaced_lattice(edge, 3)
    corner = np.array([[0.5 * edge], [0.5 * edge], [1.0 * edge]])
    arrays["position"] = position - corner
    arrays["enthalpy"] = particles.warmth(position, edge)
    if moves:
        arrays["velocity"] = particles.vortices(position, edge)
    solver.restore(arrays, solver.checkpoint_scalars())
    return solver


def wcsph(workplace: Workplace) -> Measurement:
    """Whole step of weakly compressible SPH with heat."""
    solver = _block(workplace, moves=True)
    builds, last = 0, solver.pairs.listed

    def step():
        nonlocal builds, last
        solver.step(particles.STEP)
        builds += solver.pairs.now is not last
        last = solver.pairs.now

    wall, processor = timed(step, workplace)
    steps = (workplace.segments + 1) * workplace.steps
    pairs = particles.directed_pairs(workplace.edge, is_periodic=True)
    listed = solver.pairs.now.neighbor.shape[0] / pairs
    detail = {"list builds per step": builds / steps, "pairs listed per pair": listed}
    return Measurement(
        "wcsph", "lasersph", workplace.threads, workplace.edge**3, wall, processor, SUMS, pairs,
        detail,
    )  # fmt: skip


def heat(workplace: Workplace) -> Measurement:
    """Whole step of heat between particles at rest."""
    solver = _block(workplace, moves=False)
    wall, processor = timed(lambda: solver.step(particles.STEP), workplace)
    pairs = particles.directed_pairs(workplace.edge, is_periodic=True)
    return Measurement(
        "heat", "lasersph", workplace.threads, workplace.edge**3, wall, processor, SUMS, pairs
    )


def heat_sum(workplace: Workplace) -> Measurement:
    """The sum over assembled pairs alone, as every linear conduction uses it."""
    solver = _block(workplace, moves=False)
    solver.pairs.rebuild(REST)
    matter, pairs, on = solver.body, solver.pairs.now, solver.backend
    weights = on.zeros(pairs.neighbor.shape[0])
    fields = {"V": matter.now["volume"]}
    on.pair_values(pair_weight, pairs, fields, weights, factor=solver.parameters.weight_factor)
    fields = {"g_ij": weights, "P": matter.now["temperature"]}
    sums = on.zeros(matter.now.capacity)
    wall, processor = timed(lambda: on.pair_sum(flow, pairs, fields, sums), workplace)
    counted = particles.directed_pairs(workplace.edge, is_periodic=True)
    detail = {"GB/s of values and neighbors": 12e-9 * counted / workplace.time(wall, processor)}
    return Measurement(
        "heat-sum", "lasersph", workplace.threads, workplace.edge**3, wall, processor, 1, counted,
        detail,
    )  # fmt: skip
