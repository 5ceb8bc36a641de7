"""Weights of coarse columns and across to fine ones: symmetric, and exact for straight lines."""

import numpy as np
import pytest

from lasersph import compute
from lasersph.case import Case
from lasersph.simulation.recipes import recipe_of

ROOMS = {
    "plane": {"solver": {"dimensions": 2}},
    "section": {"solver": {"dimensions": 2, "geometry": "axisymmetric"}},
    "space": {"solver": {"dimensions": 3}, "particles": {"kernel": "cubic-spline"}},
}


def body_of(name, fine_width, **boundaries):
    """The body of a block of steel with columns that grow beside a width [m]."""
    room = ROOMS[name]
    case = Case.model_validate(
        {
            "material": "steel-304",
            "domain": {"width": 1.2e-5, "depth": 2e-6},
            "particles": {
                "spacing": 2e-7, "arrangement": "graded", "ratio": 0.8, "coarsest": 4e-7,
                "fine_depth": 1e-6, "fine_width": fine_width,
            } | room.get("particles", {}),
            "boundaries": boundaries,
            "time": {"end": 1e-8},
            "solver": {"kind": "conduction", **room["solver"]},
        }
    )  # fmt: skip
    backend = compute.cpu(threads=1)
    return backend, recipe_of(case).build(backend).body


def pairs_of(backend, body):
    """Row, neighbor and weight of all pairs on the host."""
    pairs = body.pairs
    start = backend.to_host(pairs.neighbors.row_start).astype(int)
    row = np.repeat(np.arange(body.count), np.diff(start))
    return (
        row,
        backend.to_host(pairs.neighbors.neighbor).astype(int),
        backend.to_host(pairs.weights),
    )


@pytest.mark.parametrize("name", ROOMS)
def test_symmetric_and_positive(name):
    """What a particle gives its neighbor gets, to rounding; no weight is negative."""
    backend, body = body_of(name, 1.6e-6)
    i, j, g = pairs_of(backend, body)
    assert body.filling.beside is not None
    random = np.random.default_rng(2).normal(size=(2, body.count))
    there, back = (np.sum(g * one[i] * other[j]) for one, other in (random, random[::-1]))
    assert there == pytest.approx(back, rel=1e-12)
    assert g.min() > -1e-12 * g.max()


@pytest.mark.parametrize("name", ROOMS)
def test_flux_through_planes(name):
    """A unit gradient along x (r) flows through every plane, fine, coarse and between both.

    Beside the axis rings conduct along r less than they should, by the square of the spacing.
    """
    backend, body = body_of(name, 2.4e-6)
    i, j, g = pairs_of(backend, body)
    x, extents = body.filling.position[0], (1.2e-5, 2e-6)
    columns = body.filling.beside.columns
    edges = columns.edges[0][columns.edges[0] > 1.8e-6]
    last = 6e-6 if name != "section" else 1.2e-5
    for plane in edges[edges < last - 1e-9]:
        crossing = (x[i] < plane) & (x[j] > plane)
        heat = np.sum((g * (x[j] - x[i]))[crossing])
        area = {"plane": 1.0, "section": 2.0 * np.pi * plane, "space": extents[0]}[name]
        assert heat == pytest.approx(area * extents[1], rel=2e-2 if name == "space" else 4e-3)


def test_rises_along_the_layers_are_at_rest():
    """Particles away from all faces take up no heat from a unit gradient along x: no more than
    1e-3 of what flows through them, where fine and coarse columns meet, too."""
    backend, body = body_of("plane", 1.6e-6)
    i, j, g = pairs_of(backend, body)
    x, z = body.filling.position[:, : body.count]
    left = np.bincount(i, g * (x[j] - x[i]), minlength=body.count)
    inner = (np.abs(x) < 4e-6) & (z < -6e-7) & (z > -1e-6)
    assert np.abs(left[inner]).max() < 2e-3 * 2e-7


def test_rises_with_depth_flow_evenly():
    """A unit gradient along z flows through all planes between layers as in fine columns alone."""
    backend, body = body_of("plane", 1.6e-6)
    i, j, g = pairs_of(backend, body)
    z, layer = body.filling.position[1], body.filling.layer
    for plane in range(1, 6):
        crossing = (layer[i] <= plane) & (layer[j] > plane)
        heat = np.sum((g * (z[i] - z[j]))[crossing])
        assert heat == pytest.approx(1.2e-5, rel=3e-3)


def test_given_temperatures_of_faces():
    """At rest between a cold bottom and a hot right side, heat through coarse cells is that of the
    face: A = area over half a cell."""
    backend, body = body_of("plane", 1.6e-6, right="fixed-temperature", right_temperature=500.0)
    a = backend.to_host(body.pairs.boundary_coefficient)
    width = body.filling.width[:, : body.count]
    touched = np.flatnonzero(a > 0.0)
    assert np.all(body.filling.position[0, touched] + 0.5 * width[0, touched] > 5.999e-6)
    assert a[touched] == pytest.approx(2.0 * width[1, touched] / width[0, touched])


def test_prescribed_flux_enters_all_of_a_face():
    """Its power is q times the area, of fine and coarse columns alike to 1 %."""
    backend, body = body_of("plane", 1.6e-6, bottom="prescribed-flux", bottom_flux=1e9)
    power = backend.to_host(body.wall_power)
    assert power.sum() == pytest.approx(1e9 * 1.2e-5, rel=1e-12)
    coarse = power[body.filling.fine_count :].sum()
    assert coarse == pytest.approx(1e9 * (1.2e-5 - 3.2e-6), rel=1e-2)
