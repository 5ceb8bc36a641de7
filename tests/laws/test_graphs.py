"""Every loop graph of the package: recorded, it leaves the bits of its method run as it is."""

import numpy as np
import pytest
from flow_boxes import LID, box, go, host_fields, pool
from law_runs import solver_of
from particle_square import held_front, right_side, system
from spot_pools import half_ball, spot_pool

from lasersph import compute
from lasersph.case import load_case
from lasersph.compute.graph import GRAPHS, checked_graphs
from lasersph.compute.kept_graph import KeptGraph
from lasersph.linear_solvers.conjugate_gradient import ConjugateGradient
from lasersph.simulation.recipes import recipe_of

MOVING = (
    "solver.flow.surface=moving",
    "material.base=steel-304-demuth",
    "material.surface_tension=1.6 N/m",
)
HEAT = {"left": "fixed-temperature", "left_temperature": 310.0, "right": "fixed-temperature"}
STEPS = 5


def found_by(solver):
    """Fields and numbers of a solver after some steps."""
    go(solver, STEPS)
    return [*host_fields(solver).values(), solver.checkpoint_scalars()]


def heated_box(backend):
    """A box with a warm and a cold wall, and a lid that moves."""
    expansion = {"expansion": "0.01 1/K"}
    how = {"heat": HEAT, "flow": LID, "material": expansion, "gravity": 10.0}
    return found_by(box(backend, **how, end=10.0, step=0.1))


def flat_pool(backend):
    """A pool with a flat surface."""
    return found_by(
        pool(lambda x, z: (x < 1e-6) & (z > -6e-7), backend=backend, hot=2500.0, slope=-5e8)
    )


def lit_pool(backend):
    """A pool near the peak of its pulse, whose light goes deep."""
    solver = pool(lambda x, z: z > -5e-7, backend=backend, slope=-5e8)
    solver.state.time = 5e-8
    return found_by(solver)


def moving_pool(backend):
    """A pool whose surface moves."""
    molten = lambda x, z: (x < 2.1e-6) & (z > -7.5e-7)  # noqa: E731
    return found_by(pool(molten, *MOVING, backend=backend, slope=-5e8))


def lit_steel(backend):
    """Heat in a body at rest near the peak of its pulse."""
    _, solver = solver_of("dlip-steel", "particles.spacing=125nm", backend=backend)
    solver.state.time = 4.9e-8
    return found_by(solver)


def spot_in_section(backend):
    """A pool in a section (r, z), whose melt passes between particles at rest."""
    return found_by(spot_pool(half_ball, backend=backend)[1])


def moving_spot(backend):
    """The same below a surface that moves, with which its particles ride."""
    metal = {"base": "steel-304-demuth", "surface_tension": 1.6}
    solver = {"flow": {"surface": "moving"}, "vaporization": "plateau"}
    return found_by(spot_pool(half_ball, backend=backend, material=metal, solver=solver)[1])


def short_pulse(backend):
    """Electrons and lattice of gold that melts, around the peak of a pulse of 150 fs."""
    _, solver = solver_of("short-pulse-gold", "laser.fluence=0.2 J/cm^2", backend=backend)
    go(solver, 40)
    assert solver.state.has_two
    return found_by(solver)


def short_pulse_on_melt(backend):
    """Electrons and lattice in a pool, whose light follows particles wherever they are."""
    settings = ("solver.kind=melt-pool", "solver.dimensions=2", "solver.flow.surface=flat")
    settings += ("particles.spacing=10 nm", "domain.width=60 nm", "laser.fluence=0.2 J/cm^2")
    settings += ("particles.fine_depth=100 nm",)
    _, solver = solver_of("short-pulse-gold", *settings, backend=backend)
    go(solver, 40)
    light = solver.body.light
    light.shine(solver.state.time, solver.state.time + 1e-14)
    for _ in range(3):
        light.distribute(solver.position, solver._depth, solver.surface_columns)
        light.absorb(backend.asarray(np.full(solver.body.count, 2e14)))
    return found_by(solver)


def heated_cube(backend):
    """A box in three dimensions with a warm and a cold wall."""
    settings = ("particles.spacing=0.125 m", "time.end=1 s", "time.step=0.1 s")
    solver = recipe_of(load_case("heated-cube", settings)).build(backend)
    return found_by(solver)


def stiff_heat(backend):
    """Linear systems that factors and multigrid precondition."""
    operator, _ = system(backend, 24)
    b, one, mask = (backend.asarray(v) for v in (right_side(576, 24), np.ones(576), held_front(24)))
    found = []
    for rests in (True, False):
        solver = ConjugateGradient(backend, operator, 576, rests=rests)
        for s in (50.0, 3e3, 50.0, 3e3, 4e3):
            iterations = solver.solve(b, one, mask, s, residual=1e-6, max_iterations=200)
            found += [backend.to_host(solver.solution), iterations]
    return found


SPOTS = (spot_in_section, moving_spot)
CASES = (heated_box, heated_cube, flat_pool, lit_pool, moving_pool, lit_steel, short_pulse)
CASES += (*SPOTS, short_pulse_on_melt, stiff_heat)


@pytest.fixture(scope="module")
def runs():
    """Of each case what its graphs leave, recorded and run as they are; and those that replayed."""
    replayed, found = set(), {}
    for case in CASES:
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(KeptGraph, "fits", _noting(replayed))
            recorded = case(compute.cpu(threads=1))
        plain = compute.cpu(threads=1)
        plain.loops.records = False
        found[case] = recorded, case(plain)
    return found, replayed


def _noting(names):
    """`KeptGraph.fits` that notes the names of graphs whose recording is used."""
    fits = KeptGraph.fits

    def note(kept, loops, owner, arguments, options):
        values = fits(kept, loops, owner, arguments, options)
        if values is not None:
            names.update(name for name, one in vars(owner).items() if one is kept)
        return values

    return note


def assert_same(found, expected):
    """The same bits of all arrays, and the same numbers."""
    for one, other in zip(found, expected, strict=True):
        if isinstance(one, np.ndarray):
            assert one.tobytes() == other.tobytes()
        else:
            assert one == other


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.__name__)
def test_recorded_and_run_as_they_are(runs, case):
    """Graphs leave the bits of their methods."""
    assert_same(*runs[0][case])


def test_all_graphs_are_reached(runs):
    """No graph of the package is left out of the cases above."""
    ours = {name for name in GRAPHS if name.startswith("lasersph.")}
    assert sorted(ours - runs[1]) == []


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.__name__)
def test_checked(runs, case):
    """Methods launch in every step what was recorded, and leave the same bits."""
    with checked_graphs():
        assert_same(case(compute.cpu(threads=1)), runs[0][case][0])
