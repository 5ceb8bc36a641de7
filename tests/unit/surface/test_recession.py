"""Mass that leaves a surface is taken from particles that can spare it, with what it carries."""

import numpy as np
import pytest
from surface_lines import line_of

from lasersph import compute
from lasersph.surface.recession import CATCH_UP, SHARE, part_due, take_mass
from lasersph.surface.surface import SurfaceStep
from lasersph.surface.surface_fit import TEMPERATURE_DEPTH

SPACING, COLUMNS, ROWS, DENSITY = 1e-8, 6, 30, 7000.0
LINE = line_of(0.0, SPACING, COLUMNS, ("mirror", "mirror"), 30 * SPACING)


@pytest.fixture
def melt():
    """Backend and a step below a flat surface at z = 0: hot above, and flowing there."""
    backend = compute.cpu(threads=1)
    x = (np.arange(COLUMNS * ROWS) % COLUMNS + 0.5) * SPACING
    row = np.arange(COLUMNS * ROWS) // COLUMNS
    volume = np.full(x.size, SPACING**2)
    fields = {
        "T": volume,
        "position": np.array([x, -(row + 0.5) * SPACING]),
        "velocity": np.array([10.0 - row, 0.1 * row]),
        "volume": volume,
        "mass": 1.1 * DENSITY * volume,
        "enthalpy": 2e6 - 5e4 * row,
        "flows": np.ones(x.size),
        "evaporated": volume,
    }
    arrays = {name: backend.asarray(values) for name, values in fields.items()}
    return backend, SurfaceStep(**arrays, interval=(0.0, 1.0))


def take(backend, now, lost, gone, height=0.0):
    """Take thicknesses `lost` [m] below a flat surface at `height` [m]; the heat that left."""
    depth = backend.asarray(height - backend.to_host(now.position)[1])
    return take_mass(backend, now, depth, LINE, lost, gone, SPACING, DENSITY)


def on_host(backend, now):
    """Rows by columns of mass, enthalpy, velocity along x, and depth of the particles."""
    fields = (now.mass, now.enthalpy, now.velocity[0], -now.position[1])
    return [np.array(backend.to_host(values)).reshape(ROWS, COLUMNS) for values in fields]


def test_no_particle_is_used_up(melt):
    """Three spacings leave one column, a fiftieth in each step: of no particle more than half, from
    no other column, and in sum just these."""
    backend, now = melt
    gone = np.zeros(COLUMNS)
    lost = np.where(np.arange(COLUMNS) == 2, 0.02 * SPACING, 0.0)
    for _ in range(150):
        gone += lost
        take(backend, now, lost, gone, -gone[2])
    left = backend.to_host(now.volume).reshape(ROWS, COLUMNS) / SPACING**2
    assert np.all(left[:, np.arange(COLUMNS) != 2] == 1.0)
    assert abs(ROWS - left[:, 2].sum() - 3.0) < 1e-9
    # the volume that is left of the smallest one by the law of the depth that is reached
    least = (TEMPERATURE_DEPTH / (np.e * SHARE * 3.0)) ** (1 / SHARE)
    assert left.min() == pytest.approx(least, rel=0.05)
    assert np.all(np.diff(left[:, 2]) >= 0.0)
    # the particles have sunk with the surface, and stay as far apart as their volumes say
    depth = on_host(backend, now)[3][:, 2]
    faces = 3.0 * SPACING + np.cumsum(left[:, 2]) * SPACING
    middle = np.concatenate([[3.0 * SPACING], faces[:-1]]) + 0.5 * SPACING * left[:, 2]
    assert np.max(np.abs(depth - middle)) < 0.03 * SPACING


def test_two_particles_by_hand(melt):
    """A tenth of a spacing leaves columns of two particles within reach: the upper passes on its
    own enthalpy and velocity, and takes up those of the lower by half of what has left."""
    backend, now = melt
    mass, h, _, depth = on_host(backend, now)
    lost = np.full(COLUMNS, 0.1 * SPACING)
    # within 1.5 spacings of the surface, without the one at its very end
    heat = take(backend, now, lost, np.zeros(COLUMNS), -1e-3 * SPACING)
    new_mass, new_h, new_u, new_depth = on_host(backend, now)
    cell = DENSITY * SPACING**2
    assert (mass - new_mass)[:2] == pytest.approx(0.05 * cell, rel=1e-9)
    assert np.array_equal(new_mass[2:], mass[2:])
    # the vapor has the enthalpy of the uppermost, all of it leaves the fields
    assert heat == pytest.approx(COLUMNS * 0.1 * cell * 2e6, rel=1e-12)
    assert np.sum(mass * h - new_mass * new_h) == pytest.approx(heat, rel=1e-9)
    upper = (1.1 * 2e6 - 0.1 * 2e6 + 0.05 * 1.95e6) / 1.05
    assert new_h[0] == pytest.approx(upper, rel=1e-12) and np.all(new_h[1] == h[1])
    assert new_u[0] == pytest.approx(10.0 - 0.05 / 0.95, rel=1e-12)
    assert (new_depth - depth)[0] == pytest.approx(0.075 * SPACING, rel=1e-9)
    assert (new_depth - depth)[1] == pytest.approx(0.025 * SPACING, rel=1e-9)


def test_mass_that_arrives_is_as_hot_as_the_surface(melt):
    """What condenses has the enthalpy of the uppermost particle, which then warms the next."""
    backend, now = melt
    _, h, _, _ = on_host(backend, now)
    heat = take(backend, now, np.full(COLUMNS, -0.1 * SPACING), np.zeros(COLUMNS), -1e-11)
    _, new_h, _, _ = on_host(backend, now)
    assert heat == pytest.approx(-COLUMNS * 0.1 * DENSITY * SPACING**2 * 2e6, rel=1e-12)
    assert np.array_equal(new_h[0], h[0]) and np.all(new_h[1] > h[1])


@pytest.mark.parametrize("short", [(0.3, 0.7), (0.01,), (0.3,) * 60])
def test_shorter_steps_take_what_evaporates_in_their_own_time(short):
    """Metal that evaporates evenly: each step takes that of its own time, within the part more by
    which steps that stay short catch up, until the one before is all that they take."""
    left, delay, rates = 1.0, 1.0, []
    for step in (1.0, *short, 1.0, 1.0):
        part, delay = part_due(step, delay)
        rates.append(part * left / step)
        left += step - part * left
        assert left == pytest.approx(delay)
        if len(rates) == 60:
            assert left == pytest.approx(step)
    assert all(rate < 1.0 + CATCH_UP + 1e-9 for rate in rates)
    assert min(rates[:-2]) > 1.0 - 1e-9 and rates[-1] == pytest.approx(1.0)
