"""Additions to the weights of rings: few of them by hand, and rows that come out as in a plane."""

import numpy as np
import pytest

from lasersph import compute
from lasersph.case import Case
from lasersph.particles.extended_lattice import GHOSTS
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.conduction.body import weighing_of
from lasersph.sph.even_rings import RingPairs, ring_additions
from lasersph.sph.rings import REACH, STEPS, evened_ring_weight

DOWN, UP = REACH + 1, REACH - 1
STACKS = {
    "uniform": {"arrangement": "uniform"},
    "graded": {"arrangement": "graded", "ratio": 0.9, "coarsest": 2e-7, "fine_depth": 2e-7},
    "steep": {"arrangement": "graded", "ratio": 0.6, "coarsest": 2e-7, "fine_depth": 2e-7},
    "cubic": {"arrangement": "uniform", "kernel": "cubic-spline"},
    "wide support": {"arrangement": "uniform", "support_ratio": 6.0},
}


def pairs_of(*rows):
    """Pairs from rows of i, j, layers from i to j, those from j to i, and the weight."""
    row, other, steps, back, weight = zip(*rows, strict=True)
    whole = (np.array(part) for part in (row, other, steps, back))
    return RingPairs(*whole, np.array(weight))


def test_two_rings_above_each_other():
    """A weight of 2 that is to be 3: 1 + b + b' = 3/2, shared evenly; each sees the other."""
    wanted = np.zeros((2, STEPS))
    wanted[0, DOWN] = wanted[1, UP] = 3.0
    b = ring_additions(pairs_of((0, 1, 1, -1, 2.0), (1, 0, -1, 1, 2.0)), wanted)
    assert b[0, DOWN] == b[1, UP] == pytest.approx(0.25)
    assert np.count_nonzero(b) == 2


def test_dummies_without_additions_count_once():
    """Weight 2 toward a given temperature, to be 3: 2 (1 + b) = 3."""
    wanted = np.zeros((1, STEPS))
    wanted[0, DOWN] = 3.0
    assert ring_additions(pairs_of((0, -1, 1, -1, 2.0)), wanted)[0, DOWN] == pytest.approx(0.5)


def test_mirrored_layer():
    """A ring and its own image above the surface, weight 4 to be 3: 1 + 2 b = 3/4."""
    wanted = np.zeros((1, STEPS))
    wanted[0, UP] = 3.0
    assert ring_additions(pairs_of((0, 0, -1, -1, 4.0)), wanted)[0, UP] == pytest.approx(-0.125)


def test_two_rings_below_two():
    """Weights 2 within columns and 1 between them; both sides want 3.1 and 2.9."""
    wanted = np.zeros((4, STEPS))
    wanted[:2, DOWN] = wanted[2:, UP] = (3.1, 2.9)
    weights = {(0, 2): 2.0, (1, 3): 2.0, (0, 3): 1.0, (1, 2): 1.0}
    there = [(i, j, 1, -1, w) for (i, j), w in weights.items()]
    back = [(j, i, -1, 1, w) for (i, j), w in weights.items()]
    b = ring_additions(pairs_of(*there, *back), wanted)
    # 3 b + 2 b + b' = 0.1 with b' = -b
    assert b[:2, DOWN] == pytest.approx([0.025, -0.025])
    assert b[2:, UP] == pytest.approx([0.025, -0.025])


@pytest.mark.parametrize("wanted_below", [5.0, 100.0])
def test_what_has_no_solution_stays(wanted_below):
    """Sums that disagree between both layers, and factors that are out of range."""
    wanted = np.zeros((2, STEPS))
    wanted[0, DOWN], wanted[1, UP] = wanted_below, 100.0
    b = ring_additions(pairs_of((0, 1, 1, -1, 2.0), (1, 0, -1, 1, 2.0)), wanted)
    assert not b.any()


def test_weight_with_additions():
    """10 (1 + b_i + b_j): rings 0 and 1 of layers 3 and 4, then with none of j's."""
    table = np.zeros(2 * STEPS)
    table[DOWN], table[STEPS + UP], table[STEPS + DOWN] = 0.2, 0.1, -0.4
    assert evened_ring_weight(10.0, 3.0, 4.0, 0.0, 1.0, 0.0, table, 9.0) == pytest.approx(13.0)
    assert evened_ring_weight(10.0, 4.0, 3.0, 1.0, 0.0, 0.0, table, 9.0) == pytest.approx(13.0)
    assert evened_ring_weight(10.0, 3.0, 4.0, 0.0, 1.0, 1.0, table, 9.0) == pytest.approx(12.0)
    # layer 4 beyond the bottom of four layers sees layer 3 as one below it
    assert evened_ring_weight(10.0, 3.0, 4.0, 0.0, 1.0, 0.0, table, 4.0) == pytest.approx(8.0)
    # layers further apart than any support, and weights that would be negative
    assert evened_ring_weight(10.0, 0.0, REACH + 1.0, 0.0, 1.0, 0.0, table, 9.0) == 10.0
    assert evened_ring_weight(10.0, 3.0, 4.0, 1.0, 1.0, 0.0, table - 1.0, 9.0) == 0.0


def body_of(stack, width, spacing=5e-8):
    """Body of a section of steel."""
    particles = {"spacing": spacing, **STACKS[stack]}
    case = Case.model_validate(
        {
            "material": "steel-304",
            "domain": {"width": width, "depth": 1e-6},
            "particles": particles,
            "time": {"end": 1e-8},
            "solver": {"kind": "conduction", "dimensions": 2, "geometry": "axisymmetric"},
        }
    )
    return case, recipe_of(case).build(compute.cpu(threads=1)).body


def matrix_of(body):
    """Dense matrix of the weights between particles."""
    host, pairs = body.backend.to_host, body.pairs
    start = host(pairs.neighbors.row_start).astype(int)
    row = np.repeat(np.arange(body.count), np.diff(start))
    matrix = np.zeros((body.count, body.count))
    np.add.at(matrix, (row, host(pairs.neighbors.neighbor)), host(pairs.weights))
    return matrix


@pytest.mark.parametrize("width", [2e-7, 9e-7])
@pytest.mark.parametrize("stack", STACKS)
def test_symmetric_and_not_negative(stack, width):
    """What a ring gives another one gets, in blocks of few columns, too."""
    matrix = matrix_of(body_of(stack, width)[1])
    assert np.abs(matrix - matrix.T).max() < 1e-12 * matrix.max()
    assert matrix.min() >= 0.0


@pytest.mark.parametrize("width", [2e-7, 9e-7])
@pytest.mark.parametrize("stack", STACKS)
def test_temperatures_of_layers_change_as_in_a_plane(stack, width):
    """P by layer alone: each ring takes up its area times what a layer of a plane does, from the
    axis to the side; steep layers leave out what hardly any column sees."""
    case, body = body_of(stack, width)
    filling, count = body.filling, body.count
    layer = filling.layer[:count]
    P = np.random.default_rng(3).uniform(-1.0, 1.0, layer.max() + 1)
    matrix = matrix_of(body)
    taken = matrix @ P[layer] - matrix.sum(axis=1) * P[layer]

    # the layers of a plane, mirrored at surface and bottom
    layers = recipe_of(case).layers
    weighing = weighing_of(case.particles, layers, use_second_moment=True)
    exchange = weighing.exchange()
    total = P.size
    number = np.arange(total)[:, None] + np.arange(-GHOSTS, GHOSTS + 1)
    inside = np.where(number < 0, -1 - number, number)
    inside = np.clip(np.where(inside >= total, 2 * total - 1 - inside, inside), 0, total - 1)
    plane = np.sum(exchange * (P[inside] - P[:, None]), axis=1)
    scale = np.sum(exchange, axis=1).max()
    assert taken / filling.cross_section == pytest.approx(plane[layer], abs=1e-6 * scale)
