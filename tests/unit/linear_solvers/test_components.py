"""Components: labels of touching particles, and the means that are removed from them."""

import numpy as np

from lasersph.linear_solvers.components import Components

SUPPORT = 3.75


def found(backend, position, mask=None, boundary_coefficient=None, period=(0.0, 0.0)):
    """Components of positions in spacings."""
    position = np.asarray(position, float)
    count = position.shape[1]
    components = Components(backend, count, SUPPORT, period)
    mask = np.ones(count) if mask is None else mask
    boundary_coefficient = np.zeros(count) if boundary_coefficient is None else boundary_coefficient
    components.find(*(backend.asarray(v) for v in (position, mask, boundary_coefficient)))
    return components, backend.to_host(components.number).tolist()


def lines(*starts):
    """Vertical lines of five particles at the given x."""
    x = np.repeat(np.array(starts, float), 5)
    return np.array([x, np.tile(np.arange(5.0), len(starts))])


def test_lines_apart_and_in_touch(backend):
    """Lines at x = 0, 1 and 6: two components, numbered along x."""
    components, number = found(backend, lines(0, 1, 6))
    assert number == [1] * 10 + [2] * 5 and components.count == 2


def test_masked_and_few_particles_belong_to_none(backend):
    """A line of which three particles remain is no component; masked particles never are."""
    mask = np.ones(10)
    mask[[8, 9]] = 0.0
    components, number = found(backend, lines(0, 6), mask)
    assert number == [1] * 5 + [0] * 5 and components.count == 1
    assert backend.to_host(components.mask).tolist() == [1.0] * 5 + [0.0] * 5


def test_components_join_across_the_period(backend):
    """Lines at both ends of a period touch, those in the middle do not."""
    components, number = found(backend, lines(0.5, 10, 19.5), period=(20.0, 0.0))
    assert number == [1] * 5 + [2] * 5 + [1] * 5 and components.count == 2


def test_means_of_floating_components_are_removed(backend):
    """The second line is pulled toward a value and keeps its mean."""
    boundary_coefficient = np.zeros(10)
    boundary_coefficient[7] = 0.5
    components, _ = found(backend, lines(0, 6), boundary_coefficient=boundary_coefficient)
    values = backend.asarray(np.arange(10.0))
    (square,) = components.remove_means(values)
    assert backend.to_host(values).tolist() == [-2.0, -1.0, 0.0, 1.0, 2.0, 5.0, 6.0, 7.0, 8.0, 9.0]
    assert square == 10.0 + 255.0


def test_no_particle(backend):
    """Nothing is labeled where all are masked."""
    components, number = found(backend, lines(0), np.zeros(5))
    assert number == [0] * 5 and components.count == 0
