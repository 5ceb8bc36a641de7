"""Which part of a step of a melt pool takes the time, and how far it is from memory bandwidth.

Steel at 0.5 J/cm2 while it flows, 54 ns, by the lines of `MeltPool.step`. The floor of a pass over
the pairs of the block is the time to read 12 bytes of each, value and neighbor, at the bandwidth
that `benchmarks/roofline.py` measures; a step has some passes a line, one an iteration of pressure
and of the viscosity, and on the whole body's pairs one an iteration of the heat. 8 nm takes half a
minute, the published 3.97 nm some minutes. Run: pytest benchmarks/test_flow_step.py -s
"""

from time import perf_counter

import pytest
from hot_loops.ceilings import bandwidth

from lasersph import compute
from lasersph.case import load_case
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.melt_pool.solver import MeltPool
from lasersph.solvers.step_control import choose_step

START, STEPS, FIRST = 54e-9, 20, 3
THREADS = 2
LINES = (
    "advect", "flow.predict", "flow.project", "flow.correct", "update_positions", "illuminate",
    "heat.conduct", "rearrange", "_measure", "_keep",
)  # fmt: skip
"""What `MeltPool.step` calls, in order; the last two serve observers and retries."""


def advance(solver, steps=None):
    """Steps by the solver's own limits: so many, or up to START."""
    done = 0
    while solver.state.time < START * (1.0 - 1e-12) if steps is None else done < steps:
        limits = solver.time_step_limits()
        if steps is None:
            limits["end"] = START - solver.state.time
        _, step, unclipped_step = choose_step(limits)
        solver.step(step, unclipped_step)
        done += 1


def clocked(solver):
    """Let the lines of a step add up their times [s]."""
    times = dict.fromkeys(LINES, 0.0)

    def timed(name, function):
        def call(*arguments, **options):
            begin = perf_counter()
            answer = function(*arguments, **options)
            times[name] += perf_counter() - begin
            return answer

        return call

    for name in LINES:
        owner, _, method = name.rpartition(".")
        found = getattr(solver, owner) if owner else solver
        setattr(found, method, timed(name, getattr(found, method)))
    return times


@pytest.mark.parametrize("spacing", [8.0, 3.97])
def test_lines_of_a_step(spacing):
    """Their times add up to the step's; the pressure takes less than half of it."""
    settings = [
        "solver.kind=melt-pool",
        "laser.fluence=0.5 J/cm^2",
        f"particles.spacing={spacing} nm",
    ]
    backend = compute.cpu(threads=THREADS)
    solver = recipe_of(load_case("dlip-steel", settings)).build(backend)
    assert isinstance(solver, MeltPool)
    advance(solver)
    advance(solver, FIRST)
    times = clocked(solver)
    counts = dict.fromkeys(solver.iterations, 0)
    begin = perf_counter()
    for _ in range(STEPS):
        advance(solver, 1)
        counts = {name: counts[name] + number for name, number in solver.iterations.items()}
    whole = (perf_counter() - begin) / STEPS
    pairs = solver.flow.block.pairs.neighbor.shape[0]
    body = solver.body.pairs.neighbors.neighbor.shape[0]
    floor = 12.0 / bandwidth(backend)
    means = {name: count / STEPS for name, count in counts.items()}
    passes = means["pressure"] + means["viscosity"]
    print(
        f"\n{spacing} nm: {solver.fluid_count:.0f} of {solver.body.count} particles flow, {pairs}"
        f" pairs of the block, {body} of the body; {1e3 * whole:.1f} ms a step"
    )
    for name in sorted(LINES, key=lambda one: -times[one]):
        share = times[name] / STEPS / whole
        print(f"  {name:18s} {1e3 * times[name] / STEPS:7.2f} ms {100.0 * share:5.1f} %")
    print(
        f"  iterations a step: {', '.join(f'{name} {mean:.1f}' for name, mean in means.items())}\n"
        f"  floor: {1e3 * floor * pairs:.2f} ms a pass over the block's pairs,"
        f" {1e3 * floor * body:.2f} ms over the body's; the iterations alone"
        f" {1e3 * floor * (passes * pairs + means['linear'] * body):.1f} ms"
    )
    inside = sum(times.values()) / STEPS
    assert 0.8 * whole < inside <= whole
    assert times["flow.project"] < 0.5 * inside * STEPS
