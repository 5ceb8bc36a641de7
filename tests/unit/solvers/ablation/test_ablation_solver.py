"""Flight of what has left, free fall, and the solver's choices."""

import numpy as np
import pytest
from moving_matter import DRIFTING_BLOCK, HEATED_BLOCK, go, host, moving, put, stir

from lasersph.particles.kinds import EJECTED, GONE, INTERIOR
from lasersph.simulation.recipes.ablation.view import ablation_fields
from lasersph.solvers.ablation.equations import fly
from lasersph.solvers.step_control import NotConverged

BOX = {"low": (0.0, -5.0), "high": (2.0, 5.0)}


def test_flight():
    """Straight on; gone once outside; what is condensed does not fly."""
    x, v = np.array([1.0, 4.0]), np.array([0.0, 2.0])
    place, kind, gone = fly(x, v, EJECTED, 0.25, **BOX)
    assert (place.tolist(), kind, gone) == ([1.0, 4.5], EJECTED, 0.0)
    place, kind, gone = fly(x, v, EJECTED, 1.0, **BOX)
    assert (place.tolist(), kind, gone) == ([1.0, 6.0], GONE, 1.0)
    assert fly(x, v, INTERIOR, 1.0, **BOX)[0].tolist() == [1.0, 4.0]


def test_free_fall():
    """Without walls a block falls: v = -g t and z = -g t^2 / 2, exactly for the midpoint rule."""
    _, solver = moving("hydrostatic-column", "boundaries.bottom=free", "motion=",
                       "solver.dimensions=1", "time.step=1 ms", "time.is_fixed=true")  # fmt: skip
    before = host(solver, "position")
    go(solver, steps=10)
    t = solver.state.time
    assert host(solver, "velocity")[0] == pytest.approx(np.full(20, -9.81 * t), rel=1e-12)
    fallen = host(solver, "position") - before
    assert fallen[0] == pytest.approx(np.full(20, -0.5 * 9.81 * t * t), rel=1e-9)


def test_too_long_a_step_is_halved():
    """A step in which matter would pass its neighbors is not taken; shorter ones are."""
    _, solver = moving("sound-wave", *DRIFTING_BLOCK)
    stir(solver, 100.0)
    taken = solver.step(4e-9)
    assert 0.0 < taken < 4e-9
    assert solver.state.time == taken


def test_what_no_step_saves_is_said():
    """Velocities that are not finite: the state stays as it was."""
    _, solver = moving("sound-wave", *DRIFTING_BLOCK)
    put(solver, "velocity", np.nan)
    before = host(solver, "position")
    with pytest.raises(NotConverged, match="take shorter steps"):
        solver.step(1e-11)
    assert np.array_equal(host(solver, "position"), before)
    assert solver.state.time == 0.0


def test_limits_by_name():
    """Flow limits where it flows, heat alone at rest, the light's share while it is on."""
    _, flow = moving("dam-break", "particles.spacing=5.715 mm")
    assert {"end", "sound", "viscosity", "conduction"} <= set(flow.time_step_limits())
    _, heat = moving("sound-wave", *HEATED_BLOCK)
    go(heat, steps=1)
    assert set(heat.time_step_limits()) == {"end", "pulse edge", "conduction", "vaporization"}
    fixed = moving("sound-wave", *HEATED_BLOCK, "time.step=0.05 ns", "time.is_fixed=true")[1]
    limits = fixed.time_step_limits()
    assert set(limits) == {"end", "fixed step"}
    assert limits["fixed step"] == 5e-11


def test_a_surface_cools_without_light():
    """Heat is lost though nobody looks at the surface, and the same bits after a restart."""
    settings = (*HEATED_BLOCK, "laser=", "boundaries.convection=1e8 W/(m^2 K)", "time.end=1 us",
                "boundaries.ambient_temperature=1000 K")  # fmt: skip
    (_, first), (_, second) = (moving("sound-wave", *settings) for _ in range(2))
    go(first, steps=2)
    assert first.state.energy["lost"] < 0.0
    arrays = {name: first.backend.to_host(field) for name, field in first.fields.items()}
    second.restore(arrays, first.checkpoint_scalars())
    for solver in (first, second):
        go(solver, steps=2)
    assert first.state.energy == second.state.energy
    assert np.array_equal(first.fields["enthalpy"], second.fields["enthalpy"])


@pytest.mark.parametrize("settings", [DRIFTING_BLOCK, HEATED_BLOCK])
def test_looking_changes_nothing(settings):
    """A run that is observed after every step has the bits of one that nobody looks at."""
    settings = (*settings, "time.end=1 us")
    (case, seen), (_, other) = (moving("sound-wave", *settings) for _ in range(2))
    for number in range(12):
        ablation_fields(case, seen, number)
        for solver in (seen, other):
            go(solver, steps=1)
    for name, array in seen.fields.items():
        assert np.array_equal(array, other.fields[name])
    assert seen.state == other.state
