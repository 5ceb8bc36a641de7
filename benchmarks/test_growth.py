"""Whether the cost of a particle stays the same as particles become more: loops, and steps of heat.

Both sizes lie beyond the last-level cache. Ten million particles are measured on demand, by
`lasersph benchmark --sizes 400000,10000000`. Run: pytest benchmarks/test_growth.py -s
"""

from time import process_time

import pytest

from lasersph import compute
from lasersph.benchmark.ceilings import Ceilings
from lasersph.benchmark.measure import measure
from lasersph.case import load_case
from lasersph.simulation import forecast
from lasersph.simulation.build import build
from lasersph.solvers.conduction.solver import Conduction
from lasersph.solvers.time_step import choose

THREADS = 2
SIZES = (400_000, 2_000_000)
SPACINGS = ("0.2 um", "0.1 um")
"""Of a body of 100 um by 100 um: 250 000 and a million particles."""
WARM, STEPS = 1, 3
FLAT = 1.5
"""Largest over smallest cost of a particle that is allowed."""


def test_loops():
    """Every loop, in time per particle and pass on all threads."""
    times: dict[str, list[float]] = {}

    def report(one):
        if not isinstance(one, Ceilings) and one.threads == THREADS:
            times.setdefault(one.name, []).append(one.time)

    measure(SIZES, THREADS, report=report)
    growth = {name: last / first for name, (first, *_, last) in times.items() if last > first}
    print("".join(f"\n{name}: {1e9 * some[-1]:.1f} ns" for name, some in times.items()))
    assert max(growth.values(), default=1.0) <= FLAT, growth


def cost(scheme, spacing):
    """Processor time per particle and step [s], of implicit steps per linear iteration."""
    settings = [
        "solver.dimensions=2", f"solver.scheme={scheme}", f"particles.spacing={spacing}",
        "domain.width=100 um", "domain.depth=100 um", "time.step=10 ns",
    ]  # fmt: skip
    case = load_case("pulsed-heating", settings)
    solver = build(case, compute.cpu(threads=THREADS))[1]
    assert isinstance(solver, Conduction)
    begin, iterations = 0.0, 0
    for k in range(WARM + STEPS):
        if k == WARM:
            begin, iterations = process_time(), 0
        _, step, pace = choose(solver.time_step_limits())
        solver.step(step, pace)
        iterations += solver.iterations["linear"] if scheme == "implicit" else 1
    count = solver.body.count
    each = (process_time() - begin) / count
    print(
        f"\n{scheme}, {count} particles: {1e9 * each / STEPS:.0f} ns of processor time a particle"
        f" and step, of {iterations / STEPS:.1f} iterations;"
        f" {forecast(case).memory / count:.0f} B a particle expected"
    )
    return each / iterations


@pytest.mark.parametrize("scheme", ["explicit", "implicit"])
def test_step_of_heat(scheme):
    """Four times the particles in the same body."""
    first, last = (cost(scheme, spacing) for spacing in SPACINGS)
    assert last <= FLAT * first
