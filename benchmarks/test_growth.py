"""Whether the cost of a particle stays the same as particles become more: loops, steps of heat, and
steps of a flow in 3-D.

All sizes lie beyond the last-level cache. Times are those of the processors, so that other programs
on the machine matter less. Ten million particles are measured on demand: GROWTH_PARTICLES is the
larger size of the loops, GROWTH_SPACING that of the steps. A million that flow take 9.2 GiB.
Run: pytest benchmarks/test_growth.py -s
"""

import os
from resource import RUSAGE_SELF, getrusage
from time import perf_counter, process_time

import pytest
from hot_loops.counting import CountingBackend
from hot_loops.measure import loops_of

from lasersph import compute
from lasersph.case import load_case
from lasersph.simulation import forecast
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.conduction.solver import Conduction
from lasersph.solvers.step_control import choose_step

THREADS = 2
SIZES = (400_000, int(os.environ.get("GROWTH_PARTICLES", "2000000")))
SPACINGS = ("0.2 um", os.environ.get("GROWTH_SPACING", "0.1 um"))
"""Of a body of 100 um by 100 um: 250 000 and a million particles."""
SIDES = (27, 100)
"""Particles along the edges of cubes below a lid: 19 683 and a million that flow."""
ROUNDS = 3
WARM, STEPS = 1, 3
FLAT = 1.5
"""Largest over smallest cost of a particle that is allowed."""


def fastest(loop):
    """Shortest processor time per particle and pass [s], after a first run."""
    loop.run()
    times = []
    for _ in range(ROUNDS):
        begin = process_time()
        passes = loop.run()
        times.append((process_time() - begin) / max(passes, 1) / loop.count)
    return min(times)


def test_loops():
    """Every loop, in processor time per particle and pass."""
    backend, times = CountingBackend(THREADS), {}
    for size in SIZES:
        for loop in loops_of(backend, size):
            time = fastest(loop)
            times.setdefault(loop.name, []).append(time)
            print(f"\n{loop.name}, {loop.count} particles: {1e9 * time:.1f} ns", end="", flush=True)
            del loop  # its arrays, before the next one makes its own
    growth = {name: last / first for name, (first, last) in times.items()}
    print("".join(f"\n{name}: {ratio:.2f} times" for name, ratio in growth.items()))
    assert max(growth.values()) <= FLAT, growth


def cost(scheme, spacing):
    """Processor time per particle and step [s], of implicit steps per linear iteration."""
    settings = [
        "solver.dimensions=2", f"solver.scheme={scheme}", f"particles.spacing={spacing}",
        "domain.width=100 um", "domain.depth=100 um", "time.step=10 ns",
    ]  # fmt: skip
    case = load_case("pulsed-heating", settings)
    solver = recipe_of(case).build(compute.cpu(threads=THREADS))
    assert isinstance(solver, Conduction)
    begin, iterations = 0.0, 0
    for k in range(WARM + STEPS):
        if k == WARM:
            begin, iterations = process_time(), 0
        _, step, unclipped_step = choose_step(solver.time_step_limits())
        solver.step(step, unclipped_step)
        iterations += solver.iterations["linear"] if scheme == "implicit" else 1
    count = solver.body.count
    each = (process_time() - begin) / count
    print(
        f"\n{scheme}, {count} particles: {1e9 * each / STEPS:.0f} ns of processor time a particle"
        f" and step, of {iterations / STEPS:.1f} iterations;"
        f" {forecast(case).memory / count:.0f} B a particle expected, the process took"
        f" {1024 * getrusage(RUSAGE_SELF).ru_maxrss / 2**30:.2f} GiB at most"
    )
    return each / iterations


@pytest.mark.parametrize("scheme", ["explicit", "implicit"])
def test_step_of_heat(scheme):
    """Four times the particles in the same body."""
    first, last = (cost(scheme, spacing) for spacing in SPACINGS)
    assert last <= FLAT * first


def cost_of_flow(side):
    """Processor time per particle and step [s] of a cube below a lid, with all of its pressure and
    viscosity."""
    frame = ["solver.frame=lagrangian", "particles.support_ratio=3.1"]
    settings = [*frame, f"particles.spacing={1.0 / side!r} m"]
    case = load_case("lid-driven-cube", settings)
    solver = recipe_of(case).build(compute.cpu(threads=THREADS))
    count, begin, wall = solver.body.count, 0.0, 0.0
    # few particles take more steps, so that both are timed for seconds
    steps = max(STEPS, SIDES[-1] ** 3 // count)
    for k in range(WARM + steps):
        if k == WARM:
            begin, wall = process_time(), perf_counter()
        _, step, unclipped_step = choose_step(solver.time_step_limits())
        solver.step(step, unclipped_step)
    each, waited = (
        (now - then) / (steps * count)
        for now, then in ((process_time(), begin), (perf_counter(), wall))
    )
    found = ", ".join(f"{number} of {name}" for name, number in solver.flow.iterations.items())
    print(
        f"\nflow, {count} particles: {1e6 * each:.1f} us of processor time a particle and step,"
        f" {1e6 * waited:.1f} us waited with {THREADS} threads; iterations: {found};"
        f" {forecast(case).memory / count:.0f} B a particle expected, the process took"
        f" {1024 * getrusage(RUSAGE_SELF).ru_maxrss / 2**30:.2f} GiB at most"
    )
    return each


def test_step_of_flow():
    """From twenty thousand to a million particles."""
    first, last = (cost_of_flow(side) for side in SIDES)
    assert last <= FLAT * first
