"""One particle, or two, with electrons and lattice: by hand."""

import numpy as np
import pytest

from lasersph.physics.two_temperature import (
    electron_energy,
    electron_state,
    exchange,
    give,
    mean_weight,
    scattered_conductivity,
    taken_energies,
)

CONSTANT = ([-600.0, 1e6], [0.0, 1.0006e6 / 2.0], [2.0, 2.0])
"""C_e of 2 J/(kg K), e = 0 at 300 K."""
LINEAR = ([-45.0, 1e8 / 2.0 - 45.0], [0.0, 1e4], [0.0, 1e4])
"""C_e of 1 J/(kg K^2) T_e, e = 0 at sqrt(90) K."""


@pytest.mark.parametrize(("e", "T", "C"), [(0.0, 300.0, 2.0), (1400.0, 1000.0, 2.0)])
def test_constant_capacity(e, T, C):
    """T_e = 300 K + e/C_e."""
    assert electron_state(e, *CONSTANT) == pytest.approx((T, C))
    assert electron_energy(T, *CONSTANT) == pytest.approx(e, abs=1e-9)


def test_linear_capacity():
    """e = (T_e^2 - T_0^2)/2 is inverted exactly."""
    assert electron_state(0.5 * 5000.0**2 - 45.0, *LINEAR) == pytest.approx((5000.0, 5000.0))
    assert electron_energy(5000.0, *LINEAR) == pytest.approx(0.5 * 5000.0**2 - 45.0)


@pytest.mark.parametrize("step", [1e-9, 0.5, 30.0])
def test_exchange_is_that_of_two_capacities(step):
    """C_e = 2, C_l = 6, G V = 3: the difference of 8 K decays with the rate 2."""
    Q, share, C = exchange(8.0, 2.0, 1.0 / 6.0, 3.0, step)
    # what the lattice gains, of 12 J when both are equal
    assert pytest.approx(12.0 * (1.0 - np.exp(-2.0 * step)), rel=1e-6) == Q
    # with S at an even rate: difference S f / C_e more, mean S / 8 more
    f = (1.0 - np.exp(-2.0 * step)) / (2.0 * step)
    electrons = 1.0 / 8.0 + 6.0 / 8.0 * f / 2.0
    assert pytest.approx(electrons, rel=1e-6) == 1.0 / C
    assert share == pytest.approx(1.0 - 2.0 * electrons, abs=1e-6)


def test_exchange_on_a_plateau():
    """A lattice that melts holds its temperature: the electrons approach it alone."""
    Q, share, C = exchange(8.0, 2.0, 0.0, 3.0, 0.5)
    assert pytest.approx(16.0 * (1.0 - np.exp(-0.75))) == Q
    assert share == pytest.approx(1.0 - (1.0 - np.exp(-0.75)) / 0.75)
    assert pytest.approx(2.0 / (1.0 - share)) == C


def test_a_particle_keeps_the_energy():
    """Electrons that take S give the lattice Q + r (1 - f) S; both together have S more."""
    e, h, m = 10.0, 50.0, 2.0
    new_e, gained = give(6.0, e, m, 3.0, 0.25)
    assert gained == pytest.approx(4.5)
    assert new_e == pytest.approx(10.0 + (6.0 - 4.5) / 2.0)
    assert m * (taken_energies(h, e, new_e, gained, m)[0] - h) == pytest.approx(6.0)


def test_conductivity():
    """Equal temperatures give the metal's; hot electrons conduct more, until they collide."""
    assert scattered_conductivity(300.0, 500.0, 500.0, 1e-4) == pytest.approx(300.0)
    assert scattered_conductivity(300.0, 3000.0, 300.0, 0.0) == pytest.approx(3000.0)
    much = scattered_conductivity(300.0, 3e4, 300.0, 1e-4)
    assert much == pytest.approx(300.0 * 100.0 * 1.03 / 301.0)


def test_weights_of_two_particles():
    """The pair conducts with the mean of both, and either way alike."""
    assert mean_weight(2.0, 3.0, 5.0) == mean_weight(2.0, 5.0, 3.0) == pytest.approx(8.0)
