"""Probes: nearest particle, linear weights, reported places."""

import numpy as np
import pytest
import synthetic_run
from pydantic import ValidationError

from lasersph.observers import Probes
from lasersph.observers.probes import mean_place, weights_at
from lasersph.output.settings import Probe


@pytest.fixture(scope="module")
def view():
    position, width = synthetic_run.lattice(2)
    return synthetic_run.view_at(50e-9, 1, position, width)


def test_nearest_reports_the_depth_of_its_particle(view):
    """A probe at the surface reads the first particle, half a cell below."""
    probes = Probes((Probe(name="top"),))
    row = probes.observe(view)
    assert row["probe_top_K"] == view.temperature[0]
    found = probes.summary()["probes"]["top"]
    assert found["depth_used_m"] == pytest.approx(25e-9)
    assert found["lateral_used_m"] == pytest.approx([25e-9])
    assert found["temperature_end_K"] == view.temperature[0]


@pytest.mark.parametrize("dimension", [1, 2, 3])
@pytest.mark.parametrize("depth", [0.0, 33e-9, 210e-9, 1.3e-6, 4.2e-6])
def test_linear_reproduces_linear_fields(dimension, depth):
    """On the graded lattice and at the surface, a linear field is met exactly."""
    position, _ = synthetic_run.lattice(dimension)
    slope = np.array([2.0, -3.0, 5.0])[:dimension]
    place = np.array([0.4e-6, 0.1e-6, -depth])[-dimension:]
    if dimension > 1:
        place[0] = 0.4e-6
    particles, weights = weights_at(position, place, "linear")
    field = 1e-6 + slope @ position
    assert weights @ field[particles] == pytest.approx(1e-6 + slope @ place, abs=1e-14)
    assert np.sum(weights) == pytest.approx(1.0)


def test_linear_at_a_particle_is_that_particle(view):
    """Where a particle lies on the probe, its value is taken."""
    k = 777
    particles, weights = weights_at(view.position, view.position[:, k], "linear")
    assert weights @ view.temperature[particles] == pytest.approx(view.temperature[k], rel=1e-9)


def test_particles_in_another_order_are_found_again(view):
    """Sorting the particles anew between two steps changes nothing."""
    probes = Probes((Probe(name="a", depth=300e-9, x=1e-6),))
    before = probes.observe(view)
    order = np.random.default_rng(0).permutation(view.temperature.size)
    moved = synthetic_run.view_at(50e-9, 2, view.position[:, order], view.width[:, order])
    assert probes.observe(moved) == before


def test_bad_probes_are_refused():
    """Names must fit into a column name and differ; probes lie below the surface."""
    with pytest.raises(ValidationError):
        Probe(name="a b")
    with pytest.raises(ValidationError, match="not negative"):
        Probe(name="a", depth=-1e-9)
    with pytest.raises(ValueError, match="same name"):
        Probes((Probe(name="a"), Probe(name="a", depth=1e-9)))


def test_even_reproduces_fields_without_slope_at_the_surface() -> None:
    """Of 300 + 2 x - 5 z^2, the value at z = 0 comes from cells whose centers lie below it."""
    x, z = np.meshgrid((np.arange(6) + 0.5), -(np.arange(6) + 0.5))
    position = np.vstack([x.ravel(), z.ravel()])
    field = 300.0 + 2.0 * position[0] - 5.0 * position[1] ** 2
    particles, weights = weights_at(position, np.array([2.0, 0.0]), "even")
    assert weights @ field[particles] == pytest.approx(304.0, rel=1e-12)


@pytest.mark.parametrize(("method", "depth"), [("even", 0.0), ("even", 1.2), ("linear", 0.3)])
def test_place_that_a_probe_stands_for(method, depth) -> None:
    """Interpolated values belong to the place asked for; that of the nearest cell to its center."""
    x, z = np.meshgrid((np.arange(6) + 0.5), -(np.arange(6) + 0.5))
    position = np.vstack([x.ravel(), z.ravel()])
    particles, weights = weights_at(position, np.array([2.0, -depth]), method)
    place = mean_place(position[:, particles], weights, method)
    assert place == pytest.approx([2.0, -depth], abs=1e-6)
    particles, weights = weights_at(position, np.array([2.2, -depth]), "nearest")
    nearest = mean_place(position[:, particles], weights, "nearest")
    assert nearest == pytest.approx([2.5, -np.floor(depth) - 0.5])
