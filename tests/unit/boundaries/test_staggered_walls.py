"""Walls of particles: three layers, the second in the gaps of the others."""

import numpy as np
import pytest

from lasersph.boundaries.initial_motion import SoundWave, Uniform
from lasersph.boundaries.staggered_walls import wall_particles
from lasersph.boundaries.vessel import Vessel

SQUARE = ((0.0, 4.0), (-4.0, 0.0))


def rows(place, axis, value):
    """Sorted places along the first axis of the particles whose `axis` has `value`."""
    return sorted(place[0, np.isclose(place[axis], value)])


def test_column():
    """In 1-D three particles half, one and a half and two and a half spacings below."""
    walls = wall_particles(((-10.0, 0.0),), 1.0, ["bottom"])
    assert walls["bottom"].tolist() == [[-10.5, -11.5, -12.5]]


def test_floor_of_a_periodic_box():
    """Layers of four; the second is half a spacing aside."""
    place = wall_particles(SQUARE, 1.0, ["bottom"], ["left", "right"])["bottom"]
    assert rows(place, 1, -4.5) == [0.5, 1.5, 2.5, 3.5]
    assert rows(place, 1, -5.5) == [0.0, 1.0, 2.0, 3.0]
    assert rows(place, 1, -6.5) == [0.5, 1.5, 2.5, 3.5]


def test_box_with_floor_and_sides():
    """The floor reaches three cells beyond the sides, which stand on it."""
    walls = wall_particles(SQUARE, 1.0, ["bottom", "left", "right"])
    assert list(walls) == ["bottom", "left", "right"]
    assert rows(walls["bottom"], 1, -4.5) == [k + 0.5 for k in range(-3, 7)]
    assert rows(walls["bottom"], 1, -5.5) == list(range(-2, 7))
    left = walls["left"]
    assert sorted(set(left[0])) == [-2.5, -1.5, -0.5]
    assert sorted(left[1, left[0] == -0.5]) == [-3.5, -2.5, -1.5, -0.5]
    assert sorted(left[1, left[0] == -1.5]) == [-4.0, -3.0, -2.0, -1.0]
    assert np.allclose(walls["right"][0], 4.0 - left[0])


def test_box_in_space():
    """Five walls without double places, none inside."""
    box = ((0.0, 4.0), (0.0, 4.0), (-4.0, 0.0))
    walls = wall_particles(box, 1.0, ["bottom", "left", "right", "front", "back"])
    place = np.concatenate(list(walls.values()), axis=1)
    assert np.unique(place.round(6), axis=1).shape == place.shape
    inside = np.all([(lo < x) & (x < hi) for x, (lo, hi) in zip(place, box, strict=True)], axis=0)
    assert not inside.any()


def test_vessel():
    """Room beside and above widens the box; a column has none."""
    vessel = Vessel(left=1.0, right=3.0, above=2.0)
    assert vessel.box(SQUARE) == ((-1.0, 7.0), (-4.0, 2.0))
    assert Vessel().box(((-1.0, 0.0),)) == ((-1.0, 0.0),)


def test_uniform_motion():
    """Components as many as dimensions, z last."""
    motion = Uniform(x=1.0, y=2.0, z=3.0)
    assert [motion.velocity(d).tolist() for d in (1, 2, 3)] == [[3.0], [1.0, 3.0], [1.0, 2.0, 3.0]]


def test_sound_wave_is_compressed_where_particles_are_displaced_together():
    """(rho - rho_0) / rho_0 = - d(displacement)/dz, to first order."""
    wave = SoundWave(amplitude=0.01, waves=2)
    z = np.linspace(-1.0, 0.0, 2001)
    strain = -np.gradient(wave.displacement(z, 1.0, 5.0), z)
    assert strain[5:-5] == pytest.approx(wave.strain(z, 1.0, 5.0)[5:-5], abs=1e-7)
    assert wave.strain(np.zeros(1), 1.0, 5.0)[0] == pytest.approx(0.002)
