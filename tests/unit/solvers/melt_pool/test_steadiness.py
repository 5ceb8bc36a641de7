"""When a flow counts as steady: once a turnover, by its kinetic energy."""

from lasersph.solvers.melt_pool.steadiness import Steadiness

WIDTH, SPEED = 2.0, 4.0
"""A turnover takes 0.5 s."""


def recorded(wanted, *samples):
    """After samples of (time, energy)."""
    steadiness = Steadiness(wanted, WIDTH)
    for time, energy in samples:
        steadiness.record(time, SPEED, energy)
    return steadiness


def test_never():
    """Without a wish the run goes to its end."""
    assert not recorded(None, (1.0, 5.0), (2.0, 5.0)).reached


def turnovers(*energies):
    """Looks 0.6 s apart."""
    return [(0.6 * (k + 1), energy) for k, energy in enumerate(energies)]


def test_needs_five_turnovers():
    """Four samples say nothing; five within 1e-3 of their mean do, wherever the largest lies."""
    assert not recorded(1e-3, *turnovers(5.0, 5.0, 5.0, 5.0)).reached
    assert recorded(1e-3, *turnovers(5.0, 5.004, 5.0, 5.0, 5.0)).reached
    assert not recorded(1e-3, *turnovers(5.0, 5.006, 5.0, 5.0, 5.0)).reached
    assert recorded(1e-3, *turnovers(4.0, 5.0, 5.004, 5.0, 5.0, 5.0)).reached


def test_not_within_a_turnover():
    """What happens sooner than a turnover after the last look is not looked at."""
    steadiness = recorded(1e-3, (0.6, 5.0), (0.9, 5.0))
    assert not steadiness.reached
    assert (steadiness.time, steadiness.energies[-2:]) == (0.6, [0.0, 5.0])


def test_at_rest():
    """Nothing moves yet: not steady, but not begun."""
    steadiness = Steadiness(1e-3, WIDTH)
    for time in (1.0, 2.0, 3.0):
        steadiness.record(time, 0.0, 0.0)
    assert not steadiness.reached


def test_resumed():
    """Restored it goes on where it was."""
    samples = turnovers(5.0, 5.0, 5.0, 5.0, 5.0)
    first = recorded(1e-3, *samples[:4])
    second = Steadiness(1e-3, WIDTH)
    second.restore(first.checkpoint_scalars())
    second.record(samples[4][0], SPEED, samples[4][1])
    assert second.reached
    assert second.checkpoint_scalars() == recorded(1e-3, *samples).checkpoint_scalars()
