"""Liquid that passes between particles at rest, in a plane and in space."""

import numpy as np
import pytest
from flow_boxes import LID, PERIODIC, PERIODIC_HEAT, box, box_case, place_of, pool
from law_runs import go, host, start_from
from spot_pools import run_in_two_parts

from lasersph import open_run, run
from lasersph.solvers.melt_pool.eulerian_pool import EulerianPool

SHEARED = {"left": "periodic", "right": "periodic",
           "surface": {"kind": "moving-wall", "velocity": 1.0}}  # fmt: skip


def test_linear_profile_stays():
    """Couette's steady flow has nothing to carry across the stream: speed of the wall below a lid
    is that of the melt, not of its mirror image."""
    solver = box(flow=SHEARED, heat={"sides": "periodic"}, cells=10, step=0.05, frame="eulerian")
    z = place_of(solver)[1]
    exact = np.array([1.0 + z, 0.0 * z])
    solver.flow.set_initial_velocity(exact)
    for _ in range(10):
        solver.step(0.05)
    assert host(solver, "velocity") == pytest.approx(exact, abs=1e-9)


@pytest.mark.parametrize("dimensions", [2, 3])
def test_heat_is_stirred_and_kept(dimensions):
    """Below a lid, between walls that let no heat through: the same heat to rounding, no new
    extreme; particles rest, and their pairs are those of the start."""
    space = {} if dimensions == 2 else {"domain": {"breadth": 0.5}, "dimensions": 3}
    flow = LID if dimensions == 2 else {**LID, "sides": "no-slip"}
    solver = box(flow=flow, cells=10, step=0.02, frame="eulerian", **space)
    assert isinstance(solver, EulerianPool)
    place = place_of(solver)
    start_from(solver, np.where(place[0] < 0.0, 2.0, 1.0) + 0.3 * place[-1])
    m, h, start = host(solver, "mass"), host(solver, "enthalpy").copy(), host(solver, "position")
    start = start.copy()
    go(solver, 0.4)
    after, pairs = host(solver, "enthalpy"), solver.flow.block.pairs
    assert np.abs(after - h).max() > 0.01
    assert np.sum(m * after) == pytest.approx(np.sum(m * h), rel=1e-13)
    assert h.min() * (1.0 - 1e-6) <= after.min() and after.max() <= h.max() * (1.0 + 1e-6)
    assert np.array_equal(host(solver, "position"), start)
    go(solver, 0.5)
    assert solver.flow.block.pairs is pairs


def test_pool_in_a_plane():
    """The flow of a flat pool along a gradient of temperature, beside that of particles that move:
    its largest speed and kinetic energy, which differ by 7 and 0.5 % with ten rows; heat of the
    whole to rounding."""
    found, fine = [], "particles.spacing=62.5nm"
    for frame in ("solver.frame=eulerian", "solver.frame=lagrangian"):
        solver = pool(lambda x, z: (z > -6e-7) & (abs(x) < 8e-7), fine, frame, slope=2e8)
        start = np.sum(host(solver, "mass") * host(solver, "enthalpy"))
        go(solver, 5e-9)
        v, m = host(solver, "velocity"), host(solver, "mass")
        kept = np.sum(m * host(solver, "enthalpy")) - solver.state.energy["absorbed"]
        assert kept == pytest.approx(start, rel=1e-8)
        found.append([solver.flow.largest_speed, 0.5 * np.sum(m * np.sum(v**2, axis=0))])
    assert found[0] == pytest.approx(found[1], rel=0.1)


def test_run_in_two_parts_and_by_two_threads(tmp_path):
    """The same bits."""
    case = box_case(cells=12, end=0.4, frame="eulerian")
    run(case, tmp_path / "whole", threads=1)
    run_in_two_parts(case, tmp_path / "part", steps=20)
    one, other = (open_run(tmp_path / name).snapshots[-1] for name in ("whole", "part"))
    for name in ("temperature", "velocity", "pressure"):
        assert one[name].tobytes() == other[name].tobytes()


def test_narrow_supports_leave_one_fluid():
    """Particles one spacing apart touch, also where they see no farther than two."""
    solver = box(support=2.0)
    solver.step(0.01)
    assert solver.flow.projection.equation.components.count == 1


@pytest.mark.parametrize("support", [2.1, 2.6, 3.75])
def test_waves_go_along_with_the_flow(support):
    """Of temperature and of velocity across a uniform flow of 1 m/s, 0.25 m in 0.25 s, however far
    particles see: 0.2 % of enthalpy, 2 % of velocity, whose slopes lead."""
    still = {"conductivity": "1e-9 W/(m K)", "kinematic_viscosity": "1e-9 m^2/s"}
    solver = box(flow=PERIODIC, heat=PERIODIC_HEAT, cells=40, depth=0.5, material=still,
                 support=support, frame="eulerian")  # fmt: skip
    x = place_of(solver)[0]
    wave = np.exp(2j * np.pi * x)
    solver.flow.set_initial_velocity(np.array([np.ones_like(x), 0.01 * wave.imag]))
    start_from(solver, 300.0 + wave.imag)
    go(solver, 0.25)
    h, w = host(solver, "enthalpy"), host(solver, "velocity")[1]
    # sin(2 pi (x - s)) has the phase -2 pi s
    h_carried, w_carried = (-np.angle(1j * np.mean(a / wave)) / (2.0 * np.pi) for a in (h, w))
    assert h_carried == pytest.approx(0.25, rel=0.002)
    assert w_carried == pytest.approx(0.25, rel=0.02)
