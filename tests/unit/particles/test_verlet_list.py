"""Neighbor lists of what moves: when they are found anew, and that no pair is missing."""

import numpy as np
import pytest
from moving_matter import DRIFTING_BLOCK, HEATED_BLOCK, go, host, moving, put, stir

from lasersph.compute.search import EscapedParticle
from lasersph.particles.kinds import GONE, INTERIOR, LEAVING
from lasersph.particles.verlet_list import (
    REST,
    LargestMotion,
    displacement_square,
    fold_position,
    position_to_list,
)

LOW, WIDTH = (0.0, -5.0), (2.0, 0.0)


def test_folding():
    """2.5 is 0.5 and -0.5 is 1.5 in a period of 2 from 0; the other axis has none."""
    assert fold_position(np.array([2.5, 9.0]), LOW, WIDTH).tolist() == [0.5, 9.0]
    assert fold_position(np.array([-0.5, 9.0]), LOW, WIDTH).tolist() == [1.5, 9.0]
    assert fold_position(np.array([2.5]), (0.0,), (2.0,)).tolist() == [0.5]


def test_places_for_the_list():
    """Where it is; where it was once it left. Only condensed matter counts as displaced."""
    x, listed = np.array([3.0, 4.0]), np.zeros(2)
    assert position_to_list(x, listed, 1.0).tolist() == [3.0, 4.0]
    assert position_to_list(x, listed, 0.0).tolist() == [0.0, 0.0]
    assert displacement_square(x, listed, INTERIOR) == 25.0
    assert displacement_square(x, listed, LEAVING) == 0.0


def test_pairs_are_found_anew_only_when_particles_have_moved():
    """At rest once, with hardly any skin; in motion each time that the skin is used up."""
    _, rest = moving("sound-wave", *HEATED_BLOCK, "laser=", "time.end=1 us")
    go(rest, steps=2)
    first = rest.pairs.now
    assert rest.pairs.skin == 1e-6 * rest.body.geometry.spacing
    go(rest, steps=2)
    assert rest.pairs.now is first
    _, drift = moving("sound-wave", *DRIFTING_BLOCK)
    stir(drift, 100.0)
    go(drift, steps=1)
    first, renewed = drift.pairs.now, 0
    assert 1e-9 < drift.pairs.skin <= 0.3e-6
    for _ in range(40):
        go(drift, steps=1)
        renewed += drift.pairs.now is not first
        first = drift.pairs.now
    assert 2 <= renewed <= 20


def test_skin_grows_with_the_displacement():
    """s^2 = 1.5 w l / d for a displacement w, but 2 w at least and what the case allows at most."""
    _, solver = moving("sound-wave", *DRIFTING_BLOCK)
    pairs, spacing = solver.pairs, solver.body.geometry.spacing
    for displacement, skin in (
        (1e-7, 1e-6),
        (1e-3, (1.5e-3 * 3.0 / 2.0) ** 0.5),
        (0.1, 0.3),
        (0.15, 0.3),
    ):
        pairs.rebuild(LargestMotion(1.0, displacement * spacing, 0.0))
        assert pairs.skin == pytest.approx(skin * spacing)


def missing(solver, size):
    """Pairs of condensed particles within the support [(i, j)] that the list does not hold."""
    x, support = host(solver, "position"), 3.0 * solver.body.geometry.spacing
    is_there = host(solver, "kind") == INTERIOR
    start = solver.backend.to_host(solver.pairs.now.row_start).astype(int)
    neighbor = solver.backend.to_host(solver.pairs.now.neighbor)
    found = []
    for i in np.flatnonzero(is_there):
        apart = x - x[:, [i]]
        apart -= size * np.round(apart / size)
        near = np.flatnonzero((np.sum(apart**2, axis=0) < support**2) & is_there)
        listed = {i, *neighbor[start[i] : start[i + 1]].tolist()}
        found += [(int(i), j) for j in near.tolist() if j not in listed]
    return found


@pytest.mark.parametrize("dimension", [1, 2, 3])
@pytest.mark.parametrize("kind", ["stirred", "vortices", "halves"])
def test_list_holds_every_pair_within_the_support(dimension, kind):
    """After each step no particle within the support is missing, whatever the velocities."""
    settings = (f"solver.dimensions={dimension}", "domain.depth=12 um", "domain.width=10 um")
    _, solver = moving("sound-wave", *DRIFTING_BLOCK, *settings)
    size = np.array([[10e-6]] * (dimension - 1) + [[12e-6]])
    z = host(solver, "position")[-1] / 12e-6
    if kind == "stirred":
        stir(solver, 100.0)
    else:
        wave = np.sin(2.0 * np.pi * z)
        speed = 100.0 * (wave if kind == "vortices" else np.sign(wave))
        put(solver, "velocity", np.broadcast_to(speed, (dimension, z.size)))
    for _ in range(12):
        go(solver, steps=1)
        assert missing(solver, size) == []


def test_what_drifts_as_one_keeps_its_list():
    """Uniform motion brings nothing nearer: one list for many steps, but not for ever."""
    _, solver = moving("sound-wave", *DRIFTING_BLOCK, "motion=")
    put(solver, "velocity", np.full((2, 120), 300.0))
    go(solver, steps=1)
    lists = {id(solver.pairs.now): solver.pairs.now}
    moved = 0.0
    for _ in range(60):
        go(solver, steps=1)
        moved += 300.0 * 2.0**0.5 * solver.state.time_step
        lists[id(solver.pairs.now)] = solver.pairs.now
    assert moved > 1.5e-6
    assert 2 <= len(lists) <= 2 + moved / 0.4e-6


def test_a_list_outlives_a_restart():
    """Whenever a run is continued, lists are renewed in the same steps, and all bits are equal."""
    solvers = [moving("sound-wave", *DRIFTING_BLOCK)[1] for _ in range(2)]
    first, second = solvers
    z = host(first, "position")[-1] / 12e-6
    put(first, "velocity", 100.0 * np.sin(2.0 * np.pi * np.array([z, z + 0.3])))
    for _ in range(10):
        go(first, steps=1)
        arrays = {name: first.backend.to_host(field) for name, field in first.fields.items()}
        second.restore(arrays, first.checkpoint_scalars())
        for solver in solvers:
            go(solver, steps=1)
        assert first.pairs.skin == second.pairs.skin
        for name in first.fields:
            assert np.array_equal(*(solver.fields[name] for solver in solvers))


def test_parts_that_meet_are_noticed():
    """Two slabs far apart, each at rest in itself: lists are renewed before they touch."""
    _, solver = moving("sound-wave", *DRIFTING_BLOCK, "motion=", "domain.depth=24 um")
    z = host(solver, "position")[-1]
    middle = 0.5 * (z.min() + z.max())
    put(solver, "kind", np.where(np.abs(z - middle) < 3.5e-6, GONE, INTERIOR))
    speed = np.array([np.zeros_like(z), np.where(z < middle, 400.0, -400.0)])
    put(solver, "velocity", speed)
    size, gap = np.array([[10e-6], [24e-6]]), np.inf
    while gap > 1.5e-6:
        go(solver, steps=1)
        assert missing(solver, size) == []
        z, kind = host(solver, "position")[-1], host(solver, "kind")
        is_low = (z < middle) & (kind == INTERIOR)
        gap = z[(z > middle) & (kind == INTERIOR)].min() - z[is_low].max()


def test_no_list_is_left_where_the_search_fails():
    """A place that is no number: what is found next is found anew."""
    _, solver = moving("sound-wave", *DRIFTING_BLOCK)
    go(solver, steps=1)
    assert solver.pairs.skin > 0.0
    whole = host(solver, "position").copy()
    put(solver, "position", whole + np.nan)
    with pytest.raises(EscapedParticle):
        solver.pairs.rebuild(REST)
    put(solver, "position", whole)
    assert solver.pairs.is_stale(REST)
