"""The published sample of ablation: 20 x 20 x 200 um at 0.2 um, ten million particles.

One pulse of 10 J/cm2 and 10 ns under a top hat, steps of 0.05 ns to 15 ns [Alshaer2017, Section
4.4]. Only what heat reaches is computed. What this gains is the time of a step with every particle
active, of the whole sample too, over that of the run's. With 1.27 million wall particles all active
take 1.96 kB a particle in float64, half of it weights of its 116 pairs, 20.6 GiB in all; in
float32 it is 1.23 kB and 12.9 GiB, so that both are timed in float32.
Run: pytest benchmarks/test_ablation_sample.py -s
"""

import resource
from time import perf_counter

from whole_run import measured

from lasersph import compute
from lasersph.case import load_case
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.ablation.solver import Ablation

SAMPLE = (
    "solver.dimensions=3",
    "domain.width=20 um",
    "domain.depth=200 um",
    "particles.spacing=0.2 um",
    "boundaries.sides=wall",
    "laser.beam.kind=top-hat",
    "laser.beam.radius=7.5 um",
    "time.step=0.05 ns",
    "time.is_fixed=true",
    "output.snapshots.interval=5 ns",
)
THREADS = 2
WITHIN = 300.0
"""Wall time allowed [s]."""
MEMORY = 6 * 2**30
"""Memory allowed [bytes]."""


def seconds_per_step(*changes, before, steps):
    """Wall time of a step [s] in float32 after some `before`, and the particles that are active."""
    case = load_case("ablation-depth", [*SAMPLE, *changes])
    solver = recipe_of(case).build(compute.cpu(threads=THREADS, precision="float32"))
    assert isinstance(solver, Ablation)
    for _ in range(before):
        solver.step(5e-11)
    begin = perf_counter()
    for _ in range(steps):
        solver.step(5e-11)
    active = solver.particles.capacity if solver.region is None else solver.region.active_count
    return (perf_counter() - begin) / steps, active


def test_ten_million_particles(tmp_path):
    """Within 5 minutes and 6 GiB on two threads, the run folder included."""
    found = measured("ablation-depth", SAMPLE, tmp_path, THREADS)
    depth = 1e6 * found.summary["crater"]["depth_m"]
    print(
        f"\n{found.summary['particles']} particles, {found.summary['steps']} steps: "
        f"{found.wall:.0f} s, {found.memory / 2**30:.2f} GiB; depth at the axis {depth:.1f} um"
    )
    assert found.summary["particles"] == 10_000_000
    assert found.wall <= WITHIN
    assert found.memory <= MEMORY


def test_gain_over_all_active():
    """Time per step of the whole sample, mostly inactive after 2 ns and all active."""
    partial, active_count = seconds_per_step(before=40, steps=20)
    everything, count = seconds_per_step("solver.active_region=false", before=2, steps=3)
    memory = 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print(
        f"\n{partial:.3f} s a step with {active_count} particles active, {everything:.2f} s with "
        f"all {count}, {everything / partial:.0f} times as long; {memory / 2**30:.1f} GiB"
    )
    assert everything > 5.0 * partial
