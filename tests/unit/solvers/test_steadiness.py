"""When a flow counts as steady: once a turnover, by its kinetic energy."""

from lasersph.solvers.melt_pool.steadiness import Steadiness

WIDTH, SPEED = 2.0, 4.0
"""A turnover takes 0.5 s."""


def looked(wanted, *looks):
    """After looks of (time, energy)."""
    steadiness = Steadiness(wanted, WIDTH)
    for time, energy in looks:
        steadiness.look(time, SPEED, energy)
    return steadiness


def test_never():
    """Without a wish the run goes to its end."""
    assert not looked(None, (1.0, 5.0), (2.0, 5.0)).reached


def test_needs_two_turnovers():
    """The first look has nothing to compare with; the second compares."""
    assert not looked(1e-3, (0.6, 5.0)).reached
    assert looked(1e-3, (0.6, 5.0), (1.2, 5.004)).reached
    assert not looked(1e-3, (0.6, 5.0), (1.2, 5.006)).reached


def test_not_within_a_turnover():
    """What happens sooner than a turnover after the last look is not looked at."""
    steadiness = looked(1e-3, (0.6, 5.0), (0.9, 5.0))
    assert not steadiness.reached
    assert (steadiness.time, steadiness.energy) == (0.6, 5.0)


def test_at_rest():
    """Nothing moves yet: not steady, but not begun."""
    steadiness = Steadiness(1e-3, WIDTH)
    for time in (1.0, 2.0, 3.0):
        steadiness.look(time, 0.0, 0.0)
    assert not steadiness.reached


def test_carried_over():
    """Restored it goes on where it was."""
    first = looked(1e-3, (0.6, 5.0))
    second = Steadiness(1e-3, WIDTH)
    second.restore(first.carried())
    second.look(1.2, SPEED, 5.0)
    assert second.reached
    assert second.carried() == looked(1e-3, (0.6, 5.0), (1.2, 5.0)).carried()
