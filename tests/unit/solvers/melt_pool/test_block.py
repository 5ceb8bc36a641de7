"""The block of moving particles: ghosts that follow, symmetric weights, terms of walls."""

import numpy as np
import pytest
from flow_boxes import (
    PERIODIC,
    PERIODIC_HEAT,
    block_of,
    box,
    jittered,
    matrix_of,
    place_of,
    start_from,
)

from lasersph import compute, load_case
from lasersph.compute.search import EscapedParticle
from lasersph.particles.ghosts import Reach
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.melt_pool.block_terms import inner_weight, wall_terms

CHANNEL = {"left": "periodic", "right": "periodic", "bottom": "no-slip",
           "surface": {"kind": "moving-wall", "velocity": 1.0}}  # fmt: skip
BOXES = {
    "walls": {},
    "periodic": {"flow": PERIODIC, "heat": PERIODIC_HEAT},
    "channel": {"flow": CHANNEL, "heat": {"sides": "periodic"}},
    "plain weights": {"weights": "plain"},
}


def ghosts_of(block):
    """Positions, sources, signs and offsets of the ghosts on the host."""
    host, ghosts = block.backend.to_host, block.ghosts.particles
    types, of_type = ghosts.ghost_types, host(ghosts.ghost_type).astype(int)
    signs = types.sign[:, of_type], types.offset[:, of_type]
    parts = host(block.pairs.position), host(block.ghosts.source), *signs
    return tuple(part[..., block.count : ghosts.total] for part in parts)


def test_ghosts_follow_their_sources():
    """After a move every ghost lies where its source's new place puts it."""
    solver = box()
    block = block_of(solver)
    moved = jittered(solver, 0.3)
    block.move(solver.backend.asarray(moved))
    place, source, sign, offset = ghosts_of(block)
    assert source.size > 100
    assert place == pytest.approx(sign * moved[:, source] + offset)
    beyond = np.abs(place - np.array([[0.0], [-0.5]])) > 0.4
    assert beyond.any(axis=0).all()


DOTS = (
    "particles.spacing=100 nm", "particles.coarsest=0.6 um", "domain.depth=2.4 um",
    "domain.width=2.5 um", "laser.beam.period=2.5 um",
)  # fmt: skip
GRADED = {
    "flat": ("dlip-steel", ("solver.kind=melt-pool", "particles.spacing=100nm")),
    "moving": ("texture-steel", ("particles.spacing=60nm",)),
    "rings": ("spot-steel", ("particles.spacing=60nm",)),
    "space": ("texture-dots-steel", DOTS),
}
"""Pools whose layers grow thick below them, in halves and quarters of periods."""


def images_of_rows(block):
    """What the rows that were found see: (row, source, type) of each pair, sorted."""
    host, pairs, ghosts = block.backend.to_host, block.pairs, block.ghosts.particles
    start = host(pairs.row_start).astype(int)
    row = np.repeat(np.arange(start.size - 1), np.diff(start))
    neighbor = host(pairs.neighbor)[: row.size]
    sources, types = host(ghosts.source)[neighbor], host(ghosts.ghost_type)[neighbor]
    found = np.array([row, sources, types], int)
    return found[:, np.lexsort(found[::-1])]


@pytest.mark.parametrize("name", GRADED)
def test_ghosts_left_out_are_seen_by_nobody(name):
    """Rows have the pairs that they have where there are more ghosts, of all particles as far from
    a face as the coarsest sees."""
    case, settings = GRADED[name]
    solver = recipe_of(load_case(case, settings)).build(compute.cpu(threads=1))
    hot = place_of(solver)[-1] > -0.7 * solver.domain.fine_depth
    curve = solver.body.curve
    rising = np.concatenate([[True], np.diff(curve.temperature) > 0.0])
    T = np.where(hot, 2500.0, 1500.0)
    start_from(solver, np.interp(T, curve.temperature[rising], curve.enthalpy[rising]))
    block = block_of(solver)
    block.find_pairs(solver.position, None)
    found, total = images_of_rows(block), block.ghosts.particles.total

    # as if everybody saw as far as the coarsest
    layers, backend = block.layers, solver.backend
    everywhere = backend.zeros(block.count)
    backend.fill(everywhere, layers.search_radius)
    layers.reach = Reach(layers.reach.radius, everywhere, np.inf)
    block.find_pairs(solver.position, None)
    assert np.array_equal(found, images_of_rows(block))
    assert block.ghosts.particles.total > 1.05 * total


def test_supports_are_whole():
    """Every particle of a lattice has the 44 neighbors of [Demuth2020], the corner as well."""
    solver = box()
    block = block_of(solver)
    host = solver.backend.to_host
    start, neighbor = host(block.pairs.row_start).astype(int), host(block.pairs.neighbor)
    place = host(block.pairs.position)
    for i in (0, 5, 55, 99):
        to = neighbor[start[i] : start[i + 1]]
        r = np.linalg.norm(place[:, to] - place[:, [i]], axis=0)
        assert (r < 0.375).sum() == 44


def smallest(solver, block):
    """Smallest distance of any two particles or ghosts."""
    (square,) = block.smallest_distance(solver.position, solver.kinds.fluid_rows)
    return square**0.5


@pytest.mark.parametrize("name", BOXES)
def test_weights_are_symmetric(name):
    """Ghosts replaced by their sources: what goes from i to j arrives, wherever particles lie."""
    solver = box(**BOXES[name])
    block = block_of(solver, jittered(solver))
    g = matrix_of(solver.backend, block.without_ghosts(), block.weights, block.count)
    assert np.abs(g - g.T).max() < 1e-11 * g.max()


@pytest.mark.parametrize("name", BOXES)
def test_weights_are_symmetric_far_from_the_first_layer(name):
    """The same where particles have changed places with others of quite other layers."""
    solver = box(**BOXES[name])
    place = jittered(solver)
    place = place[:, np.random.default_rng(3).permutation(place.shape[1])]
    block = block_of(solver, place)
    g = matrix_of(solver.backend, block.without_ghosts(), block.weights, block.count)
    assert np.abs(g - g.T).max() < 1e-11 * g.max()


def test_weights_move_with_the_particles():
    """`move` gives the weights that a new search gives."""
    solver = box()
    block = block_of(solver)
    moved = jittered(solver, 0.05)
    block.move(solver.backend.asarray(moved))
    g = matrix_of(solver.backend, block.without_ghosts(), block.weights, block.count)
    block = block_of(solver, moved)
    again = matrix_of(solver.backend, block.without_ghosts(), block.weights, block.count)
    assert g == pytest.approx(again, abs=1e-12 * g.max())


def test_velocities_of_ghosts():
    """As the rules of the sides say, for every ghost: S v + c."""
    solver = box()
    block = block_of(solver)
    host, backend = solver.backend.to_host, solver.backend
    v = np.random.default_rng(2).normal(size=(2, solver.body.count))
    found = host(block.ghosts.extend_velocity(backend.asarray(v), backend.zeros(solver.body.count)))
    found = found[:, : block.ghosts.particles.total]
    place, source, *_ = ghosts_of(block)
    assert np.array_equal(found[:, : block.count], v)
    above = (place[1] > 0.0) & (np.abs(place[0]) < 0.5)
    below = (place[1] < -1.0) & (np.abs(place[0]) < 0.5)
    lid = np.array([[2.0], [0.0]])
    assert found[:, block.count :][:, above] == pytest.approx(lid - v[:, source[above]])
    assert found[:, block.count :][:, below] == pytest.approx(-v[:, source[below]])


def test_smallest_distance():
    """Of two particles, and of a particle and its own ghost."""
    solver = box()
    block_of(solver)
    place = place_of(solver)
    assert smallest(solver, block_of(solver)) == pytest.approx(0.1)
    close = place.copy()
    close[:, 45] = close[:, 44] + [0.03, 0.0]
    block = block_of(solver, close)
    assert smallest(solver, block) == pytest.approx(0.03)
    wall = place.copy()
    wall[1, 4] = -0.01
    block = block_of(solver, wall)
    assert smallest(solver, block) == pytest.approx(0.02)


def test_terms_of_a_dirichlet_face():
    """Particle 1 above a floor at z = -2, ghost 3 below it: c = (1 + 3) / 1, no power."""
    x_i, x_j, down = np.array([0.0, -1.0]), np.array([5.0, -5.0]), np.array([0.0, -1.0])
    coefficient, flow, heat, power = wall_terms(0.5, 1.0, 7.0, 11.0, 0.0, down, 2.0, x_i, x_j, 0.1)
    assert (coefficient, flow, heat, power) == (2.0, 14.0, 22.0, 0.0)
    assert inner_weight(0.5, 1.0) == 0.0


def test_a_particle_above_the_tangent_of_its_neighbor():
    """Below a surface that bends x_i may lie beyond the plane of the ghost of j: (0.2 + 3) / 0.2
    with the least distance 0.2, and no leap of the heat."""
    x_i, x_j, up = np.array([0.0, 0.1]), np.array([2.0, 3.0]), np.array([0.0, 1.0])
    coefficient, _, heat, _ = wall_terms(0.5, 1.0, 0.0, 11.0, 0.0, up, 0.0, x_i, x_j, 0.2)
    assert (coefficient, heat) == pytest.approx((8.0, 88.0), rel=1e-14)


def test_terms_of_a_neumann_face():
    """2 q n_j g with the ghost 3 beyond the face; the pair still conducts between particles."""
    x_i, x_j, down = np.array([0.0, -1.0]), np.array([5.0, -5.0]), np.array([0.0, -1.0])
    coefficient, _, _, power = wall_terms(0.5, 0.0, 0.0, 0.0, 10.0, down, 2.0, x_i, x_j, 0.1)
    assert (coefficient, power) == (0.0, 2.0 * 10.0 * 3.0 * 0.5)
    assert inner_weight(0.5, 0.0) == 0.5


def test_a_pair_inside_has_no_wall():
    """A neighbor that is no ghost: rules of zero give nothing."""
    x = np.array([0.0, -1.0])
    assert wall_terms(0.5, 0.0, 0.0, 0.0, 0.0, np.zeros(2), 0.0, x, x, 0.1)[0] == 0.0
    assert wall_terms(0.5, 0.0, 0.0, 0.0, 0.0, np.zeros(2), 0.0, x, x, 0.1)[3] == 0.0


@pytest.mark.parametrize("share", [0.0, 0.2])
def test_power_of_a_neumann_face(share):
    """What enters through a face of 10 W/m2 over 1 m, lattice or not: 10 W per meter."""
    heat = {"left": "prescribed-flux", "left_flux": 10.0}
    solver = box(flow={}, heat=heat)
    block = block_of(solver, jittered(solver, share))
    out = [solver.backend.zeros(block.count) for _ in range(4)]
    fields = {"g_ij": block.weights} | block.walls.rules
    solver.backend.pair_sum(
        wall_terms, block.pairs, fields, tuple(out), min_distance=block.walls.min_distance
    )
    total = solver.backend.to_host(out[3]).sum()
    assert total == pytest.approx(10.0, rel=1e-9 if share == 0.0 else 0.05)


@pytest.mark.parametrize("wrong", [5.0, -1e30, np.nan, np.inf])
def test_escaped_particle(wrong):
    """A place far beyond the faces, or none at all, raises what a step is retried on."""
    solver = box()
    place = place_of(solver)
    place[0, 7] = wrong
    with pytest.raises(EscapedParticle):
        block_of(solver, place)


FLANK = "[[0, 3e-7], [0.8e-6, 3e-7], [1.5e-6, -3e-7], [5.05e-6, -3e-7]]"
"""Relief [m] that falls by 0.6 um at 41 degrees."""


def test_no_ghost_of_what_lies_deep_below_a_flank():
    """Across the tangent it would lie far from the flank, at its foot: as large as a coarse cell,
    among fine particles."""
    settings = "particles.spacing=100nm", "particles.fine_depth=1um"
    case = load_case("texture-steel", (*settings, f"solver.flow.initial_surface.rows={FLANK}"))
    solver = recipe_of(case).build(compute.cpu(threads=1))
    solver.domain.cover_fine_layers()
    block = solver.domain.block_for(solver.position, solver.kinds)
    block.find_pairs(solver.position, None)
    host = block.backend.to_host
    start, neighbor = host(block.pairs.row_start).astype(int), host(block.pairs.neighbor)
    neighbor = neighbor[: start[-1]]
    near = host(solver.domain.surface.ghosts.distance)[: block.count] < block.layers.moving_support
    volume, seen = host(block.V), np.repeat(near, np.diff(start))
    assert volume.max() > 5.0 * volume[: block.count][near].max()
    assert volume[neighbor[seen]].max() < 1.5 * volume[: block.count][near].max()
